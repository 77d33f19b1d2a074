// The claims of systems: what was written agrees with what is derived, structures have the properties they
// are claimed to have, and invariants and exact solutions are right. Measured at random points drawn with a
// fixed seed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <pfaff/core/facets/stated_ranges.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating/generating_map_check.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/residuals.hpp>
#include <pfaff/verify/sign_along_motion.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {

// The rates of a motion at the state that the system itself begins at, from which no run could go on.
Check has_a_value(const std::string& system, const Model& motion) {
  Check check = named(system, "has rates at its initial state", system, "quad", 0, 0);
  check.scope = "initial state";
  if (!motion.moves() || motion.initial().size() != static_cast<std::size_t>(motion.dimension()))
    return check;
  Replay<Quad> field(motion.tape(Formula::field));
  std::vector<Quad> z, rates(motion.initial().size());
  for (const Real& x : motion.initial()) z.push_back(x.quad());
  field(generic_time_of(motion).quad(), z.data(), rates.data());
  if (std::all_of(rates.begin(), rates.end(), [](const Quad& x) { return isfinite(x); })) return check;
  check.measured = std::numeric_limits<double>::quiet_NaN();
  check.result = CheckResult::fail;
  check.reason = "the vector field is not finite there";
  return check;
}

// A number that is the same at every state is conserved by everything, so that its conservation says nothing.
// It varies where its values at random states differ by more than the bounds of their rounding errors.
Check varies(const std::string& system, const std::string& invariant,
             const std::shared_ptr<const Tape>& values, std::size_t k, const Region& region) {
  using W = WithRounding<Quad>;
  NearbyStates<Quad> states(region);
  Replay<W> replay(values);
  std::vector<W> out(values->outputs.size());
  std::optional<W> first;
  double largest = 0;
  for (int j = 0; j < points; ++j) {
    Quad time;
    const std::vector<Quad>& z = states.next(time);
    // At one time, since an invariant may depend on it.
    replay(W(Quad(region.times.front())), std::vector<W>(z.begin(), z.end()).data(), out.data());
    if (!isfinite(out[k].value)) continue;
    if (!first) first = out[k];
    largest = std::max(largest, relative_to_rounding(out[k] - *first));
  }
  Check check = named(system, invariant + " varies", system, "quad", largest, 0);
  check.expected = residual_tolerance<Quad>();
  check.result = largest > check.expected ? CheckResult::pass : CheckResult::fail;
  if (check.result == CheckResult::fail)
    check.reason =
        first ? "the same at every state, so that it says nothing" : "it has no value near the initial state";
  return check;
}

// The one output of a tape is positive at no random state, and along no short motion.
void never_positive(std::vector<Check>& checks, const std::string& name, const std::string& claim,
                    FollowedMotion& motion, const std::shared_ptr<const Tape>& forbidden,
                    const Region& region) {
  const auto positive =
      expression(motion.model()->dimension(), 1, [&](const Recorded& t, Arguments z, Results out) {
        const Recorded r = evaluate(*forbidden, t, z)[0];
        out[0] = select(r, r, Recorded(0));
      });
  both(checks, name, claim, name, positive, with_branches_of(*forbidden, region));
  // Along a motion a constant has no other sign.
  if (!is_short(*motion.model()) || (forbidden->state_independent() && forbidden->autonomous())) return;
  const auto& domain = region.domain != nullptr ? region.domain : forbidden;
  const Check along = named(name, claim + " along the motion", name, "quad", 0, residual_tolerance<Quad>());
  checks.push_back(within_budget(along, [&] {
    return named(name, along.claim, name, "quad", largest_along(motion, forbidden, domain),
                 residual_tolerance<Quad>());
  }));
}

void invariants(std::vector<Check>& checks, const std::string& name, FollowedMotion& motion) {
  const Model& model = *motion.model();
  Region region = motion.region();
  const auto& list = model.invariants();
  if (list.empty()) return;
  const int n = model.dimension();
  const auto values = model.tape(Formula::invariants);
  region.domain = values;  // a rate may have a value where the quantity has none
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto rate = rates_of_invariants(model, {k});
    if (list[k].behaviour == Behaviour::conserved) {
      // A constraint that follows from the others is zero on all of their surface, and is to be.
      const auto& redundant = model.source().redundant_constraints;
      if (std::find(redundant.begin(), redundant.end(), list[k].name) == redundant.end())
        checks.push_back(varies(name, list[k].name, values, k, region));
      if (list[k].quadratic)
        both(checks, name, list[k].name + " is quadratic", name,
             third_difference(*values, k, coordinate_scales(model.initial())), region);
      both(checks, name, "conserves " + list[k].name, name, rate, with_branches_of(*rate, region));
    } else if (list[k].behaviour == Behaviour::decreasing || list[k].behaviour == Behaviour::increasing) {
      const bool falls = list[k].behaviour == Behaviour::decreasing;
      const auto forbidden = expression(n, 1, [&](const Recorded& t, Arguments z, Results out) {
        const Recorded r = evaluate(*rate, t, z)[0];
        out[0] = falls ? r : -r;
      });
      never_positive(checks, name, (falls ? "decreases " : "increases ") + list[k].name, motion, forbidden,
                     region);
    }
  }
}

// Coefficients of friction are none of driving.
void friction(std::vector<Check>& checks, const std::string& name, const Model& model,
              FollowedMotion& motion) {
  const auto coefficients = model.tape(Formula::friction);
  const auto driving = expression(model.dimension(), 1, [&](const Recorded& t, Arguments z, Results out) {
    const auto lambda = evaluate(*coefficients, t, z);
    out[0] = -lambda[0];
    for (std::size_t k = 1; k < lambda.size(); ++k) out[0] = max(out[0], -lambda[k]);
  });
  never_positive(checks, name, "coefficients of friction are not negative", motion, driving, motion.region());
}

// The largest distance of the exact solution from Taylor steps over the size of the state, up to sixteen of
// the system's own times forwards and backwards from the first centre, or to where the motion ends. A jump of
// the closed form between two times shows in none of its derivatives.
double apart_along_motion(const Model& model, const Region& region) {
  const std::vector<Real>& centre = region.centres.front();
  // A surface may move, and at time 0 the initial state is on it.
  const Real begin = region.surface == nullptr ? generic_time_of(model) : Real(0);
  std::vector<Quad> start;
  for (const Real& x : centre) start.push_back(x.quad());
  std::vector<Quad> inputs = start;
  inputs.push_back(begin.quad());
  Replay<Quad> solution(model.tape(Formula::exact_solution));
  std::vector<Quad> closed(start.size());
  const Quad quarter = own_time(model, begin, centre) / Quad(4);
  Quad largest(0);
  for (const Quad& stretch : {quarter, Quad(-quarter)}) {
    std::vector<Quad> z = start;
    try {
      for (int k = 1; k <= 64; ++k) {
        short_flow(model, begin.quad() + Quad(k - 1) * stretch, stretch, z);
        solution(Quad(k) * stretch, inputs.data(), closed.data());
        Quad apart(0), size(0);
        for (std::size_t i = 0; i < z.size(); ++i) {
          if (!isfinite(closed[i])) return NAN;
          apart = std::max(apart, Quad(abs(z[i] - closed[i])));
          size = std::max(size, Quad(abs(z[i])));
        }
        if (apart > Quad(0)) largest = std::max(largest, Quad(apart / size));
      }
    } catch (const SolutionEnds&) {
      continue;
    }
  }
  return static_cast<double>(largest);
}

// The exact solution satisfies the differential equation and starts at its initial state.
void exact_solution(std::vector<Check>& checks, const std::string& name, const Model& model,
                    const Region& region) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto solution = model.tape(Formula::exact_solution), field = model.tape(Formula::field);
  const auto defect = expression(n + 1, 2 * n, [&](const Recorded& s, Arguments z, Results out) {
    const auto state = evaluate(*solution, s, z);
    const auto rate = time_derivative(*solution, s, z);
    const auto x = evaluate(*field, z[size] + s, state);
    const auto start = evaluate(*solution, Recorded(0), z);
    for (std::size_t k = 0; k < size; ++k) {
      out[k] = rate[k] - x[k];
      out[size + k] = start[k] - z[k];
    }
  });
  both(checks, name, "exact solution", name, defect, with_branches_of(*defect, region).of_elapsed_times());
  if (!is_short(model)) return;
  // Far above what Taylor steps in quad leave over a few of the system's own times, and far below a jump.
  constexpr double most_apart = 1e-20;
  const Check along = named(name, "exact solution along the motion", name, "quad", 0, most_apart);
  checks.push_back(within_budget(along, [&] {
    return named(name, along.claim, name, "quad", apart_along_motion(model, region), most_apart);
  }));
}

void darboux(std::vector<Check>& checks, const std::string& name, const Model& model, const Region& region) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto chart = model.tape(Formula::chart), inverse = model.tape(Formula::chart_inverse);
  const auto judged = [&](const char* claim, const std::shared_ptr<const Tape>& residual) {
    both(checks, name, claim, name, residual, with_branches_of(*residual, region));
  };
  judged("chart is Darboux", darboux_residual(*chart, *model.tape(Formula::structure)));
  const auto round_trip = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto back = evaluate(*inverse, t, evaluate(*chart, t, z));
    for (std::size_t k = 0; k < size; ++k) out[k] = back[k] - z[k];
  });
  judged("chart inverse", round_trip);
  // The chart carries the field X of the system into the field of the chart: Y_z X + Y_t.
  const auto field = model.tape(Formula::field), in_chart = model.tape(Formula::chart_field);
  const auto carried = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto x = evaluate(*field, t, z);
    const auto moved = directional_derivative(*chart, t, Recorded(1), z, x);
    const auto y = evaluate(*in_chart, t, evaluate(*chart, t, z));
    for (std::size_t k = 0; k < size; ++k) out[k] = moved[k] - y[k];
  });
  judged("field in the chart", carried);
}

// The field made from T + V and the rate of friction agrees with the field of the system.
void conformal(std::vector<Check>& checks, const std::string& name, const Model& model,
               const Region& region) {
  const Tape damped = damped_field(model);
  const auto field = model.tape(Formula::field);
  const auto difference =
      expression(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto a = evaluate(*field, t, z), b = evaluate(damped, t, z);
        for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - b[k];
      });
  both(checks, name, "field of the damped energies", name, difference, with_branches_of(*difference, region));
}

}  // namespace

std::vector<Check> check_system(const SystemPlugin& plugin, const Assignments& parameters) {
  return check_system(plugin.name(), plugin.make(parameters), parameters);
}

std::vector<Check> check_system(const std::string& name, const std::shared_ptr<const Model>& model,
                                const Assignments& parameters) {
  const int n = model->dimension();
  std::vector<Check> checks;
  // With constraints, the claims about invariants, solutions and reversals are claims about the motion in the
  // default formulation, which keeps invariants and has closed forms on the surface of the constraints.
  const auto motion = motion_of(model);
  const Region region = region_of(*motion, model->restricted() ? model->initial() : generic_state(*model));
  if (Check value = has_a_value(name, *motion); !good(value)) checks.push_back(std::move(value));
  for (Check& check : check_overrides(name, *model, region)) checks.push_back(std::move(check));
  if (model->facets().has(Facet::hamiltonian) || model->facets().has(Facet::structure) ||
      model->given(Formula::poisson_tensor)) {
    const auto tensor = model->tape(Formula::poisson_tensor);
    const auto judged = [&](const char* claim, const std::shared_ptr<const Tape>& residual) {
      both(checks, name, claim, name, residual, with_branches_of(*residual, region));
    };
    judged("bracket is skew", symmetric_part(*tensor, n));
    judged("Jacobi identity", jacobiator(*tensor, n));
    if (model->given(Formula::casimirs))
      judged("Casimirs", sharp_of_casimirs(*tensor, *model->tape(Formula::casimirs)));
  }
  if (model->facets().has(Facet::structure)) {
    for (Check& check : check_self_adjointness(name, *model)) checks.push_back(std::move(check));
  }
  if (model->facets().has(Facet::darboux_chart)) darboux(checks, name, *model, region);
  if (model->facets().has(Facet::conformal)) conformal(checks, name, *model, region);
  if (model->facets().has(Facet::generating_map)) {
    const GeneratingMapCheck alpha = check_generating_map(*model);
    checks.push_back(named(name, "alpha satisfies (34)", name, "quad", alpha.residual, 1e-31));
    if (!alpha.holds) checks.back().result = CheckResult::fail;
    checks.back().reason = alpha.message;
  }
  if (model->restricted())
    for (Check& check : check_constraints(name, model)) checks.push_back(std::move(check));
  if (model->facets().has(Facet::metriplectic))
    for (Check& check : check_metriplectic(name, *model)) checks.push_back(std::move(check));
  Region on_surface = region;
  if (model->restricted()) {
    on_surface.surface = model;
    on_surface.box = stated_ranges(model->coordinates());
  }
  FollowedMotion followed(motion, on_surface);
  if (model->given(Formula::friction)) friction(checks, name, *model, followed);
  invariants(checks, name, followed);
  if (model->facets().has(Facet::exact_solution)) exact_solution(checks, name, *motion, on_surface);
  if (model->given(Formula::reversal))
    for (Check& check : check_reversal(name, *motion, region)) checks.push_back(std::move(check));
  if (model->facets().has(Facet::exact_flows))
    for (Check& check : check_flows(name, model, region.centres.front())) checks.push_back(std::move(check));
  if (checks.empty()) checks.push_back(nothing_stated(name));
  for (Check& check : checks) check.parameters = parameters;
  return checks;
}

}  // namespace pfaff
