// What a method that chooses its steps owes (advance_to): it ends where it was told to, forwards and
// backwards, with an error in proportion to its tolerance and not with more steps than that takes.
#include <algorithm>
#include <array>
#include <cmath>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/chosen_steps.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {

template <class T>
struct Tolerances;
template <>
struct Tolerances<double> {
  static constexpr const char* precision = "double";
  static constexpr std::array values{1e-4, 1e-6, 1e-8, 1e-10};
};
template <>
struct Tolerances<Quad> {
  static constexpr const char* precision = "quad";
  static constexpr std::array values{1e-10, 1e-16, 1e-22, 1e-28};
};
// A tolerance bounds the error of one step. Over the system's own time the errors of some tens of steps add
// up, and the motion multiplies them; a method that ignores its tolerance is off by 1e6 and more at the
// smallest.
constexpr double most_errors = 1000;
// Steps at the smallest tolerance over the system's own time; a method of order 2 needs about 1e5 for 1e-10.
constexpr double most_steps = 1e6;
// Smaller tolerances than the first are left out where an error of the method's order takes more steps than
// that: in quad a method of order 5 would take 4e5 of them for 1e-28.
constexpr double most_expected_steps = 1e4;

// The motion from the generic state and time of a model to a later or earlier time, as T has them.
template <class T>
struct Stretch {
  Stretch(const MethodOnModel& on, const T& elapsed) : begin(on.time()), end(begin + elapsed) {
    for (const Real& x : generic_state(*on.model())) start.push_back(T(x));
    exact.assign(start.begin(), start.end());
    kinks = short_flow(*motion_of(on.model()), Quad(begin), Quad(end) - Quad(begin), exact);
  }
  T begin, end;
  std::vector<T> start;
  std::vector<Quad> exact;  // the state at the end
  std::int64_t kinks = 0;   // of the field, which the motion meets
};

// One run at a tolerance. Fills `error`, in units of the tolerance, and returns what is wrong, or nothing.
template <class T>
std::string run_wrong(const MethodOnModel& on, const Stretch<T>& stretch, double tolerance, double& error) {
  Start<T> start = start_with(on.method(), on.model(), stretch.start, T(0), stretch.begin);
  start.tolerance = T(tolerance);
  Integration<T> run(std::move(start));
  // In two parts, so that the step with which the second begins is that with which the first ended.
  for (const T& to : {stretch.begin + (stretch.end - stretch.begin) / T(3), stretch.end}) {
    if (const Status status = run.to(to).status(); status != Status::converged)
      return "ended with '" + std::string(to_string(status)) + "'";
    if (run.time() != to)
      return "went to " + to_string(Quad(run.time()), 17) + " instead of " + to_string(Quad(to), 17);
  }
  const auto steps = static_cast<double>(run.counters().steps);
  if (!(steps >= 1 && steps <= most_steps)) return "took " + formatted("%.0f", steps) + " steps";
  Quad difference(0), size(0);
  const std::span<const T> z = run.state();
  for (std::size_t k = 0; k < z.size(); ++k) {
    difference = std::max(difference, abs(Quad(z[k]) - stretch.exact[k]));
    // What has decayed is judged by what it was, to which a tolerance is relative.
    size = std::max({size, Quad(abs(stretch.exact[k])), Quad(abs(Quad(stretch.start[k])) / Quad(8))});
    if (isnan(Quad(z[k]))) return "ended at a state that is not a number";
  }
  error = static_cast<double>(difference / size / Quad(tolerance));
  return {};
}

// Runs at every tolerance to the time `elapsed` after the generic one.
template <class T>
Check at_all_tolerances(const MethodOnModel& on, const T& elapsed, Check check) {
  check.tolerance = most_errors;
  check.result = CheckResult::pass;
  const Stretch<T> stretch(on, elapsed);
  const int order = on.method().order(*on.model());
  for (const double tolerance : Tolerances<T>::values) {
    if (tolerance != Tolerances<T>::values.front() && std::pow(tolerance, -1.0 / order) > most_expected_steps)
      break;
    double error = 0;
    check.reason = run_wrong<T>(on, stretch, tolerance, error);
    check.measured = std::max(check.measured, error);
    const bool right = check.reason.empty() && error <= most_errors;
    if (right) continue;
    if (stretch.kinks > 0 && check.reason.empty()) return not_judged(std::move(check), across_a_kink);
    check.result = CheckResult::fail;
    check.reason = "at a tolerance of 1e" + std::to_string(std::lround(std::log10(tolerance))) + ": " +
                   (check.reason.empty() ? "the error exceeds it too far" : check.reason);
    break;
  }
  return check;
}

template <class T>
void check_in(const MethodOnModel& on, std::vector<Check>& checks) {
  const T time(on.step_size() / check_step);
  for (const int direction : {1, -1}) {
    const Check check = on.check(direction > 0 ? "tolerance" : "tolerance, backwards", "every system",
                                 Tolerances<T>::precision);
    checks.push_back(within_budget(check, [&] { return at_all_tolerances(on, T(direction) * time, check); }));
  }
}

}  // namespace

std::vector<Check> check_adaptive(MethodOnModel& on) {
  std::vector<Check> checks;
  if (!on.method().adaptive() || !on.differentiable()) return checks;
  check_in<double>(on, checks);
  if (adaptive_in_quad(on.method(), on.model())) check_in<Quad>(on, checks);
  return checks;
}

}  // namespace pfaff
