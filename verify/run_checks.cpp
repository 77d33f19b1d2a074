// Claims along runs: what holds in one step from one state may be lost after some steps, at every hundredth,
// far from the start, or at steps so large that an iteration is cut off.
#include <array>
#include <cmath>
#include <optional>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/kinks.hpp>
#include <pfaff/runs/history.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/rounding_of_step.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

bool near_a_kink(const MethodOnModel& on, const std::vector<Real>& z, const Real& t, const Real& h) {
  const std::shared_ptr<const Model> motion = motion_of(on.model());
  std::vector<Quad> start;
  for (const Real& x : z) start.push_back(x.quad());
  const auto kinks = [&](const Quad& elapsed) {
    std::vector<Quad> moved = start;
    return short_flow(*motion, t.quad(), elapsed, moved);
  };
  try {
    return kinks(-h.quad()) > 0 || kinks(Quad(2) * h.quad()) > 0;
  } catch (const SolutionEnds&) {  // as where the motion stays at a jump
    return !Kinks<Quad>(*motion->tape(Formula::field)).none();
  }
}

namespace {

constexpr int steps_of_run = 1000, looks = 16;
// Of a method that remembers earlier steps, so many come before the one that is judged.
constexpr std::array warm_ups{16, 96, 198};
constexpr int most_doublings = 6;
// Where residuals are found to be rounding at so many states, some others are looked at.
constexpr int most_excused = 32;
// Runs of larger systems would take most of the time of verification; small ones of every kind show the same.
constexpr int small_system = 8;

struct Place {
  std::vector<Real> z;
  Real t;
  int steps = 0;  // before it
};

std::vector<Real> as_reals(std::span<const double> z) {
  std::vector<Real> reals;
  for (const double x : z) reals.emplace_back(Quad(x));
  return reals;
}

// What the checks need of one run in double: the states at which claims are looked at, and the first step
// that differs from the same step of a stepper that starts there.
struct RunInDouble {
  std::vector<Place> places;
  int differs = 0;        // the number of that step; 0 where there is none
  double difference = 0;  // relative to the state after it
};

// How far the step from a state moves where its inputs move by a unit in the last place.
double spread(const MethodOnModel& on, const Place& place, const Real& h) {
  MeasuredStep<double> step(on.method(), on.model(), place.z, place.t, h);
  if (!step.end()) return no_step;
  double worst = 0;
  for (const double distance : of_moved_starts<double>(place.z, [&](const std::vector<Real>& start) {
         MeasuredStep<double> moved(on.method(), on.model(), start, place.t, h);
         return moved.end() ? step.distance(*step.end(), *moved.end()) : no_step;
       }))
    worst = std::isnan(distance) ? no_step : std::max(worst, distance);
  return worst;
}

// True where the same two steps differ by less in quad, by as much as the precisions differ: the step of a
// run begins its iteration from what it remembers, and what the stopping rule leaves differs.
bool left_by_stopping(const MethodOnModel& on, const Real& size, int steps, double in_double) {
  std::vector<Quad> z;
  for (const Real& x : on.start()) z.push_back(x.quad());
  Integration<Quad> run(start_with(on.method(), on.model(), std::move(z), size.quad(), on.time().quad()));
  if (!run.steps(steps).reached()) return false;
  Integration<Quad> alone = run.beside({run.state().begin(), run.state().end()});
  return run.steps(1).reached() && alone.steps(1).reached() &&
         falls_with_the_precision(in_double, relative_difference(run.state(), alone.state()));
}

// True where a step from a place ends within a fiftieth of the state from where two of half its size do.
bool follows_the_motion(const MethodOnModel& on, const Place& place, const Real& h) {
  constexpr double most_rough = 0.02;
  MeasuredStep<double> step(on.method(), on.model(), place.z, place.t, h);
  const auto halves = step.after(step.t(), step.h() / 2, step.start(), 2);
  return step.end() && halves && relative_difference<double>(*halves, *step.end()) <= most_rough;
}

// A place of a run in double on its constraints in quad, where there are any: off them by a rounding in
// double, a step misses its start by as much in both precisions.
Place on_the_surface(const Model& model, const Place& place) {
  if (!model.restricted()) return place;
  std::vector<Quad> z;
  for (const Real& x : place.z) z.push_back(x.quad());
  if (project_onto_constraints(model, place.t.quad(), z).status != Status::converged) return place;
  return {{z.begin(), z.end()}, place.t, place.steps};
}

// Whether the measure of a claim takes a step back to where a step began.
bool leads_back(Claim claim) { return claim == Claim::symmetric || claim == Claim::reversible; }

// True of a method that remembers earlier steps on the pendulum. Where the force is constant, as it is on one
// side of a kink, it shows no memory.
bool remembers_elsewhere(const MethodInstance& method) {
  const auto pendulum = systems().get("pendulum", "system").make({});
  return method.refuses(*pendulum).empty() &&
         keeps_history(method, pendulum, Quad(0), Quad(1) / Quad(8), {Quad(1), Quad(1) / Quad(2)});
}

// A run of steps of one size, of which each is compared with the same step by itself where that is asked for,
// up to the first one that differs.
RunInDouble follow(const MethodOnModel& on, const Real& step, bool compared) {
  constexpr double most_moved = 8, most_growth = 64, most_shrinking = 1024;
  double allowed =
      most_left_by_stopping * tolerance<double>();  // more where that has been found to be rounding
  RunInDouble found;
  std::vector<double> start;
  for (const Real& x : on.start()) start.push_back(x.value());
  Integration<double> run(start_with(on.method(), on.model(), start, step.value(), on.time().value()));
  Integration<double> alone = run.beside(start);
  const std::span<const double> z = run.state();
  const double first = largest_of(z);
  std::vector<double> largest(z.size());
  for (int n = 0; n < steps_of_run; ++n) {
    const Place place{as_reals(z), Real(Quad(run.time())), n};
    // A coordinate that has become small beside what it was has no size by which a residual could be judged.
    bool small = false;
    for (std::size_t k = 0; k < z.size(); ++k) {
      largest[k] = std::max(largest[k], std::abs(z[k]));
      small = small || std::abs(z[k]) * most_shrinking < largest[k];
    }
    if (!small) found.places.push_back(place);
    if (compared) {
      alone.go_on_from({z.begin(), z.end()}, run.time(), step.value());
      alone.forget();
    }
    if (!run.steps(1).reached()) break;
    // Far from where it started a motion has other sizes, for which the step was not chosen.
    const double size = largest_of(z);
    if (!(size <= most_growth * first) || !(first <= most_growth * size)) break;
    if (!compared) continue;
    if (!alone.steps(1).reached()) break;
    const double difference = relative_difference<double>(z, alone.state());
    if (!(difference > allowed)) continue;
    if (difference <= most_moved * spread(on, place, step) || left_by_stopping(on, step, n, difference)) {
      allowed = most_moved * difference;
      continue;
    }
    // The equations of an implicit step may have several solutions, of which a start without a past finds
    // another one.
    if (!follows_the_motion(on, place, step)) break;
    if (remembers_elsewhere(on.method())) break;
    found.differs = n + 1;
    found.difference = difference;
    compared = false;
  }
  return found;
}

// Residuals of the claim in the same step from starts that are moved by a rounding.
template <class T>
std::vector<double> residuals_of_moved_starts(const MethodOnModel& on, const ClaimCheck& row,
                                              const Place& place, const Real& h, int warm_up) {
  return of_moved_starts<T>(place.z, [&](const std::vector<Real>& start) {
    MeasuredStep<T> again(on.method(), on.model(), start, place.t, h, warm_up);
    return residual_of(row, again);
  });
}

// The claim in a step from a place, once more where its residual may be rounding and is more than `enough`.
template <class T>
double residual_in(MeasuredStep<T>& step, const MethodOnModel& on, const ClaimCheck& row, const Place& place,
                   const Real& h, double enough = tolerance<T>()) {
  const double residual = residual_of(row, step);
  if (!(residual > enough)) return residual;
  const auto moved = residuals_of_moved_starts<T>(on, row, place, h, step.warm_up());
  return is_rounding(moved, tolerance<T>()) ? 0 : residual;
}
template <class T>
double residual_at(const MethodOnModel& on, const ClaimCheck& row, const Place& place, const Real& h,
                   int warm_up, double enough = tolerance<T>()) {
  MeasuredStep<T> step(on.method(), on.model(), place.z, place.t, h, warm_up);
  return residual_in(step, on, row, place, h, enough);
}

// Rows of the claims that the method makes and that a single step shows.
std::vector<const ClaimCheck*> rows_of(const MethodOnModel& on) {
  std::vector<const ClaimCheck*> rows;
  for (const ClaimCheck& row : claim_checks())
    if (on.claims(row.claim) && !row.of_rounding &&
        !(row.from_jacobian && (!on.differentiable() || on.history())))
      rows.push_back(&row);
  return rows;
}

// The check of a claim, which has not been made yet.
template <class T>
Check check_of(const MethodOnModel& on, const ClaimCheck& row, const char* where) {
  const ClaimRow& claim = claim_row(row.claim);
  return on.check(std::string(claim.name) + where, std::string(claim.scope), precision_name<T>());
}

// Fails where a claim is lost in a step from one of the places: of claims that need the Jacobian of the step
// from sixteen of them, of others from each, or from sixteen where many needed a second look. Double
// coefficients and stopping rules leave more than rounding.
Check judged(const MethodOnModel& on, const ClaimCheck& row, const Real& h, const std::vector<Place>& places,
             Check check) {
  check.tolerance = most_left_by_stopping * tolerance<double>() * on.growth_of_round_off();
  check.result = CheckResult::pass;
  std::optional<MeasuredStep<double>> step;  // which is moved from place to place
  int excused = 0;
  const auto in_double = [&](const Place& place) {
    if (on.history()) return residual_at<double>(on, row, {on.start(), on.time()}, h, place.steps);
    if (step) {
      step->move_to(place.z, place.t);
    } else {
      step.emplace(on.method(), on.model(), place.z, place.t, h);
    }
    return residual_in(*step, on, row, place, h, check.tolerance);
  };
  const auto in_quad = [&](const Place& place, double enough) {
    return on.history() ? residual_at<Quad>(on, row, {on.start(), on.time()}, h, place.steps, enough)
                        : residual_at<Quad>(on, row, on_the_surface(*on.model(), place), h, 0, enough);
  };
  for (const Place& place : places) {
    const bool some = row.from_jacobian || excused >= most_excused;
    if (some && !on.history() && place.steps % (steps_of_run / looks) != 0) continue;
    const double residual = in_double(place);
    // Steps that do not converge, in double or in quad, are no claim's fault.
    if (std::isnan(residual)) break;
    const bool lost = residual > check.tolerance;
    // The equations of an implicit step that is long, or near a kink of the field, may have several
    // solutions, of which the step back finds another.
    if (lost && h != on.step_size() && !follows_the_motion(on, place, h)) continue;
    if (lost && leads_back(row.claim) && near_a_kink(on, place.z, place.t, h)) continue;
    check.measured = std::max(check.measured, residual);
    if (!lost) continue;
    double falls = most_in_quad(residual);
    if (falls < 0 && !on.history())
      falls = most_in_quad(residual, scatter(residuals_of_moved_starts<double>(on, row, place, h, 0)));
    if (!on.double_coefficients() && falls >= 0) {
      const double residual_in_quad = in_quad(place, falls);
      if (std::isnan(residual_in_quad)) continue;
      if (residual_in_quad <= falls) {
        ++excused;
        continue;
      }
    }
    check.result = CheckResult::fail;
    check.reason = "lost in step " + std::to_string(place.steps + 1);
    if (h != on.step_size()) check.reason += ", of size " + to_string(h.quad(), 3);
    break;
  }
  return check;
}

// Steps longer than the one that is judged: the largest of 2, 4, ... 64 times it that still follows the
// motion from the generic state, and one halfway there. Beyond, the equations of an implicit step have
// several solutions, and the step back may find another one.
std::vector<Real> longer_steps(const MethodOnModel& on) {
  std::vector<Real> sizes{on.step_size()};
  for (int k = 0; k < most_doublings; ++k) {
    const Real next = sizes.back() * Real(2);
    if (!follows_the_motion(on, {on.start(), on.time()}, next)) break;
    sizes.push_back(next);
  }
  if (sizes.size() > 3) return {sizes[sizes.size() / 2], sizes.back()};
  return {sizes.begin() + 1, sizes.end()};
}

}  // namespace

std::vector<Check> check_along_run(MethodOnModel& on) {
  std::vector<Check> checks;
  if (on.model()->dimension() > small_system) return checks;
  const auto add = [&](const Check& check, const auto& judge) {
    checks.push_back(within_budget(check, judge));
  };
  const auto along = [&](const Real& h) {
    RunInDouble run;
    Check whole = on.check("steps of a run", "methods without history", precision_name<double>());
    if (on.history()) {
      for (const int steps : warm_ups) run.places.push_back({on.start(), on.time(), steps});
    } else {
      // At longer steps the equations of an implicit step may have several solutions, of which a start
      // without a past finds another one: there a difference says no more than where a method that remembers
      // elsewhere begins to do so, from where on its claims are not about single steps.
      const Check followed = within_budget(whole, [&] {
        run = follow(on, h, h == on.step_size() || remembers_elsewhere(on.method()));
        whole.measured = run.difference;
        whole.tolerance = most_left_by_stopping * tolerance<double>();
        whole.result = run.differs == 0 ? CheckResult::pass : CheckResult::fail;
        if (run.differs != 0)
          whole.reason =
              "step " + std::to_string(run.differs) + " of a run is another than the same step by itself";
        return whole;
      });
      if (h == on.step_size()) checks.push_back(followed);
    }
    for (const ClaimCheck* row : rows_of(on)) {
      const Check check = check_of<double>(on, *row, " along a run");
      add(check, [&] { return judged(on, *row, h, run.places, check); });
    }
  };
  along(on.step_size());
  const std::vector<Real> longer = longer_steps(on);
  for (const Real& h : longer) along(h);
  if (on.history() || on.double_coefficients() || longer.empty()) return checks;
  const Real& h = longer.back();
  for (const ClaimCheck* row : rows_of(on)) {
    Check check = check_of<Quad>(on, *row, " in a large step");
    add(check, [&] {
      check.measured = residual_at<Quad>(on, *row, {on.start(), on.time()}, h, 0);
      check.tolerance = most_left_by_stopping * tolerance<Quad>() * on.growth_of_round_off();
      if (std::isnan(check.measured))
        return not_judged(check, "a step of " + to_string(h.quad(), 3) + " does not converge");
      check.result = check.measured <= check.tolerance ? CheckResult::pass : CheckResult::fail;
      if (check.result == CheckResult::fail) check.reason = "lost in a step of " + to_string(h.quad(), 3);
      return check;
    });
  }
  return checks;
}

}  // namespace pfaff
