// The claims of systems with constraints: that the state they start from is on the constraints, that these
// are second class there, that what was written of them is what is derived, and that Dirac's formulation
// keeps them, off their surface too.
#include <stdexcept>

#include <pfaff/bench/measure/constraint_brackets.hpp>
#include <pfaff/bench/verification/residuals.hpp>
#include <pfaff/core/formulation.hpp>

namespace pfaff {

namespace {

// As residuals that stand before the sizes of the terms they are made of: the largest ratio, at random states
// near `centre`.
template <class T>
double largest_ratio(const std::shared_ptr<const Tape>& tape, const std::vector<Real>& centre) {
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  Replay<T> replay(tape);
  const std::size_t half = tape->outputs.size() / 2;
  std::vector<T> z(centre.size()), out(tape->outputs.size());
  double worst = 0;
  for (int k = 0; k < points; ++k) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = T(centre[i]) + T(offset(random));
    replay(T(1 + offset(random)), z.data(), out.data());
    for (std::size_t i = 0; i < half; ++i) {
      const auto ratio = static_cast<double>(abs(out[i]) / (T(1) + out[half + i]));
      worst = std::isnan(ratio) || std::isnan(worst) ? NAN : std::max(worst, ratio);
    }
  }
  return worst;
}

Recorded size_of(const Recorded& x) { return select(x, x, -x); }

// d phi / dt along the motion, and the sizes of its terms.
std::shared_ptr<const Tape> rates_along(const Tape& phi, const Tape& slopes, const Tape& field) {
  const auto count = phi.outputs.size();
  return expression(phi.inputs, static_cast<int>(2 * count),
                    [&](const Recorded& t, Arguments z, Results out) {
                      const auto x = evaluate(field, t, z), rows = evaluate(slopes, t, z);
                      const auto rest = time_derivative(phi, t, z);
                      for (std::size_t i = 0; i < count; ++i) {
                        out[i] = rest[i];
                        out[count + i] = size_of(rest[i]);
                        for (std::size_t a = 0; a < z.size(); ++a) {
                          if (structurally_zero(rows[i * z.size() + a])) continue;
                          const Recorded term = rows[i * z.size() + a] * x[a];
                          out[i] = out[i] + term;
                          out[count + i] = out[count + i] + size_of(term);
                        }
                      }
                    });
}

// The residual of the constraints at the state of the descriptor, at t = 0.
template <class T>
Check initial_residual(const std::string& name, const Model& model, const char* precision, double tolerance) {
  std::vector<T> z;
  for (const Real& x : model.initial()) z.push_back(T(x));
  const ConstraintBrackets<T> at = constraint_brackets(model, T(0), z);
  double worst = 0;
  std::string which;
  for (std::size_t k = 0; k < at.values.size(); ++k)
    if (const auto size = static_cast<double>(abs(at.values[k])); !(size <= worst)) {
      worst = size;
      which = model.constraint_names()[k];
    }
  Check check = named(name, "initial state is on the constraints", name, precision, worst, tolerance);
  check.scope = "initial state";
  if (check.result == CheckResult::fail) check.reason = "constraint " + which;
  return check;
}

// How many constraints are not second class there.
template <class T>
Check independence(const std::string& name, const Model& model, const char* precision) {
  std::vector<T> z;
  for (const Real& x : model.initial()) z.push_back(T(x));
  const ConstraintBrackets<T> at = constraint_brackets(model, T(0), z);
  const double missing =
      at.finite ? static_cast<double>(at.values.size()) - static_cast<double>(at.classes.rank()) : NAN;
  Check check = named(name, "constraints are second class", name, precision, missing, 0);
  check.scope = "initial state";
  if (check.result == CheckResult::fail)
    check.reason = at.finite ? describe(at.classes, model.constraint_names()) : "not finite";
  return check;
}

std::vector<Check> check_constraints_of(const std::string& name, const Model& model, const Model& motion) {
  std::vector<Check> checks;
  // A few operations on numbers of order one to ten.
  checks.push_back(initial_residual<double>(name, model, "double", 1e-14));
  checks.push_back(initial_residual<Quad>(name, model, "quad", 1e-32));
  checks.push_back(independence<double>(name, model, "double"));
  checks.push_back(independence<Quad>(name, model, "quad"));
  const auto phi = model.tape(Formula::constraints), slopes = model.tape(Formula::constraint_gradients);
  const std::vector<std::string> names = model.constraint_names();
  if (model.given(Formula::constraint_gradients)) {
    const auto derived = model.derived(Formula::constraint_gradients);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto n = static_cast<std::size_t>(model.dimension());
      const auto difference =
          expression(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
            const auto a = evaluate(*slopes, t, z), b = evaluate(*derived, t, z);
            for (std::size_t k = 0; k < n; ++k) out[k] = a[i * n + k] - b[i * n + k];
          });
      both(checks, name, "written gradient of " + names[i] + " is the derived one", name, difference,
           model.initial());
    }
  }
  const auto rates =
      rates_along(*phi, *model.derived(Formula::constraint_gradients), *motion.tape(Formula::field));
  // Relative to the terms; the solve with W amplifies their rounding by its condition, up to a hundred.
  checks.push_back(named(name, "constraints are kept by " + motion.source().formulation, name, "double",
                         largest_ratio<double>(rates, model.initial()), 1e-13));
  checks.push_back(named(name, "constraints are kept by " + motion.source().formulation, name, "quad",
                         largest_ratio<Quad>(rates, model.initial()), 1e-31));
  return checks;
}

// Everything that methods and formulations ask of the constraints, as one list of numbers.
template <class T>
std::vector<T> everything(HolonomicConstraints<T>& c, const T& t, const std::vector<T>& z) {
  const std::size_t n = c.degrees(), count = c.count();
  const In<T> q = In<T>(z).first(n), p = In<T>(z).subspan(n);
  std::vector<T> all, of_count(count), of_degrees(n), u(n), x(count);
  for (std::size_t k = 0; k < n; ++k) u[k] = sin(T(static_cast<int>(k) + 1));
  for (std::size_t k = 0; k < count; ++k) x[k] = cos(T(static_cast<int>(2 * k) + 1));
  const auto keep = [&](std::span<const T> numbers) {
    all.insert(all.end(), numbers.begin(), numbers.end());
  };
  const auto of_position_level = [&] {
    c.apply(u, of_count), keep(of_count);
    c.apply_transpose(x, of_degrees), keep(of_degrees);
    c.solve(x, of_count), keep(of_count);
    c.hidden_by_momentum(u, of_count), keep(of_count);
    c.hidden_by_momentum_transpose(x, of_degrees), keep(of_degrees);
  };
  c.values(t, q, of_count), keep(of_count);
  c.hidden_values(t, q, p, of_count), keep(of_count);
  c.velocity(t, q, p, of_degrees), keep(of_degrees);
  c.force(t, q, p, of_degrees), keep(of_degrees);
  if (c.linearise(t, q, p) != Status::converged) return {T(NAN)};
  of_position_level();
  if (c.place(t, q, p) != Status::converged) return {T(NAN)};
  of_position_level();
  for (const auto numbers : {c.residuals(), c.hidden(), c.hidden_rates(), c.velocities(), c.forces()})
    keep(numbers);
  std::vector<T> friction(c.friction().begin(), c.friction().end());
  friction.resize(n);  // none is no friction
  keep(friction);
  c.hidden_by_position(u, of_count), keep(of_count);
  c.hidden_by_position_transpose(x, of_degrees), keep(of_degrees);
  return all;
}

// What an author's own evaluator of the constraints computes, against the evaluator made from the tapes.
template <class T>
Check written_evaluator(const std::string& name, const Model& model, const char* precision,
                        double tolerance) {
  ModelSource source = model.source();
  source.holonomic = nullptr;
  const Model derived(std::move(source));
  const auto written = model.holonomic_constraints<T>(), taped = derived.holonomic_constraints<T>();
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  std::vector<T> z(model.initial().size());
  double worst = 0;
  for (int k = 0; k < points; ++k) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = T(model.initial()[i]) + T(offset(random));
    const T t(1 + offset(random));
    const std::vector<T> a = everything(*written, t, z), b = everything(*taped, t, z);
    if (a.size() != b.size()) worst = NAN;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      const auto difference = static_cast<double>(abs(a[i] - b[i]) / (T(1) + abs(b[i])));
      worst = std::isnan(difference) || std::isnan(worst) ? NAN : std::max(worst, difference);
    }
  }
  return named(name, "written constraints are the derived ones", name, precision, worst, tolerance);
}

}  // namespace

std::vector<Check> check_constraints(const std::string& name, const std::shared_ptr<const Model>& model) {
  const auto motion = formulations().get("dirac", "formulation").apply(model, {});
  std::vector<Check> checks = check_constraints_of(name, *model, *motion);
  if (model->source().holonomic != nullptr) {
    // Two orders of summation and of elimination: rounding times the condition of S, up to a hundred.
    checks.push_back(written_evaluator<double>(name, *model, "double", 1e-12));
    checks.push_back(written_evaluator<Quad>(name, *model, "quad", 1e-30));
  }
  return checks;
}

namespace {

// A particle in the plane on the line x = y, seen with constraints of the phase space, and what can be wrong
// with them.
struct Line {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 2;
  bool off = false, wrong_gradient = false, dependent = false;
  static std::vector<std::string> constraint_names() { return {"line", "momentum"}; }
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(Real::fraction(1, 2));
    z[1] = z[0] + T(off ? Real::fraction(1, 1000000) : Real(0));
    z[2] = z[3] = T(1);
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3]) / 2 + cos(z[0]) + z[1] * z[1];
  }
  template <class T>
  void constraints(const T& /*t*/, In<T> z, Out<T> phi) const {
    phi[0] = z[0] * z[0] - z[1] * z[1];
    phi[1] = dependent ? 3 * (z[0] - z[1]) * (z[0] + z[1]) : T(z[2] - z[3]);
  }
  template <class T>
  void constraint_gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    rows[0] = 2 * z[0];
    rows[1] = -2 * z[1];
    if (wrong_gradient) rows[1] = rows[1] * Real::fraction(1000001, 1000000);
    if (dependent) {
      rows[4] = 6 * z[0];
      rows[5] = -6 * z[1];
    } else {
      rows[6] = T(1);
      rows[7] = T(-1);
    }
  }
};

}  // namespace

std::vector<Check> check_false_constraints() {
  std::vector<Check> controls;
  // The claims that start with `claim`, which have to fail.
  const auto control = [&](const std::string& what, const std::string& claim,
                           const std::vector<Check>& checks) {
    const std::size_t before = controls.size();
    for (Check check : checks) {
      if (!check.claim.starts_with(claim) || check.precision != "quad") continue;
      check.plugin = what;
      check.system.clear();
      check.scope = "control";
      check.control = true;
      check.result = check.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
      controls.push_back(check);
    }
    if (controls.size() == before) throw std::logic_error(what + ": no claim is called " + claim);
  };
  const auto checks_of = [](const Line& line, const char* formulation) {
    const auto model = make_model(SystemDescriptor{.name = "line", .title = "", .reference = ""}, line);
    const auto motion = formulations().get(formulation, "formulation").apply(model, {});
    return check_constraints_of("line", *model, *motion);
  };
  control("line, initial state moved by 1e-6", "initial state", checks_of({.off = true}, "dirac"));
  control("line, one gradient entry changed by 1e-6", "written gradient of line",
          checks_of({.wrong_gradient = true}, "dirac"));
  control("line, the same constraint twice", "constraints are second class",
          checks_of({.dependent = true}, "dirac"));
  control("line, the same constraint twice", "constraints are kept", checks_of({.dependent = true}, "dirac"));
  // Off the surface the simplified equations let the constraints of positions drift.
  const SystemPlugin& pendulum = systems().get("spherical-pendulum", "system");
  const auto model = pendulum.make({});
  control("simplified-dirac keeps phi off the surface", "constraints are kept",
          check_constraints_of(pendulum.name(), *model,
                               *formulations().get("simplified-dirac", "formulation").apply(model, {})));
  return controls;
}

}  // namespace pfaff
