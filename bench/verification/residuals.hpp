// Residuals of identities, recorded as tapes and evaluated at random points drawn with a fixed seed.
#pragma once

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/step_scale.hpp>
#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;
inline constexpr int points = 20;

inline Check named(const std::string& plugin, const std::string& claim, const std::string& system,
                   const char* precision, double measured, double tolerance) {
  Check check;
  check.plugin = plugin;
  check.claim = claim;
  check.scope = "every point";
  check.system = system;
  check.precision = precision;
  check.measured = measured;
  check.tolerance = tolerance;
  check.result = measured <= tolerance ? CheckResult::pass : CheckResult::fail;
  return check;
}

// Adds to `controls` those of the checks of a planted fault that is_meant(check) selects: they have to fail.
// std::logic_error where there are none, since the claim is then called otherwise.
template <class Meant>
void add_controls(std::vector<Check>& controls, const std::string& fault, const std::string& claim,
                  const std::vector<Check>& checks, const Meant& is_meant) {
  const std::size_t before = controls.size();
  for (Check check : checks) {
    if (!is_meant(check)) continue;
    check.plugin = fault;
    check.system.clear();
    check.scope = "control";
    check.control = true;
    check.result = check.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
    controls.push_back(std::move(check));
  }
  if (controls.size() == before) throw std::logic_error(fault + ": no claim is called " + claim);
}

// Random states near `centre`, drawn with a fixed seed: each coordinate within 1/20 of its scale.
template <class T>
class NearbyStates {
 public:
  explicit NearbyStates(const std::vector<Real>& centre)
      : centre_(centre), scales_(coordinate_scales(centre)), z_(centre.size()) {}
  // The next state, in a buffer that the call after it overwrites; `time` is a time near one.
  const std::vector<T>& next(T& time) {
    for (std::size_t i = 0; i < z_.size(); ++i) z_[i] = T(centre_[i]) + T(offset_(random_) * scales_[i]);
    time = T(1 + offset_(random_));
    return z_;
  }

 private:
  const std::vector<Real>& centre_;
  std::vector<double> scales_;
  std::vector<T> z_;
  std::mt19937_64 random_{20041};
  std::uniform_real_distribution<double> offset_{-0.05, 0.05};
};

// The size of a residual relative to the bound of its rounding error, which is in units of round-off; zero
// where the residual is exactly zero, and infinite where no rounding could explain it.
template <class T>
double relative_to_rounding(const WithRounding<T>& x) {
  if (x.value == T(0)) return 0;
  return static_cast<double>(T(abs(x.value)) / x.error);
}

// The largest output of a tape at random states near `centre`, each relative to the sizes of the terms that
// it is made of. A formula that is zero stays below a few units of round-off, however large, small or badly
// conditioned its terms are.
template <class T>
double largest(const std::shared_ptr<const Tape>& tape, const std::vector<Real>& centre) {
  using W = WithRounding<T>;
  NearbyStates<T> states(centre);
  Replay<W> replay(tape);
  std::vector<W> out(tape->outputs.size());
  double worst = 0;
  for (int k = 0; k < points; ++k) {
    T time;
    const std::vector<T>& z = states.next(time);
    const std::vector<W> exact(z.begin(), z.end());
    replay(W(time), exact.data(), out.data());
    for (const W& x : out) {
      const double size = relative_to_rounding(x);
      worst = std::isnan(size) || std::isnan(worst) ? NAN : std::max(worst, size);
    }
  }
  return worst;
}

// A residual is the sum of rounding errors of which each is at most one unit of round-off of its term, or two
// where it comes from a library function. Twice as much is allowed for what a bound to first order leaves
// out.
template <class T>
constexpr double residual_tolerance() {
  return 4 * static_cast<double>(unit_roundoff<T>());
}

// A tape made of recorded expressions of (t, z).
template <class F>
std::shared_ptr<const Tape> expression(int inputs, int outputs, F&& f) {
  return std::make_shared<const Tape>(record(inputs, outputs, std::forward<F>(f)));
}

inline void both(std::vector<Check>& checks, const std::string& plugin, const std::string& claim,
                 const std::string& system, const std::shared_ptr<const Tape>& residual,
                 const std::vector<Real>& centre) {
  checks.push_back(named(plugin, claim, system, "double", largest<double>(residual, centre),
                         residual_tolerance<double>()));
  checks.push_back(
      named(plugin, claim, system, "quad", largest<Quad>(residual, centre), residual_tolerance<Quad>()));
}

/// [Pi, Pi]^{ijk} = sum_l Pi^il d_l Pi^jk + cyclic: n x n x n, zero where Jacobi's identity holds.
std::shared_ptr<const Tape> jacobiator(const Tape& tensor, int n);
/// Pi + Pi^T, n x n: zero where the tensor is skew.
std::shared_ptr<const Tape> symmetric_part(const Tape& tensor, int n);
/// Pi dC for each function C in `casimirs`, n numbers each, one after the other; zero where C is a Casimir of
/// Pi.
std::shared_ptr<const Tape> sharp_of_casimirs(const Tape& tensor, const Tape& casimirs);

/// The third difference I(z + 3d) - 3 I(z + 2d) + 3 I(z + d) - I(z) of output k of a tape along a fixed
/// direction d with unequal components: one number, zero where the output is a polynomial of degree two in
/// the state.
std::shared_ptr<const Tape> third_difference(const Tape& values, std::size_t k);
/// True where it is, at random states near the initial one.
bool is_quadratic(const Model& model, std::size_t invariant);

/// Y_z^T K_c Y_z - K with K_c = [[0, -I], [I, 0]], for the chart Y and the structure K: zero where the chart
/// is Darboux's.
std::shared_ptr<const Tape> darboux_residual(const Tape& chart, const Tape& structure);

/// (z, t) -> the state on the velocity constraints of a model that projection in the metric of its masses
/// makes of z, for states near the surface. Holonomic constraints beside them are met first.
std::shared_ptr<const Tape> onto_velocity_constraints(const Model& model);

/// Compares what the author wrote with what is derived without it, at random states near `centre`: every
/// formula of the table that is written and can be derived, and the gradients of constraints one by one, by
/// the names of the constraints.
std::vector<Check> check_overrides(const std::string& plugin, const Model& model,
                                   const std::vector<Real>& centre);

/// Whether a symmetric tensor, n x n, is non-negative at random states near `centre`, in double and quad: the
/// number of its negative pivots is zero.
std::vector<Check> check_not_negative(const std::string& plugin, const std::string& claim,
                                      const std::string& system, const std::shared_ptr<const Tape>& tensor,
                                      const std::vector<Real>& centre);

/// Self-adjointness of a system K zdot + D = 0 (su-qin (8)), condition by condition.
std::vector<Check> check_self_adjointness(const std::string& plugin, const Model& model);

}  // namespace pfaff
