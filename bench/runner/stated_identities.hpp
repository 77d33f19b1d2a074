// What the author of a system states and a run can look at before it begins: a formula that is written is the
// one that would be derived, K and the bracket are skew, K is regular.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/system.hpp>

namespace pfaff {

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

/// Refuses (InputError) a system whose K is singular at (t, z), or of which a statement is false at (t, z) or
/// at one state near it: where a residual is more than a millionth of its terms, which no rounding is, nor a
/// constant of seven digits. Where a formula has no value nothing is said. Systems of more than 64
/// coordinates are not looked at, since deriving their formulas takes longer than a short run.
void check_stated_identities(const Model& model, const Real& t, const std::vector<Real>& z);

}  // namespace pfaff
