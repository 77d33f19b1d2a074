// What a method that chooses its steps owes (advance_to): it ends where it was told to, forwards and
// backwards, with an error in proportion to its tolerance and not with more steps than that takes.
#include <algorithm>
#include <array>
#include <cmath>

#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/verification/method_on_model.hpp>

namespace pfaff {

namespace {

constexpr std::array tolerances{1e-4, 1e-6, 1e-8, 1e-10};
// A tolerance bounds the error of one step. Over the system's own time the errors of some tens of steps add
// up, and the motion multiplies them; a method that ignores its tolerance is off by 1e6 and more at 1e-10.
constexpr double most_errors = 1000;
// Steps at a tolerance of 1e-10 over the system's own time; a method of order 2 needs about 1e5.
constexpr double most_steps = 1e6;

// One run from the generic state to `elapsed` later at a tolerance. Fills `error`, in units of the tolerance,
// and returns what is wrong, or nothing.
std::string run_wrong(const MethodOnModel& on, const Model& motion, double elapsed, double tolerance,
                      double& error) {
  const auto stepper = on.method().stepper(on.model(), double());
  std::vector<double> z;
  for (const Real& x : generic_state(*on.model())) z.push_back(x.value());
  std::vector<Quad> exact(z.begin(), z.end());
  const double begin = generic_time.value(), end = begin + elapsed;
  double t = begin;
  // In two parts, so that the step with which the second begins is that with which the first ended.
  for (const double to : {begin + elapsed / 3, end}) {
    const Status status = stepper->advance_to(t, to, tolerance, z);
    if (status != Status::converged) return "ended with '" + std::string(to_string(status)) + "'";
    if (t != to) return "went to " + std::to_string(t) + " instead of " + std::to_string(to);
  }
  const auto steps = static_cast<double>(stepper->counters().steps);
  if (!(steps >= 1 && steps <= most_steps)) return "took " + std::to_string(steps) + " steps";
  taylor_flow(motion, Quad(begin), Quad(end) - Quad(begin), exact);
  Quad difference(0), size(0);
  for (std::size_t k = 0; k < z.size(); ++k) {
    difference = std::max(difference, abs(Quad(z[k]) - exact[k]));
    size = std::max(size, abs(exact[k]));
    if (isnan(Quad(z[k]))) return "ended at a state that is not a number";
  }
  error = static_cast<double>(difference / size) / tolerance;
  return {};
}

}  // namespace

std::vector<Check> check_adaptive(MethodOnModel& on) {
  if (!on.method().adaptive() || !on.differentiable()) return {};
  const auto motion = motion_of(on.model());
  const double time = (on.step_size() / check_step).value();
  std::vector<Check> checks;
  for (const double direction : {1.0, -1.0}) {
    Check check = on.check(direction > 0 ? "tolerance" : "tolerance, backwards", "every system", "double");
    check.tolerance = most_errors;
    check.result = CheckResult::pass;
    for (const double tolerance : tolerances) {
      double error = 0;
      check.reason = run_wrong(on, *motion, direction * time, tolerance, error);
      check.measured = std::max(check.measured, error);
      const bool right = check.reason.empty() && error <= most_errors;
      if (right) continue;
      check.result = CheckResult::fail;
      check.reason = "at a tolerance of 1e" + std::to_string(std::lround(std::log10(tolerance))) + ": " +
                     (check.reason.empty() ? "the error exceeds it too far" : check.reason);
      break;
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace pfaff
