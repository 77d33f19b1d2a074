// The claims of systems with constraints: the initial state is on the constraints, these are second class
// there, or independent where they constrain velocities, evaluators compute what is derived, and the default
// formulation keeps the constraints, off their surface too. (Gradients that an author writes are compared
// with derived ones, as all formulas are, in override_checks.cpp.)
#include <algorithm>
#include <array>
#include <charconv>

#include <pfaff/core/facets/conformance/constraint_identities.hpp>
#include <pfaff/core/facets/conformance/velocity_identities.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/rounded_terms.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

// The rates d phi / dt along the motion.
std::shared_ptr<const Tape> rates_along(const Tape& phi, const Tape& slopes, const Tape& field) {
  const auto count = phi.outputs.size();
  return expression(phi.inputs, static_cast<int>(count), [&](const Recorded& t, Arguments z, Results out) {
    const auto x = evaluate(field, t, z), rows = evaluate(slopes, t, z);
    const auto rest = time_derivative(phi, t, z);
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = rest[i];
      for (std::size_t a = 0; a < z.size(); ++a)
        if (!structurally_zero(rows[i * z.size() + a])) out[i] = out[i] + rows[i * z.size() + a] * x[a];
    }
  });
}

// Whether a number is what a double prints, to all digits that tell it from its neighbours: such a one, of a
// program that computes in doubles, stands for any number that they round to it.
bool printed_from_double(const Real& x) {
  constexpr std::size_t digits_of_all_doubles = 15;
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x.value()).ptr;
  const std::string text(buffer.data(), end);
  const auto digits = std::count_if(text.begin(), std::find(text.begin(), text.end(), 'e'),
                                    [](char c) { return c >= '0' && c <= '9'; });
  const std::optional<Real> read = Real::parse(text);
  return read && read->quad() == x.quad() && static_cast<std::size_t>(digits) >= digits_of_all_doubles;
}

// The residual of the constraints at the state of the descriptor, at t = 0. It is allowed eight times what
// the roundings of the state make of it to first order, since whoever computes a state rounds more than once;
// numbers that were printed from doubles are known to their last digit.
template <class T>
Check initial_residual(const std::string& name, const Model& model, const Model& motion,
                       const char* precision) {
  constexpr double allowed_roundings = 8;
  const T unit = unit_roundoff<T>();
  // A number that is smaller than its scale is what is left of others: at rest, of momenta that cancel.
  const std::vector<double> scales = coordinate_scales(motion, generic_time_of(motion), model.initial());
  std::vector<T> z, sizes;
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const Real& x = model.initial()[k];
    z.push_back(T(x));
    const T known = printed_from_double(x) ? T(unit_roundoff<double>()) / unit : T(1);
    sizes.push_back(std::max(T(scales[k]), T(abs(z.back()) * std::max(T(1), known))));
  }
  const auto phi = model.tape(Formula::constraints);
  Replay<T> replay(phi);
  RoundedTerms<T> terms(phi);
  std::vector<T> values(phi->outputs.size());
  replay(T(0), z.data(), values.data());
  const std::vector<T>& rounded = terms(T(0), z, sizes);
  double worst = 0, worst_allowed = 0;
  std::string which;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto size = static_cast<double>(abs(values[k]));
    const double allowed = allowed_roundings * static_cast<double>(unit * rounded[k]);
    // Of a residual of zero, of which nothing is rounded, every other one is the worse.
    const bool nothing = worst == 0 && worst_allowed == 0;
    if (std::isnan(worst) || (!nothing && size * worst_allowed <= worst * allowed)) continue;
    worst = size, worst_allowed = allowed;
    which = model.constraint_names()[k];
  }
  Check check = named(name, "initial state is on the constraints", name, precision, worst, worst_allowed);
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
  checks.push_back(initial_residual<double>(name, model, motion, "double"));
  checks.push_back(initial_residual<Quad>(name, model, motion, "quad"));
  checks.push_back(independence<double>(name, model, "double"));
  checks.push_back(independence<Quad>(name, model, "quad"));
  const auto phi = model.tape(Formula::constraints);
  const auto rates =
      rates_along(*phi, *model.derived(Formula::constraint_gradients), *motion.tape(Formula::field));
  both(checks, name, "constraints are kept by " + motion.source().formulation, name, rates, model.initial());
  return checks;
}

// The identities that an evaluator must satisfy together with the formulas of the system.
template <class T, class Constraints>
Check evaluator(const std::string& name, Constraints& constraints, const Model& model, const char* claim,
                const char* precision, double tolerance) {
  double worst = 0;
  std::string which;
  for (const ConstraintIdentity& identity : constraint_identities(constraints, model)) {
    const double measured = identity.roundings * static_cast<double>(unit_roundoff<T>());
    if (measured <= worst) continue;
    worst = measured;
    which = identity.operation;
  }
  Check check = named(name, claim, name, precision, worst, tolerance);
  if (check.result == CheckResult::fail) check.reason = "operation " + which;
  return check;
}

// What is claimed of velocity constraints. Holonomic ones beside them are kept at the level of velocities:
// off the surface their positions drift.
std::vector<Check> check_velocity_constraints(const std::string& name, const Model& model,
                                              const Model& motion) {
  std::vector<Check> checks;
  checks.push_back(initial_residual<double>(name, model, motion, "double"));
  checks.push_back(initial_residual<Quad>(name, model, motion, "quad"));
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad());
  const std::string dependent = dependent_velocity_constraints(model, Quad(0), z);
  checks.push_back(named(name, "constraints are independent", name, "quad", dependent.empty() ? 0 : 1, 0));
  checks.back().scope = "initial state";
  checks.back().reason = dependent;
  const auto all = model.tape(Formula::constraints);
  const auto rates =
      rates_along(*all, *model.derived(Formula::constraint_gradients), *motion.tape(Formula::field));
  const std::size_t holonomic = model.source().constraint_names.size();
  const auto kept = expression(model.dimension(), static_cast<int>(all->outputs.size() - holonomic),
                               [&](const Recorded& t, Arguments at, Results out) {
                                 const auto every = evaluate(*rates, t, at);
                                 for (std::size_t k = 0; k < out.size(); ++k)
                                   out[k] = every[k < holonomic ? 2 * k + 1 : holonomic + k];
                               });
  both(checks, name, "constraints are kept by " + motion.source().formulation, name, kept, model.initial());
  // Sums and eliminations in another order, hence the tolerances.
  const char* claim = "evaluated constraints are the derived ones";
  checks.push_back(
      evaluator<double>(name, *model.velocity_constraints<double>(), model, claim, "double", 1e-12));
  checks.push_back(evaluator<Quad>(name, *model.velocity_constraints<Quad>(), model, claim, "quad", 1e-30));
  return checks;
}

}  // namespace

std::vector<Check> check_constraints(const std::string& name, const std::shared_ptr<const Model>& model) {
  const auto motion = motion_of(model);
  if (model->nonholonomic()) return check_velocity_constraints(name, *model, *motion);
  std::vector<Check> checks = check_constraints_of(name, *model, *motion);
  if (model->source().holonomic != nullptr) {
    // The two evaluators sum and eliminate in different orders, so that they differ by rounding times the
    // condition of S, which is up to a hundred.
    const char* claim = "written constraints are the derived ones";
    checks.push_back(
        evaluator<double>(name, *model->holonomic_constraints<double>(), *model, claim, "double", 1e-12));
    checks.push_back(
        evaluator<Quad>(name, *model->holonomic_constraints<Quad>(), *model, claim, "quad", 1e-30));
  }
  return checks;
}

namespace {

// A particle in the plane, held on the line x = y by constraints of the phase space, in versions each of
// which has one thing wrong.
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

// A blade on a plane, held by velocity constraints, in versions each of which has one thing wrong.
struct FaultyBlade {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 2;
  bool off = false, dependent = false, contradicting = false;
  static std::vector<std::string> velocity_constraint_names() { return {"blade", "spin"}; }
  template <class T>
  void initial(Out<T> z) const {
    z[2] = T(1);
    z[3] = cos(T(1)) + T(off ? Real::fraction(1, 1000000) : Real(0));
    z[4] = sin(T(1));
    z[5] = T(dependent ? 0 : 1);
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 + z[0];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[3] = dependent ? T(-3 * sin(q[2])) : T(0);
    rows[4] = dependent ? T(3 * cos(q[2])) : T(0);
    rows[5] = T(dependent ? 0 : 1);
  }
  template <class T>
  void velocity_offsets(const T& /*t*/, In<T> /*q*/, Out<T> b) const {
    b[1] = T(dependent && !contradicting ? 0 : -1);
  }
};

}  // namespace

std::vector<Check> check_false_constraints() {
  std::vector<Check> controls;
  // Makes controls of those checks whose claims start with `claim`: they have to fail.
  const auto control = [&](const std::string& what, const std::string& claim,
                           const std::vector<Check>& checks) {
    add_controls(controls, what, claim, checks, [&](const Check& check) {
      return check.claim.starts_with(claim) && check.precision == "quad";
    });
  };
  const auto checks_of = [](const Line& line) {
    const auto model = make_model(SystemDescriptor{.name = "line", .title = "", .reference = ""}, line);
    std::vector<Check> checks = check_constraints_of("line", *model, *motion_of(model));
    for (Check& check : check_overrides("line", *model, model->initial())) checks.push_back(std::move(check));
    return checks;
  };
  control("line, initial state moved by 1e-6", "initial state", checks_of({.off = true}));
  control("line, one gradient entry changed by 1e-6", "written gradient of line",
          checks_of({.wrong_gradient = true}));
  control("line, the same constraint twice", "constraints are second class", checks_of({.dependent = true}));
  control("line, the same constraint twice", "constraints are kept", checks_of({.dependent = true}));
  const auto checks_of_blade = [](const FaultyBlade& blade) {
    const auto model = make_model(SystemDescriptor{.name = "blade", .title = "", .reference = ""}, blade);
    return check_velocity_constraints("blade", *model, *motion_of(model));
  };
  control("blade, initial state moved by 1e-6", "initial state", checks_of_blade({.off = true}));
  control("blade, the same constraint twice", "constraints are independent",
          checks_of_blade({.dependent = true}));
  control("blade, the same constraint twice", "constraints are kept", checks_of_blade({.dependent = true}));
  control("blade, two constraints that contradict each other", "constraints are independent",
          checks_of_blade({.dependent = true, .contradicting = true}));
  // The simplified equations are valid on the surface only; off it they let the constraints of positions
  // drift, which must be found.
  const SystemPlugin& pendulum = systems().get("spherical-pendulum", "system");
  const auto model = pendulum.make({});
  control("simplified-dirac keeps phi off the surface", "constraints are kept",
          check_constraints_of(pendulum.name(), *model,
                               *formulations().get("simplified-dirac", "formulation").apply(model, {})));
  return controls;
}

}  // namespace pfaff
