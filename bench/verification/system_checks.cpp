// The claims of systems and brackets: that what was written agrees with what is derived, that structures are
// what they are said to be, that invariants and exact solutions are right. Measured at random points with a
// fixed seed.
#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/residuals.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating_map_check.hpp>

namespace pfaff {

namespace {

// [Pi, Pi]^{ijk} = sum_l Pi^il d_l Pi^jk + cyclic, and the symmetric part, as tapes.
std::shared_ptr<const Tape> jacobiator(const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto pi = evaluate(tensor, t, z);
    const auto slope = jacobian(tensor, t, z);  // slope[(i n + j) n + l]
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t k = 0; k < size; ++k) {
          Recorded sum(0);
          for (std::size_t l = 0; l < size; ++l)
            sum = sum + pi[i * size + l] * slope[(j * size + k) * size + l] +
                  pi[j * size + l] * slope[(k * size + i) * size + l] +
                  pi[k * size + l] * slope[(i * size + j) * size + l];
          out[(i * size + j) * size + k] = sum;
        }
  });
}
std::shared_ptr<const Tape> symmetric_part(const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto pi = evaluate(tensor, t, z);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) out[i * size + j] = pi[i * size + j] + pi[j * size + i];
  });
}

// `motion` is the model, formulated where it has constraints.
void invariants(std::vector<Check>& checks, const SystemPlugin& plugin, const Model& model,
                const Model& motion) {
  const auto& list = model.invariants();
  if (list.empty()) return;
  const int n = model.dimension();
  const auto values = model.tape(Formula::invariants), field = motion.tape(Formula::field);
  for (std::size_t k = 0; k < list.size(); ++k) {
    // dI/dt along the field.
    const auto rate = expression(n, 1, [&](const Recorded& t, Arguments z, Results out) {
      const auto x = evaluate(*field, t, z);
      out[0] = directional_derivative(*values, t, Recorded(1), z, x)[k];
    });
    if (list[k].behaviour == Behaviour::conserved) {
      both(checks, plugin.name(), "conserves " + list[k].name, plugin.name(), rate, generic_state(model));
    } else if (list[k].behaviour == Behaviour::decreasing || list[k].behaviour == Behaviour::increasing) {
      const bool falls = list[k].behaviour == Behaviour::decreasing;
      // The positive part of the forbidden sign.
      const auto wrong = expression(n, 1, [&](const Recorded& t, Arguments z, Results out) {
        const Recorded r = evaluate(*rate, t, z)[0];
        out[0] = falls ? select(r, r, Recorded(0)) : select(r, Recorded(0), -r);
      });
      both(checks, plugin.name(), (falls ? "decreases " : "increases ") + list[k].name, plugin.name(), wrong,
           generic_state(model));
    }
  }
}

// The largest of a tape's outputs at one state and time.
template <class T>
double largest_at(const std::shared_ptr<const Tape>& tape, const T& t, const std::vector<Real>& state) {
  std::vector<T> z, out(tape->outputs.size());
  for (const Real& x : state) z.push_back(T(x));
  Replay<T> replay(tape);
  replay(t, z.data(), out.data());
  T worst(0);
  for (const T& x : out) worst = isnan(x) ? x : std::max(worst, abs(x));
  return static_cast<double>(worst);
}

// The exact solution satisfies the differential equation, of `motion`, and starts where it should.
void exact_solution(std::vector<Check>& checks, const SystemPlugin& plugin, const Model& model,
                    const Model& motion) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto solution = model.tape(Formula::exact_solution), field = motion.tape(Formula::field);
  std::vector<Real> centre = generic_state(model);
  centre.push_back(model.constrained() ? generic_time : Real(0));
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
  if (!model.constrained()) {
    both(checks, plugin.name(), "exact solution", plugin.name(), defect, centre);
    return;
  }
  // Of constrained motion on the surface only, where the generic state is.
  checks.push_back(named(plugin.name(), "exact solution", plugin.name(), "double",
                         largest_at<double>(defect, 1.0, centre), 1e-13));
  checks.push_back(named(plugin.name(), "exact solution", plugin.name(), "quad",
                         largest_at<Quad>(defect, Quad(1), centre), 1e-31));
}

void darboux(std::vector<Check>& checks, const SystemPlugin& plugin, const Model& model) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto chart = model.tape(Formula::chart), inverse = model.tape(Formula::chart_inverse);
  both(checks, plugin.name(), "chart is Darboux", plugin.name(),
       darboux_residual(*chart, *model.tape(Formula::structure)), generic_state(model));
  const auto round_trip = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto back = evaluate(*inverse, t, evaluate(*chart, t, z));
    for (std::size_t k = 0; k < size; ++k) out[k] = back[k] - z[k];
  });
  both(checks, plugin.name(), "chart inverse", plugin.name(), round_trip, generic_state(model));
  // The field in the chart is the field: Y_z X + Y_t.
  const auto field = model.tape(Formula::field), in_chart = model.tape(Formula::chart_field);
  const auto carried = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto x = evaluate(*field, t, z);
    const auto moved = directional_derivative(*chart, t, Recorded(1), z, x);
    const auto y = evaluate(*in_chart, t, evaluate(*chart, t, z));
    for (std::size_t k = 0; k < size; ++k) out[k] = moved[k] - y[k];
  });
  both(checks, plugin.name(), "field in the chart", plugin.name(), carried, generic_state(model));
}

// The mechanical energy and the rate of friction make the field.
void conformal(std::vector<Check>& checks, const SystemPlugin& plugin, const Model& model) {
  const Tape damped = damped_field(model);
  const auto field = model.tape(Formula::field);
  const auto difference =
      expression(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto a = evaluate(*field, t, z), b = evaluate(damped, t, z);
        for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - b[k];
      });
  both(checks, plugin.name(), "field of the damped energies", plugin.name(), difference,
       generic_state(model));
}

}  // namespace

std::vector<Check> check_system(const SystemPlugin& plugin) {
  const auto model = plugin.make({});
  const int n = model->dimension();
  std::vector<Check> checks;
  const std::vector<Real> centre = generic_state(*model);
  // What the author wrote against what is derived without it.
  constexpr std::array<std::pair<Formula, const char*>, 4> overrides{{{Formula::field, "field"},
                                                                      {Formula::force, "force"},
                                                                      {Formula::velocity, "velocity"},
                                                                      {Formula::chart_field, "chart field"}}};
  for (const auto& [formula, name] : overrides) {
    if (!model->given(formula)) continue;
    const auto derived = model->derived(formula);
    if (derived == nullptr) continue;
    const auto given = model->tape(formula);
    const auto difference = expression(given->inputs, static_cast<int>(given->outputs.size()),
                                       [&](const Recorded& t, Arguments z, Results out) {
                                         const auto a = evaluate(*given, t, z), b = evaluate(*derived, t, z);
                                         for (std::size_t k = 0; k < a.size(); ++k) out[k] = a[k] - b[k];
                                       });
    const std::vector<Real> where(centre.begin(), centre.begin() + given->inputs);
    both(checks, plugin.name(), std::string("written ") + name + " is the derived one", plugin.name(),
         difference, where);
  }
  if (model->facets().has(Facet::hamiltonian) || model->facets().has(Facet::structure)) {
    const auto tensor = model->tape(Formula::poisson_tensor);
    both(checks, plugin.name(), "bracket is skew", plugin.name(), symmetric_part(*tensor, n), centre);
    both(checks, plugin.name(), "Jacobi identity", plugin.name(), jacobiator(*tensor, n), centre);
  }
  if (model->facets().has(Facet::structure)) {
    for (Check& check : check_self_adjointness(plugin.name(), *model)) checks.push_back(std::move(check));
  }
  if (model->facets().has(Facet::darboux_chart)) darboux(checks, plugin, *model);
  if (model->facets().has(Facet::conformal)) conformal(checks, plugin, *model);
  if (model->facets().has(Facet::generating_map)) {
    const GeneratingMapCheck alpha = check_generating_map(*model);
    checks.push_back(
        named(plugin.name(), "alpha satisfies (34)", plugin.name(), "quad", alpha.residual, 1e-31));
    if (!alpha.holds) checks.back().result = CheckResult::fail;
    checks.back().reason = alpha.message;
  }
  invariants(checks, plugin, *model, *motion_of(model));
  if (model->facets().has(Facet::exact_solution)) exact_solution(checks, plugin, *model, *motion_of(model));
  return checks;
}

namespace {
// The tensor of a sharp map, column by column.
std::shared_ptr<const Tape> tensor_of(const Tape& sharp, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    for (std::size_t j = 0; j < size; ++j) {
      std::vector<Recorded> x(z.begin(), z.end());
      x.resize(2 * size);
      x[size + j] = Recorded(1);
      const auto column = evaluate(sharp, t, x);
      for (std::size_t i = 0; i < size; ++i) out[i * size + j] = column[i];
    }
  });
}
std::vector<Real> bracket_point(int n) {
  std::vector<Real> z;
  for (int k = 0; k < n; ++k) z.push_back(Real::fraction(3 + 2 * k, 7));
  return z;
}
}  // namespace

std::vector<Check> check_bracket(const std::string& name) {
  const BracketPlugin& plugin = brackets().get(name, "bracket");
  const BracketInstance bracket = plugin.make({});
  const auto tensor = tensor_of(*bracket.sharp, bracket.dimension);
  std::vector<Check> checks;
  const std::vector<Real> centre = bracket_point(bracket.dimension);
  if (plugin.descriptor().symmetry == Symmetry::skew)
    both(checks, name, "skew", "", symmetric_part(*tensor, bracket.dimension), centre);
  if (plugin.descriptor().jacobi)
    both(checks, name, "Jacobi identity", "", jacobiator(*tensor, bracket.dimension), centre);
  return checks;
}

std::vector<Check> check_false_brackets() {
  std::vector<Check> checks;
  // {f, g} = a.(grad f x grad g) obeys Jacobi exactly when a.curl a = 0; here a = (y, -x, 1), a.curl a = -2.
  const auto twisted = record(3, 9, [](const Recorded&, Arguments z, Results out) {
    const std::array<Recorded, 3> a{z[1], -z[0], Recorded(1)};
    out[1] = a[2];
    out[3] = -a[2];
    out[5] = a[0];
    out[7] = -a[0];
    out[6] = a[1];
    out[2] = -a[1];
  });
  const auto lopsided = record(2, 4, [](const Recorded&, Arguments z, Results out) {
    out[1] = z[0];
    out[2] = z[0] * Recorded(Real::fraction(-999999, 1000000));
  });
  const auto control = [&](const char* plugin, const char* claim, double measured) {
    Check check = named(plugin, claim, "", "quad", measured, 1e-31);
    check.scope = "control";
    check.control = true;
    check.result = measured <= check.tolerance ? CheckResult::pass : CheckResult::rejected;
    checks.push_back(check);
  };
  control("bracket a x grad, a.curl a = -2", "Jacobi identity",
          static_cast<double>(largest<Quad>(jacobiator(twisted, 3), bracket_point(3))));
  control("bracket skew but for 1e-6", "skew",
          static_cast<double>(largest<Quad>(symmetric_part(lopsided, 2), bracket_point(2))));
  return checks;
}

}  // namespace pfaff
