// One method with given parameters on one model, which the checks of methods look at, and the functions with
// which they record their results.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/verify/check.hpp>
#include <pfaff/verify/measured_step.hpp>

namespace pfaff {

/// A check of a method with these parameters on a system, with the names filled in and no result yet.
Check check_named(const MethodInstance& method, const Assignments& parameters, const std::string& system,
                  const std::string& claim, const std::string& scope, const char* precision);

class MethodOnModel {
 public:
  /// Both must outlive the object. `system` is the name that the checks are listed under.
  MethodOnModel(const MethodInstance& method, const Assignments& parameters, const std::string& system,
                const std::shared_ptr<const Model>& model);

  [[nodiscard]] const MethodInstance& method() const { return method_; }
  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return model_; }
  /// What the method claims on this model, without `none`. On canonical systems K-symplectic means the same
  /// as symplectic, and the two are one claim.
  [[nodiscard]] const std::vector<Claim>& claims() const { return claims_; }
  [[nodiscard]] bool claims(Claim claim) const;
  /// True where the method's coefficients are doubles, so that it does not reach round-off in quad.
  [[nodiscard]] bool double_coefficients() const { return method_.descriptor().double_coefficients; }
  /// True where the model is small enough for Jacobians and Taylor series in quad.
  [[nodiscard]] bool differentiable() const;
  /// The state at which claims are measured, generic_state of the model.
  [[nodiscard]] const std::vector<Real>& start() const { return start_; }
  /// The time at which claims are measured, generic_time_of the model.
  [[nodiscard]] const Real& time() const { return time_; }
  /// True where the method remembers earlier steps. Its claims are then measured on a step that has others
  /// before it, and nothing is measured on the Jacobian of a step, which says nothing about the map of
  /// several states that such a method is.
  [[nodiscard]] bool history() const { return history_; }
  /// The size of the step on which claims are measured: check_step in the system's own time, halved until the
  /// step, its derivative and the ways back that the method claims converge in double and in quad. `steps()`
  /// is false where no step did.
  [[nodiscard]] const Real& step_size() const { return step_size_; }
  [[nodiscard]] bool steps() const { return failure_ == Status::converged; }
  /// By how much the round-off of a step is more than that of a short method. A composition has a sub-step
  /// for each coefficient, and sub-steps round independently, so that what they round off adds up as the
  /// square root of their number (measured with 41); up to 25 stay within the tolerance.
  [[nodiscard]] double growth_of_round_off() const;
  /// How the shortest step that was tried failed.
  [[nodiscard]] Status failure() const { return failure_; }
  /// The step on which all claims are measured.
  template <class T>
  [[nodiscard]] MeasuredStep<T>& step() {
    if constexpr (std::is_same_v<T, Quad>) {
      return *in_quad_;
    } else {
      return *in_double_;
    }
  }

  /// The same step from another start, and of another size.
  template <class T>
  [[nodiscard]] MeasuredStep<T> step_from(const std::vector<Real>& start, const Real& h) const;

  /// A check with the names of this method and model filled in, and no result yet.
  Check check(const std::string& claim, const std::string& scope, const char* precision) const;
  /// The check of a residual: it must be within `limit` where the claim is made, and is only shown where it
  /// is not.
  Check residual(const std::string& claim, const std::string& scope, bool claimed, const char* precision,
                 double value, double limit) const;

 private:
  [[nodiscard]] bool ways_back_converge();

  const MethodInstance& method_;
  Assignments parameters_;
  std::string system_;
  std::shared_ptr<const Model> model_;
  std::vector<Claim> claims_;
  std::vector<Real> start_;
  Real time_;
  Real step_size_;
  bool history_ = false;
  Status failure_ = Status::converged;
  std::unique_ptr<MeasuredStep<double>> in_double_;
  std::unique_ptr<MeasuredStep<Quad>> in_quad_;
};

/// The step size with which claims are measured, in the system's own time (own_time). It is small enough for
/// nearly every implicit solve to converge, even in the longest sub-steps of compositions (five times the
/// step and more), and large enough for a false claim to show.
inline const Real check_step = Real::fraction(1, 20);

// order_checks.cpp
Check check_order(MethodOnModel& on);
// order_conditions.cpp
/// The coefficients of h^0, ..., h^p in the error of one step, p being the order but at most 8; they vanish
/// for a method of that order, or are at the round-off of its coefficients where these are doubles. The
/// largest one, relative to the scales of the step. nullopt where they say nothing: on systems with
/// constraints, of methods that need constraints or that remember earlier steps, and beyond 16 coordinates.
std::optional<Check> check_order_conditions(MethodOnModel& on);

// step_checks.cpp
/// Whether a method that remembers earlier steps forgets them where a run goes on from elsewhere: from
/// another state, or backwards.
Check check_continuation(const MethodOnModel& on);
/// Whether one that uses the past behind a step of another size, or on its way back, uses it rightly.
Check check_changed_steps(const MethodOnModel& on);

// run_checks.cpp
/// True where the motion meets a kink of the field in a step from (z, t), or in one before or after it.
bool near_a_kink(const MethodOnModel& on, const std::vector<Real>& z, const Real& t, const Real& h);
/// The claims of the method in every step of runs of a thousand steps, or in sixteen of them where a claim
/// needs the Jacobian of the step: at the step that is judged, at the largest that follows the motion and
/// between; and in one step as large as converges in quad. Of a method without history also that every step
/// of the first run is the one that a new stepper takes from there.
std::vector<Check> check_along_run(MethodOnModel& on);

// mixed_units.cpp
/// What is of very different sizes, in words: coordinates, or the positions and momenta of the chart that the
/// method steps in. Empty where they are alike.
std::string sizes_that_differ(const MethodOnModel& on);
/// True of a method whose step is another one where positions and momenta are written in other units: those
/// of a canonical system, or those of the chart of a Birkhoffian one, whose action is divided by a number. It
/// adds numbers of different units, as generating functions with a full matrix of `normal` do. False of
/// others.
bool adds_up_units(const MethodOnModel& on);

// adaptive_checks.cpp
std::vector<Check> check_adaptive(MethodOnModel& on);

// step_checks.cpp
/// That the method can step where its claims are judged.
Check check_steps(const MethodOnModel& on);
Check check_precisions(MethodOnModel& on);
Check check_step_jacobian(MethodOnModel& on);
/// Of a processed method: steps in a row, without the processor between them, end where single steps do.
Check check_steps_in_a_row(MethodOnModel& on);

}  // namespace pfaff
