// What the author of a system states and a run can look at before it begins: a formula that is written is the
// one that would be derived, K and the bracket are skew, K is regular, what is said to be conserved is.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

/// A tape made of recorded expressions of (t, z).
template <class F>
std::shared_ptr<const Tape> expression(int inputs, int outputs, F&& f) {
  return std::make_shared<const Tape>(record(inputs, outputs, std::forward<F>(f)));
}

/// The size of a residual relative to the bound of its rounding error, which is in units of round-off, and so
/// over the sum of the sizes of its terms; zero where the residual is exactly zero, and infinite where no
/// rounding could explain it.
template <class T>
double relative_to_rounding(const WithRounding<T>& x) {
  if (x.value == T(0)) return 0;
  return static_cast<double>(T(abs(x.value)) / x.error);
}

/// A statement about formulas: the results of `residual`, an expression of (t, z), are zero where it is true.
struct StatedIdentity {
  std::string words;  // "written force is the derived one"
  std::shared_ptr<const Tape> residual;
};

/// One for every formula of the table that is written and can be derived, and for the gradient of each
/// constraint, by the constraint's name.
std::vector<StatedIdentity> written_formulas(const Model& model);

/// Pi + Pi^T, n x n: zero where the tensor is skew.
std::shared_ptr<const Tape> symmetric_part(const Tape& tensor, int n);

/// The rates of these invariants along the field of a model, expressions of (t, z): zero where they are
/// conserved.
std::shared_ptr<const Tape> rates_of_invariants(const Model& model, const std::vector<std::size_t>& which);

/// Refuses (InputError) a system whose K is singular at (t, z), or of which a statement is false at (t, z) or
/// at one state near it: where a residual is more than a millionth of its terms, which no rounding is, nor a
/// constant of seven digits. Where a formula has no value nothing is said. Systems of more than 64
/// coordinates are not looked at, since deriving their formulas takes longer than a short run.
void check_stated_identities(const std::shared_ptr<const Model>& model, const Real& t,
                             const std::vector<Real>& z);

/// What is said to be conserved and has a rate at (t, z) or at one state near it, by the same measure, a
/// sentence without a full stop; empty where nothing has. It is said and not refused, since the drift of what
/// is conserved nearly may be what somebody wants to see. Systems with constraints are not looked at, whose
/// invariants are conserved on the constraints alone.
std::string not_conserved(const std::shared_ptr<const Model>& model, const Real& t,
                          const std::vector<Real>& z);

}  // namespace pfaff
