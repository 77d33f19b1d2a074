// The claims of formulations. They are statements about the right-hand side at single points, and are
// measured at points, without any integration.
#include <pfaff/verify/formulation_checks.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/dense_motion.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

constexpr int states_on_surface = 4, states_off_surface = 6;
constexpr int small = 8, large = 96;  // dimensions
constexpr const char* tilted_field = ", its field tilted by 1e-6";

// True where the offsets b of velocity constraints vanish.
bool homogeneous(const Model& model) {
  const Tape& b = *model.tape(Formula::velocity_offsets);
  return std::all_of(b.outputs.begin(), b.outputs.end(), [&](int slot) {
    const Instruction& i = b.code[static_cast<std::size_t>(slot)];
    return i.operation == Operation::constant && b.constants[static_cast<std::size_t>(i.a)].is(0);
  });
}

template <class T>
constexpr const char* precision = std::is_same_v<T, Quad> ? "quad" : "double";

// The worst values over all points, each relative to a bound of the rounding that goes into it, in units of
// round-off. The bounds come from the recorded formula of the right-hand side.
struct Measured {
  double definition = 0, constraints = 0, hidden = 0, velocities = 0, energy = 0, inadmissible = 0;
  bool canonical = false, defined = false, anywhere = false;
  double moved = 0;  // how far reversed reactions move the field

  static void note(double& worst, double value) {
    worst = std::isnan(value) || std::isnan(worst) ? NAN : std::max(worst, value);
  }
  // The largest, and not-a-number where one is.
  static double worst_of(std::initializer_list<double> values) {
    double worst = 0;
    for (const double value : values) note(worst, value);
    return worst;
  }
  void at(const DenseMotion& motion, const std::vector<Quad>& field, const std::vector<Quad>& bounds,
          const std::vector<Quad>& expected) {
    anywhere = true;
    const DenseMotion::Rates rates = motion.rates(field, bounds);
    note(constraints, rates.constraints);
    note(hidden, rates.hidden);
    note(velocities, rates.velocities);
    note(inadmissible, rates.inadmissible);
    note(energy, rates.energy);
    defined = !expected.empty();
    if (!defined) return;
    // Reactions mix what is of one unit: of canonical coordinates the rates of positions and those of
    // momenta.
    const std::size_t parts = canonical ? 2 : 1, size = field.size() / parts;
    for (std::size_t part = 0; part < parts; ++part) {
      Quad bound(0);
      for (std::size_t k = part * size; k < (part + 1) * size; ++k) bound = std::max(bound, bounds[k]);
      for (std::size_t k = part * size; k < (part + 1) * size; ++k) {
        const Quad difference = abs(field[k] - expected[k]);
        note(definition, difference == Quad(0) ? 0 : static_cast<double>(difference / bound));
      }
    }
  }
};

class FormulationChecker {
 public:
  FormulationChecker(const FormulationPlugin& plugin, const Assignments& parameters,
                     std::shared_ptr<const Model> model)
      : plugin_(plugin),
        parameters_(parameters),
        model_(std::move(model)),
        statement_(plugin.states(parameters)),
        formulated_(plugin.apply(model_, parameters)),
        motion_(*model_) {
    const bool moving = !model_->tape(Formula::constraints)->autonomous() ||
                        !model_->tape(Formula::hamiltonian)->autonomous();
    const bool dissipates = !model_->frictionless() || model_->given(Formula::symmetric_tensor);
    energy_in_scope_ =
        !moving && !model_->forced() && (!dissipates || statement_.friction == FrictionForm::none);
  }

  std::vector<Check> run() {
    measure<double>();
    measure<Quad>();
    return std::move(checks_);
  }

 private:
  [[nodiscard]] bool claims(FormulationClaim claim) const {
    return std::find(statement_.keeps.begin(), statement_.keeps.end(), claim) != statement_.keeps.end();
  }
  // True where the reactions are defined off the surface of the constraints too. On the surface their
  // directions define them; off it this takes, in addition, a claim about what they keep. An energy defines
  // its motion everywhere.
  [[nodiscard]] bool defined_everywhere() const {
    return statement_.of_an_energy || claims(FormulationClaim::constraints) ||
           claims(FormulationClaim::velocity_constraints) ||
           (statement_.reactions == Reactions::ideal && claims(FormulationClaim::hidden_constraints));
  }

  template <class T>
  void measure() {
    Measured on, off, reversed_on, reversed_off;
    for (Measured* m : {&on, &off, &reversed_on, &reversed_off}) m->canonical = model_->canonical();
    std::mt19937_64 random(20044);
    std::uniform_real_distribution<double> offset(-0.05, 0.05);
    const Evaluator<T> field = make_evaluator<T>(formulated_, Formula::field);
    Replay<WithRounding<T>> bounding(formulated_->tape(Formula::field));
    const std::vector<double> scales = coordinate_scales(*formulated_);
    const Quad time = own_time(*formulated_, Real(0), model_->initial());
    for (int k = 0; k < states_on_surface + states_off_surface; ++k) {
      const bool surface = k < states_on_surface;
      const T t(Real(time * Quad(1 + offset(random))));
      std::vector<Quad> state;
      for (std::size_t i = 0; i < scales.size(); ++i)
        state.push_back(model_->initial()[i].quad() + Quad(offset(random) * scales[i]));
      if (surface && project_onto_constraints(*model_, Quad(t), state).status != Status::converged) continue;
      std::vector<T> z, rate(state.size());
      for (const Quad& x : state) z.push_back(static_cast<T>(x));
      field.call(field.context, t, z.data(), rate.data());
      motion_.place(Quad(t), {z.begin(), z.end()});
      // A state on the surface is a rounded one, to the scale of each coordinate: zero is what others leave.
      std::vector<WithRounding<T>> exact(z.begin(), z.end());
      for (std::size_t i = 0; i < scales.size() && surface; ++i)
        exact[i].error = std::max(T(abs(z[i])), T(scales[i]));
      std::vector<WithRounding<T>> bounded(z.size());
      bounding(WithRounding<T>(t), exact.data(), bounded.data());
      std::vector<Quad> bounds;
      for (const WithRounding<T>& x : bounded) bounds.push_back(Quad(x.error));
      const std::vector<Quad> given(rate.begin(), rate.end()), expected = motion_.field(statement_);
      (surface ? on : off).at(motion_, given, bounds, expected);
      Measured& wrong = surface ? reversed_on : reversed_off;
      const std::vector<Quad> turned = reversed(given);
      wrong.at(motion_, turned, bounds, expected);
      for (std::size_t i = 0; i < turned.size(); ++i)
        if (turned[i] != given[i])
          Measured::note(wrong.moved, static_cast<double>(abs(turned[i] - given[i]) / bounds[i]));
      wrong.energy = motion_.rates(tilted(given), bounds).energy;
    }
    judge<T>(on, off, false);
    if constexpr (std::is_same_v<T, Quad>) judge<T>(reversed_on, reversed_off, true);
  }

  // The field with the opposite sign of the reactions in the momenta, which are the second half of the state,
  // and where an energy makes the motion in the positions too, whose velocities it changes.
  [[nodiscard]] std::vector<Quad> reversed(std::vector<Quad> field) const {
    const std::vector<Quad> free = motion_.free_field();
    for (std::size_t k = statement_.of_an_energy ? 0 : field.size() / 2; k < field.size(); ++k)
      field[k] = Quad(2) * free[k] - field[k];
    return field;
  }

  // The field with a little of the energy's gradient added.
  [[nodiscard]] std::vector<Quad> tilted(std::vector<Quad> field) const {
    const std::vector<Quad> gradient = motion_.energy_gradient();
    for (std::size_t k = 0; k < field.size(); ++k) field[k] = field[k] - Quad(1e-6) * gradient[k];
    return field;
  }

  template <class T>
  void judge(const Measured& on, const Measured& off, bool control) {
    const auto check = [&](const std::string& claim, const char* scope, bool in_scope, double measured,
                           const char* wrong = ", its reactions reversed") {
      if (control && !in_scope) return;
      // Where there are no reactions, reversed ones are the same motion, which is rightly found sound.
      const bool of_reactions = std::string_view(wrong) != tilted_field;
      const bool at_surface = std::string_view(scope) == "on the surface";
      if (control && of_reactions && !((at_surface ? on : off).moved > residual_tolerance<T>())) return;
      Check& c = checks_.emplace_back();
      c.plugin = plugin_.name() + (control ? wrong : "");
      c.claim = claim;
      c.scope = control ? "control" : scope;
      c.system = model_->name();
      c.precision = precision<T>;
      c.parameters = parameters_;
      c.measured = measured;
      c.tolerance = residual_tolerance<T>();
      c.in_scope = in_scope;
      c.control = control;
      if (!on.anywhere) c.reason = "no state near the initial one could be moved onto the constraints";
      const bool holds = c.reason.empty() && measured <= c.tolerance;
      c.result = control    ? holds ? CheckResult::pass : CheckResult::rejected
                 : in_scope ? holds ? CheckResult::pass : CheckResult::fail
                            : CheckResult::measured;
    };
    const bool hidden = model_->facets().has(Facet::holonomic);
    if (on.defined) {
      check("field is its definition", "on the surface", claims(FormulationClaim::tangent), on.definition);
      check("field is its definition", "off the surface", defined_everywhere(), off.definition);
    }
    check("tangent", "on the surface", claims(FormulationClaim::tangent),
          Measured::worst_of({on.constraints, on.hidden, on.velocities}));
    if (hidden)
      check("keeps hidden-constraints", "off the surface", claims(FormulationClaim::hidden_constraints),
            off.hidden);
    if (model_->nonholonomic()) return judge_velocities(check, on, off);
    check("keeps constraints", "off the surface", claims(FormulationClaim::constraints),
          Measured::worst_of({off.constraints, off.hidden}));
    if (energy_in_scope_)
      check("keeps energy", "off the surface", claims(FormulationClaim::energy), off.energy, tilted_field);
  }

  // The claims about velocity constraints.
  template <class Judge>
  void judge_velocities(const Judge& check, const Measured& on, const Measured& off) {
    check("keeps velocity-constraints", "off the surface", claims(FormulationClaim::velocity_constraints),
          off.velocities);
    check("admissible", "off the surface", claims(FormulationClaim::admissible), off.inadmissible);
    if (energy_in_scope_ && homogeneous(*model_))
      check("keeps energy-on-surface", "on the surface", claims(FormulationClaim::energy_on_surface),
            on.energy, tilted_field);
  }

  const FormulationPlugin& plugin_;
  const Assignments& parameters_;
  std::shared_ptr<const Model> model_;
  FormulationStatement statement_;
  std::shared_ptr<const Model> formulated_;
  DenseMotion motion_;
  bool energy_in_scope_ = false;
  std::vector<Check> checks_;
};

}  // namespace

bool verified_on(const FormulationPlugin& plugin, const Assignments& parameters, const Model& model) {
  if (!plugin.refuses(model).empty() || model.dimension() > large) return false;
  return parameters == plugin.instances(false).front() || model.dimension() <= small || !model.frictionless();
}

std::vector<Check> check_formulation(const FormulationPlugin& plugin, const Assignments& parameters,
                                     const std::shared_ptr<const Model>& model) {
  return FormulationChecker(plugin, parameters, model).run();
}

}  // namespace pfaff
