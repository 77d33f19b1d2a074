// Whether a claim of a method fails on one system, and whether the failure is more than rounding.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// One step on one system, or several steps in a row, at which a claim is judged.
struct JudgedStep {
  std::shared_ptr<const Model> model;  // that the method runs on
  std::vector<Real> state;             // at the start, on the constraints where there are any
  Real time = 0, step = Real::fraction(1, 10);
  int count = 1;  // of steps in a row, with the history that the method keeps
};

/// What was measured, and whether the claim is falsified by it.
///
/// A residual falsifies a claim when it is larger than falsifying_residual() and is no rounding: it falls as
/// a power of the step size while the step is halved, and is the same number in double and in quad where
/// double can see it. A claim of which only one sign fails, that the entropy does not fall, has residuals
/// that vanish at small steps; of these the second is asked alone. A claim about rounding is judged in double
/// by many runs near the state, with steps of the measure's choosing.
struct Judgement {
  bool falsified = false;
  std::vector<double> residuals;  // with steps h, h/2, ... in the precision judged; not-a-number: no step
  double in_double =
      std::numeric_limits<double>::quiet_NaN();  // with step h; not measured where no step was taken
  double exponent = 0;                           // of the power of h, from the last two residuals
  std::string reason;                            // why the claim is not falsified
};

/// The residual above which a claim is false, relative to the sizes of its terms: 1e-20, measured in quad, or
/// 1e-8, measured in double, for methods whose coefficients are doubles. For claims about rounding it is 1,
/// in units of what is allowed.
double falsifying_residual(const MethodInstance& method, Claim claim);
/// True for claims about rounding, which are judged by long runs and not by the steps that are given.
bool judged_by_long_runs(Claim claim);

/// Judges one claim. The model has to fit the method and be in the scope of the claim.
Judgement judge(const MethodInstance& method, Claim claim, const JudgedStep& at);

}  // namespace pfaff
