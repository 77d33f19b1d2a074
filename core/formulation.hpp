// What the author of a formulation includes. A formulation makes a vector field of a system with constraints.
//
// F is a struct in an anonymous namespace that holds parameters and makes a field of holonomic constraints:
//   template <class T> struct Work { Work(const F& formulation, HolonomicConstraints<T>& constraints); … };
//   template <class T> Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p,
//                                   Out<T> q_rate, Out<T> p_rate, Work<T>& work) const;
// or of velocity constraints, where both take a VelocityConstraints<T>& instead
// (core/facets/velocity_constraints.hpp). `field` must not compare values, because it is also run with the
// recording scalar, which has none. Work is made once and belongs to the constraints it was made with. Its
// constructor is the place to ask for what does not change from step to step, such as the fast rates that
// some constraints offer (HolonomicConstraints::rates).
//
// A formulation of velocity constraints may make an energy instead of a field:
//   Tape hamiltonian_tape(const Model& model) const;   (q, p, t) -> a Hamiltonian
// The motion is then that of this Hamiltonian with the canonical bracket. Its momenta are not restricted, so
// that the model that is made has no constraints and offers all that a Hamiltonian system does.
//
// Optional members of F. One of these names with another signature is refused by the compiler, which says
// what was expected.
//   static parameters()       the settings of the formulation
//   field_tape(model)         the field as a tape for constraints of the phase space, phi(z, t) = 0
//   keeps()                   instead of the descriptor's list, where what is kept depends on parameters
//   friction()                the form that the system's friction takes (FrictionForm); without this member
//                             friction is left out
//   refuses(model)            why it does not fit a model that has the constraints it needs, as a whole
//   message;
//                             empty where it fits
//   static instances(full)    the parameters that verification runs through
// What a formulation says of itself, its reactions, what it keeps and its form of friction, is tested on
// every system that it fits (bench/verification/formulation_checks.cpp).
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <memory>
#include <utility>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/registry/member_names.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace pfaff {

/// What a formulation may claim to keep, each with the scope in which it is tested.
enum class FormulationClaim {
  none,                // an explicit "nothing kept"
  tangent,             // a motion that starts on the surface of the constraints stays on it: phi' = 0 and
                       // phi~' = 0 there; every system
  hidden_constraints,  // phi~' = 0 on and off the surface; systems with holonomic constraints
  constraints,  // phi' = 0 and phi~' = 0 on and off the surface: both are Casimirs of the motion; every
                // system
  energy,       // H' = 0 on and off the surface; systems without friction that do not depend on time
  velocity_constraints,  // psi' = 0 on and off the surface, the rates of holonomic constraints among psi;
                         // systems with velocity constraints
  energy_on_surface,     // H' = 0 on the surface; systems with velocity constraints that do not depend on
                         // time and have no offsets, b = 0
  admissible             // A q' + b = 0 for the velocity q' of the motion, on and off the surface; systems
                         // with velocity constraints
};

constexpr std::string_view to_string(FormulationClaim claim) {
  constexpr std::array<std::string_view, 8> names{"none",
                                                  "tangent",
                                                  "hidden-constraints",
                                                  "constraints",
                                                  "energy",
                                                  "velocity-constraints",
                                                  "energy-on-surface",
                                                  "admissible"};
  return names[static_cast<std::size_t>(claim)];
}

/// The friction of constrained motion, with coefficients Lambda of the momenta. The two forms differ in the
/// reaction of the constraints to it: metriplectic, -Lambda [v - P^T (P Lambda P^T)^-1 P Lambda v], the
/// symmetric Dirac bracket; stokes, -Lambda v + B^T S^-1 P Lambda v, drag with ideal constraint forces.
enum class FrictionForm { metriplectic, stokes, none };

constexpr std::string_view to_string(FrictionForm form) {
  constexpr std::array<std::string_view, 3> names{"metriplectic", "stokes", "none"};
  return names[static_cast<std::size_t>(form)];
}

/// What is said about a formulation.
struct FormulationDescriptor {
  std::string name;           // kebab-case
  std::string title;          // one line
  std::string reference;      // bib key and equations
  std::string description{};  // two to four sentences: what it is, when to take it, where it ends
  Reactions reactions = Reactions::other;
  std::vector<FormulationClaim> keeps{};
};

/// What a formulation says of its right-hand side with given parameters.
struct FormulationStatement {
  Reactions reactions = Reactions::other;
  FrictionForm friction = FrictionForm::none;
  std::vector<FormulationClaim> keeps;
  bool of_an_energy = false;  // the motion is that of a Hamiltonian which the formulation makes
};

/// A registered formulation.
class FormulationPlugin : public Plugin {
 public:
  FormulationPlugin(FormulationDescriptor descriptor, std::vector<Parameter> parameters,
                    const std::type_info& type, const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const FormulationDescriptor& descriptor() const { return descriptor_; }
  /// The parameters and their values after `assignments`; InputError for wrong ones.
  [[nodiscard]] virtual Assignments resolve(const Assignments& assignments) const = 0;
  /// Facets the formulation cannot do without.
  [[nodiscard]] virtual FacetSet needs() const = 0;
  /// Why the formulation does not fit a model, naming both sides; empty when it does.
  [[nodiscard]] virtual std::string refuses(const Model& model) const = 0;
  /// The motion of a constrained model in this formulation: a model that offers a vector field. InputError
  /// where the formulation does not fit.
  [[nodiscard]] virtual std::shared_ptr<const Model> apply(const std::shared_ptr<const Model>& model,
                                                           const Assignments& assignments) const = 0;
  /// What is claimed with these parameters; InputError for wrong ones.
  [[nodiscard]] virtual FormulationStatement states(const Assignments& assignments) const = 0;
  /// The parameters the claims are verified with; `full` asks for more than a quick check needs.
  [[nodiscard]] virtual std::vector<Assignments> instances(bool full) const = 0;

 protected:
  /// What refuses() says of the kinds of constraints: those that the formulation needs against those of a
  /// model.
  [[nodiscard]] std::string misfit(const Model& model) const;

 private:
  FormulationDescriptor descriptor_;
};

/// The motion of a Hamiltonian with the canonical bracket on the coordinates of `model`, whose constraints,
/// solutions and invariants are not those of this motion and are left out. Its energy is the one invariant,
/// where it does not depend on time.
ModelSource motion_of_energy(const Model& model, Tape hamiltonian);

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace detail::formulation {
PFAFF_MEMBER_NAME(field)
PFAFF_MEMBER_NAME(hamiltonian_tape)
PFAFF_MEMBER_NAME(field_tape)
PFAFF_MEMBER_NAME(keeps)
PFAFF_MEMBER_NAME(refuses)
PFAFF_MEMBER_NAME(friction)
PFAFF_MEMBER_NAME(instances)
}  // namespace detail::formulation

namespace detail {

// Constraints is HolonomicConstraints or VelocityConstraints.
template <class F, template <class> class Constraints>
concept WritesFormulationWork = requires {
  typename F::template Work<double>;
  requires std::constructible_from < typename F::template Work<double>,
  const F&, Constraints<double>& > ;
};
template <class F, template <class> class Constraints>
concept WritesFormulationField = requires(const F& f, Constraints<double>& constraints, const double& t,
                                          In<double> z, Out<double> rate,
                                          typename F::template Work<double>& work) {
  { f.field(constraints, t, z, z, rate, rate, work) } -> std::same_as<Status>;
};
template <class F, template <class> class Constraints>
concept MovesConstraints = WritesFormulationWork<F, Constraints> && WritesFormulationField<F, Constraints>;
template <class F>
concept WritesHamiltonianTape = requires(const F& f, const Model& model) {
  { f.hamiltonian_tape(model) } -> std::same_as<Tape>;
};
/// True for formulations of velocity constraints, whether they make a field or an energy.
template <class F>
constexpr bool of_velocities = WritesHamiltonianTape<F> || (MovesConstraints<F, VelocityConstraints> &&
                                                            !MovesConstraints<F, HolonomicConstraints>);
template <class F>
concept WritesReason = requires(const F& f, const Model& model) {
  { f.refuses(model) } -> std::same_as<std::string>;
};
template <class F>
concept WritesFieldTape = requires(const F& f, const Model& model) {
  { f.field_tape(model) } -> std::same_as<Tape>;
};
template <class F>
concept WritesKeeps = requires(const F& f) {
  { f.keeps() } -> std::convertible_to<std::vector<FormulationClaim>>;
};
template <class F>
concept WritesFrictionForm = requires(const F& f) {
  { f.friction() } -> std::same_as<FrictionForm>;
};
template <class F>
concept WritesFormulationInstances = requires(bool full) {
  { F::instances(full) } -> std::convertible_to<std::vector<Assignments>>;
};

/// Refuses, while F is compiled, a struct that makes no field, and members that bear the name of an optional
/// one and cannot be used as one.
template <class F>
constexpr void check_formulation_members() {
  static_assert(WritesHamiltonianTape<F> || !formulation::has_hamiltonian_tape<F>,
                "hamiltonian_tape: expected Tape hamiltonian_tape(const Model& model) const");
  static_assert(
      !formulation::has_hamiltonian_tape<F> || !(formulation::has_field<F> || formulation::has_field_tape<F>),
      "hamiltonian_tape and field or field_tape make two motions of a system: expected one of them");
  if constexpr (!formulation::has_hamiltonian_tape<F>) {
    static_assert(
        WritesFormulationWork<F, HolonomicConstraints> || WritesFormulationWork<F, VelocityConstraints>,
        "Work: expected template <class T> struct Work with a constructor Work(const F&, "
        "HolonomicConstraints<T>&) or Work(const F&, VelocityConstraints<T>&)");
    static_assert(
        MovesConstraints<F, HolonomicConstraints> || MovesConstraints<F, VelocityConstraints>,
        "field: expected template <class T> Status field(HolonomicConstraints<T>& constraints, const "
        "T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate, Work<T>& work) const, or the same of "
        "VelocityConstraints<T>& where Work takes these");
  }
  static_assert(WritesFieldTape<F> || !formulation::has_field_tape<F>,
                "field_tape: expected Tape field_tape(const Model& model) const");
  static_assert(!(formulation::has_field_tape<F> && of_velocities<F>),
                "field_tape is written beside a field of holonomic constraints, which is missing");
  static_assert(WritesReason<F> || !formulation::has_refuses<F>,
                "refuses: expected std::string refuses(const Model& model) const");
  static_assert(WritesKeeps<F> || !formulation::has_keeps<F>,
                "keeps: expected std::vector<FormulationClaim> keeps() const");
  static_assert(WritesFrictionForm<F> || !formulation::has_friction<F>,
                "friction: expected FrictionForm friction() const");
  static_assert(WritesFormulationInstances<F> || !formulation::has_instances<F>,
                "instances: expected static std::vector<Assignments> instances(bool full)");
}

/// The field that F makes of one model, as a formula to be compiled for every scalar (Program).
template <class F>
struct FormulatedField {
  std::shared_ptr<const Model> model;
  F formulation;

  [[nodiscard]] int inputs() const { return model->dimension(); }
  [[nodiscard]] int outputs() const { return model->dimension(); }

  template <class T>
  using Constraints = std::conditional_t<of_velocities<F>, VelocityConstraints<T>, HolonomicConstraints<T>>;

  template <class T>
  struct Object {
    F formulation;
    std::unique_ptr<Constraints<T>> constraints;
    typename F::template Work<T> work;
    void operator()(const T& t, In<T> z, Out<T> rate) {
      const std::size_t n = z.size() / 2;
      const Status status =
          formulation.field(*constraints, t, z.first(n), z.subspan(n), rate.first(n), rate.subspan(n), work);
      // Rates from a factorisation that failed would be meaningless. Not-a-number in their place makes the
      // state non-finite, which steppers report.
      if constexpr (!std::is_same_v<T, Recorded>)
        if (status != Status::converged)
          for (T& x : rate) x = T(std::numeric_limits<double>::quiet_NaN());
    }
  };
  template <class T>
  [[nodiscard]] Object<T> make() const {
    auto constraints = made<T>();
    typename F::template Work<T> work(formulation, *constraints);
    return {formulation, std::move(constraints), std::move(work)};
  }

 private:
  template <class T>
  [[nodiscard]] std::unique_ptr<Constraints<T>> made() const {
    if constexpr (of_velocities<F>) {
      return model->template velocity_constraints<T>();
    } else {
      return model->template holonomic_constraints<T>();
    }
  }
};

}  // namespace detail

/// Registers F when the library that holds it is loaded.
template <class F>
class Formulation final : public FormulationPlugin {
 public:
  explicit Formulation(FormulationDescriptor descriptor,
                       const std::source_location& where = std::source_location::current())
      : FormulationPlugin(std::move(descriptor), parameters_of<F>(), typeid(F), where) {
    detail::check_formulation_members<F>();
    formulations().add(this);
  }
  [[nodiscard]] Assignments resolve(const Assignments& assignments) const override {
    const F object = make(assignments);
    return resolved(parameters(), &object);
  }
  [[nodiscard]] FacetSet needs() const override {
    if constexpr (detail::of_velocities<F>) return facets(Facet::velocity_constraints);
    return facets(of_phase_space ? Facet::constraints : Facet::holonomic);
  }
  [[nodiscard]] std::string refuses(const Model& model) const override {
    std::string reason = misfit(model);
    if constexpr (detail::WritesReason<F>)
      if (reason.empty()) reason = F().refuses(model);
    return reason;
  }
  [[nodiscard]] std::shared_ptr<const Model> apply(const std::shared_ptr<const Model>& model,
                                                   const Assignments& assignments) const override {
    return on_behalf_of("formulation " + name(), [&]() -> std::shared_ptr<const Model> {
      const F object = make(assignments);
      if (const std::string reason = refuses(*model); !reason.empty()) throw InputError(reason);
      ModelSource source = motion(object, model);
      source.formulation = name();
      source.formulation_parameters = resolved(parameters(), &object);
      return std::make_shared<const Model>(std::move(source));
    });
  }
  [[nodiscard]] FormulationStatement states(const Assignments& assignments) const override {
    FormulationStatement statement{descriptor().reactions, FrictionForm::none, descriptor().keeps,
                                   detail::WritesHamiltonianTape<F>};
    const F object = make(assignments);
    if constexpr (detail::WritesFrictionForm<F>) statement.friction = object.friction();
    if constexpr (detail::WritesKeeps<F>) statement.keeps = object.keeps();
    return statement;
  }
  [[nodiscard]] std::vector<Assignments> instances([[maybe_unused]] bool full) const override {
    if constexpr (detail::WritesFormulationInstances<F>) return F::instances(full);
    return {{}};
  }

 private:
  static constexpr bool of_phase_space = detail::WritesFieldTape<F>;

  // What the formulated model is made of.
  static ModelSource motion(const F& object, const std::shared_ptr<const Model>& model) {
    if constexpr (detail::WritesHamiltonianTape<F>) {
      return motion_of_energy(*model, object.hamiltonian_tape(*model));
    } else {
      ModelSource source = model->source();
      constexpr std::size_t field = index(Formula::field);
      source.given[field] = nullptr;
      source.compiled[field] = nullptr;
      if constexpr (of_phase_space)
        if (!model->holonomic()) {
          source.given[field] = std::make_shared<const Tape>(object.field_tape(*model));
          return source;
        }
      source.programs[field] = std::make_shared<const Program<detail::FormulatedField<F>>>(
          detail::FormulatedField<F>{model, object});
      return source;
    }
  }

  [[nodiscard]] F make(const Assignments& assignments) const {
    F object;
    assign_all(parameters(), &object, assignments, "formulation " + name());
    return object;
  }
};

}  // namespace pfaff
