// What every step has to satisfy, whatever the method claims: it gives the same numbers in both precisions,
// its Jacobian is the derivative of the step itself, and several steps at once end where single ones do.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/history.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/residuals.hpp>
#include <pfaff/verify/rounding_of_step.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

Check check_steps(const MethodOnModel& on) {
  Check check = on.check("steps", "every system", "both");
  check.measured = on.step_size().value();
  check.result = CheckResult::pass;
  if (on.steps()) return check;
  // On another system it may; where there is none, verify says that nothing was judged.
  std::string why = "no step converges, down to " + scientific(check.measured) + " (" +
                    std::string(to_string(on.failure())) + ")";
  if (const std::string differ = differing_sizes(*on.model()); !differ.empty()) why += "; " + differ;
  return not_judged(std::move(check), why);
}

namespace {
// How far the step in double from a state of doubles ends from the step in quad from the same numbers.
double difference_of_precisions(const MethodOnModel& on, const std::vector<Real>& start, const Real& h,
                                MeasuredStep<double>& rounded) {
  const auto as_double = [](const Real& x) { return Real(Quad(x.value())); };
  std::vector<Real> same;
  for (const Real& x : start) same.push_back(as_double(x));
  MeasuredStep<Quad> exact(on.method(), on.model(), same, as_double(on.time()), as_double(h),
                           rounded.warm_up());
  const auto& end = rounded.end();
  if (!end || !exact.end()) return no_step;
  return static_cast<double>(exact.distance(std::vector<Quad>(end->begin(), end->end()), *exact.end()));
}
}  // namespace

// A difference that is not rounding can be what the stopping rule of the method leaves in double.
Check check_precisions(MethodOnModel& on) {
  const Real& h = on.step_size();
  const double difference = difference_of_precisions(on, on.start(), h, on.step<double>());
  Check check = on.residual("double-is-quad-rounded", "every system", true, "double", difference,
                            tolerance<double>() * on.growth_of_round_off());
  if (check.result != CheckResult::fail || std::isnan(difference)) return check;
  MeasuredStep<double> again = on.step_from<double>(on.start(), h);
  if (again.end() != on.step<double>().end()) {
    check.reason = "the same step from the same state ends elsewhere: it depends on what was computed before";
    return check;
  }
  double moved_by = 0;
  const auto differences = of_moved_starts<double>(on.start(), [&](const std::vector<Real>& moved) {
    MeasuredStep<double> rounded = on.step_from<double>(moved, h);
    if (rounded.end()) moved_by = std::max(moved_by, again.distance(*rounded.end(), *again.end()));
    return difference_of_precisions(on, moved, h, rounded);
  });
  if (is_rounding(differences, check.tolerance)) {
    check.result = CheckResult::pass;
    check.reason = multiplied_rounding;
  } else if (difference <= most_left_by_stopping * check.tolerance) {
    check.result = CheckResult::pass;
    check.reason = "what the method's own stopping rule leaves in double";
  } else if (moved_by > difference / 8) {
    return not_judged(check, "the step multiplies a rounding of its inputs to " + scientific(moved_by));
  } else if (MeasuredStep<double> quarter = on.step_from<double>(on.start(), h / Real(4));
             difference_of_precisions(on, on.start(), h / Real(4), quarter) <= check.tolerance) {
    return not_judged(check, "the equations of so large a step have another solution, which double finds");
  }
  return check;
}

namespace {
// The directions in which a Jacobian is compared: every coordinate by its scale, or of many coordinates a few
// directions that have a part in all of them, up or down as a fixed seed says. A wrong entry shows in each.
std::vector<std::vector<Quad>> directions_of(const std::vector<Quad>& scales) {
  constexpr std::size_t most = 8;
  const std::size_t n = scales.size();
  std::vector<std::vector<Quad>> directions(std::min(n, most), std::vector<Quad>(n));
  std::mt19937_64 random(20041);
  for (std::size_t k = 0; k < directions.size(); ++k)
    for (std::size_t j = 0; j < n; ++j)
      directions[k][j] = n > most ? (random() % 2 == 0 ? scales[j] : -scales[j])
                         : j == k ? scales[j]
                                  : Quad(0);
  return directions;
}
}  // namespace

// Compares the Jacobian of the converged step with central differences of order 6 in quad, whose error is
// delta^6 + u/delta. delta is in units of the scale, which is a thousand times the coordinate where the field
// amplifies rounding so much; of differences of order 4 the error delta^4 was above the tolerance there. With
// constraints, steps return to the surface along directions that turn fast, so that delta is smaller. What is
// allowed is far above this error where motions are stiff, and far below 1e-16, which is left of a derivative
// that is known to the round-off of double, or of an iteration that ends there.
Check check_step_jacobian(MethodOnModel& on) {
  constexpr double most_apart = 1e-22;
  constexpr std::array<int, 3> weights{45, -9, 1};  // of the differences over 2, 4 and 6 delta, in 60ths
  MeasuredStep<Quad>& step = on.step<Quad>();
  const std::vector<Quad>& scales = step.scales();
  const Quad delta(on.model()->restricted() ? 2e-8 : 1e-7);
  const std::vector<Quad>& jacobian = step.jacobian().jacobian;
  bool judged = step.jacobian().status == Status::converged;
  Quad worst(0), largest(0);
  const std::size_t n = step.start().size();
  for (const std::vector<Quad>& direction : directions_of(scales)) {
    std::vector<Quad> slope(n);
    for (int offset = -3; offset <= 3 && judged; ++offset) {
      if (offset == 0) continue;
      std::vector<Quad> moved = step.start();
      for (std::size_t j = 0; j < n; ++j) moved[j] += Quad(offset) * delta * direction[j];
      const auto end = step.after(step.t(), step.h(), std::move(moved));
      judged = judged && end.has_value();
      if (!judged) break;
      const int weight = weights[static_cast<std::size_t>(std::abs(offset) - 1)];
      for (std::size_t i = 0; i < n; ++i)
        slope[i] += Quad(offset > 0 ? weight : -weight) / Quad(60) * (*end)[i] / delta;
    }
    for (std::size_t i = 0; i < n && judged; ++i) {
      Quad along(0);
      for (std::size_t j = 0; j < n; ++j) along += jacobian[i * n + j] * direction[j];
      worst = std::max(worst, abs(slope[i] - along) / scales[i]);
      largest = std::max(largest, abs(along) / scales[i]);
    }
  }
  Check check = on.residual("step-jacobian", "every system", true, "quad",
                            judged ? static_cast<double>(worst / largest) : no_step, most_apart);
  // Differences are those of both sides of a kink.
  if (!good(check) && near_a_kink(on, on.start(), on.time(), on.step_size()))
    return not_judged(std::move(check), across_a_kink);
  return check;
}

namespace {
// How far two steps at once end from two single steps.
double difference_in_a_row(MeasuredStep<Quad>& step) {
  const auto at_once = step.after(step.t(), step.h(), step.start(), 2);
  const auto one = step.after(step.t(), step.h(), step.start());
  if (!at_once || !one) return no_step;
  const auto two = step.after(step.t() + step.h(), step.h(), *one);
  return two ? static_cast<double>(step.distance(*at_once, *two)) : no_step;
}
}  // namespace

Check check_steps_in_a_row(MethodOnModel& on) {
  return on.residual("steps-in-a-row", "processed methods", true, "quad",
                     difference_in_a_row(on.step<Quad>()), tolerance<Quad>() * on.growth_of_round_off());
}

std::vector<Check> check_false_processors() {
  const std::string system = "henon-heiles";
  const Assignments parameters{{"scheme", "corrected-3"}};
  const auto sound = integrators().get("exact-flow-splitting", "integrator").make(parameters);
  // The first flow of the processor, without the last of its inverse.
  const auto changed = sound->with_changed_coefficient(0, Quad(1e-6));
  MethodOnModel on(*changed, parameters, system, systems().get(system, "system").make({}));
  std::vector<Check> controls;
  add_controls(controls, "exact-flow-splitting with a processor that is not undone", "steps-in-a-row",
               {check_steps_in_a_row(on)}, [](const Check& /*check*/) { return true; });
  return controls;
}

Check check_continuation(const MethodOnModel& on) {
  constexpr double most_left =
      1e-20;  // predictors and sums leave 1e-24 and less, steps of a past that is not theirs a lot
  constexpr std::int64_t steps_behind = 3;
  std::vector<Quad> start, moved;
  for (const Real& x : on.start()) {
    start.push_back(x.quad());
    moved.push_back(x.quad() * (Quad(1) + Quad(1) / Quad(static_cast<double>(16 + moved.size()))));
  }
  const Quad t = on.time().quad(), h = on.step_size().quad();
  Check check = on.check("steps of another motion", "methods with history", "quad");
  check.tolerance = most_left;
  check.result = CheckResult::pass;
  const auto differs = [&](const std::vector<Quad>& from, const Quad& time, const Quad& step,
                           const char* what) {
    Integration<Quad> going_on(start_with(on.method(), on.model(), start, h, t)),
        fresh = going_on.beside(from, time, step);
    if (!going_on.steps(longest_beginning + 1).reached()) return;
    const Quad begun = time == t ? going_on.time() : time;
    going_on.go_on_from(from, begun, step);
    fresh.go_on_from(from, begun, step);
    if (!going_on.steps(steps_behind).reached() || !fresh.steps(steps_behind).reached()) return;
    const double difference = relative_difference<Quad>(going_on.state(), fresh.state());
    check.measured = std::max(check.measured, difference);
    if (difference <= most_left || check.result == CheckResult::fail) return;
    check.result = CheckResult::fail;
    check.reason = std::string("steps of a run that goes on ") + what +
                   " are others than those of a run that begins there";
  };
  differs(moved, t, h, "from another state");
  differs(start, t, h, "from the state that it began at");
  differs(moved, t + Quad(8) * h, -h, "from another state and time and the other way");
  return check;
}

// A method may use the past behind a step of another size, or on its way back, where its coefficients are
// those of the times at which it was: then it differs from one that forgets by what a step errs, h^(p + 1).
// One that takes the old coefficients differs by h^2.
Check check_changed_steps(const MethodOnModel& on) {
  constexpr double nothing = 1e-24, half_an_order = 0.5;
  std::vector<Quad> start;
  for (const Real& x : on.start()) start.push_back(x.quad());
  const int order = on.method().order(*on.model());
  Check check = on.check("steps of another size", "methods with history", "quad");
  check.expected = order + 1;
  check.tolerance = half_an_order;
  check.result = CheckResult::pass;
  check.measured = check.expected;
  // What a step of `factor` h behind steps of h differs by from that of a method that has forgotten them.
  const auto difference = [&](const Quad& h, const Quad& factor) {
    Integration<Quad> going_on(start_with(on.method(), on.model(), start, h, on.time().quad()));
    if (!going_on.steps(longest_beginning + 1).reached()) return 0.0;
    const std::vector<Quad> here(going_on.state().begin(), going_on.state().end());
    Integration<Quad> fresh = going_on.beside(here, going_on.time(), factor * h);
    going_on.go_on_from(here, going_on.time(), factor * h);
    if (!going_on.steps(1).reached() || !fresh.steps(1).reached()) return 0.0;
    return relative_difference<Quad>(going_on.state(), fresh.state());
  };
  const Quad h = on.step_size().quad();
  for (const auto& [factor, what] :
       {std::pair{Quad(0.5), "a step half as long as those before"}, {Quad(-1), "a step back"}}) {
    const double of_16 = difference(h / Quad(16), factor), of_64 = difference(h / Quad(64), factor);
    if (of_16 <= nothing || of_64 <= nothing) continue;
    const double seen = std::log(of_16 / of_64) / std::log(4.0);
    check.measured = std::min(check.measured, seen);
    if (seen >= check.expected - half_an_order || check.result == CheckResult::fail) continue;
    check.result = CheckResult::fail;
    check.reason = std::string(what) + " differs from that of a run that begins there by h^" +
                   formatted("%.2f", seen) + ", expected h^" + std::to_string(order + 1) +
                   " or nothing: its coefficients are those of other steps";
  }
  return check;
}

}  // namespace pfaff
