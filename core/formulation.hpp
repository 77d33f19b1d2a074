// What the author of a formulation includes. A formulation makes a vector field of a system with constraints.
//
// F is a struct in an anonymous namespace that holds parameters and makes a field of holonomic constraints:
//   template <class T> struct Work { Work(const F& formulation, HolonomicConstraints<T>& constraints); … };
//   template <class T> Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p,
//                                   Out<T> q_rate, Out<T> p_rate, Work<T>& work) const;
// `field` must not compare values, because it is also run with the recording scalar, which has none. Work is
// made once and belongs to the constraints it was made with. Its constructor is the place to ask for what
// does not change from step to step, such as the fast rates that some constraints offer
// (HolonomicConstraints::rates).
//
// Optional members of F. One of these names with another signature is refused by the compiler, which says
// what was expected.
//   static parameters()       the settings of the formulation
//   field_tape(model)         the field as a tape for constraints of the phase space, phi(z, t) = 0
//   keeps()                   instead of the descriptor's list, where what is kept depends on parameters
//   friction()                the form that the system's friction takes (FrictionForm); without this member
//                             friction is left out
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
  energy        // H' = 0 on and off the surface; systems without friction that do not depend on time
};

constexpr std::string_view to_string(FormulationClaim claim) {
  constexpr std::array<std::string_view, 5> names{"none", "tangent", "hidden-constraints", "constraints",
                                                  "energy"};
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

 private:
  FormulationDescriptor descriptor_;
};

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace detail::formulation {
PFAFF_MEMBER_NAME(field_tape)
PFAFF_MEMBER_NAME(keeps)
PFAFF_MEMBER_NAME(friction)
PFAFF_MEMBER_NAME(instances)
}  // namespace detail::formulation

namespace detail {

template <class F>
concept WritesFormulationWork = requires {
  typename F::template Work<double>;
  requires std::constructible_from < typename F::template Work<double>,
  const F&, HolonomicConstraints<double>& > ;
};
template <class F>
concept WritesFormulationField = requires(const F& f, HolonomicConstraints<double>& constraints,
                                          const double& t, In<double> z, Out<double> rate,
                                          typename F::template Work<double>& work) {
  { f.field(constraints, t, z, z, rate, rate, work) } -> std::same_as<Status>;
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
  static_assert(WritesFormulationWork<F>,
                "Work: expected template <class T> struct Work with a constructor Work(const F&, "
                "HolonomicConstraints<T>&)");
  static_assert(WritesFormulationField<F>,
                "field: expected template <class T> Status field(HolonomicConstraints<T>& constraints, const "
                "T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate, Work<T>& work) const");
  static_assert(WritesFieldTape<F> || !formulation::has_field_tape<F>,
                "field_tape: expected Tape field_tape(const Model& model) const");
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
  struct Object {
    F formulation;
    std::unique_ptr<HolonomicConstraints<T>> constraints;
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
    auto constraints = model->template holonomic_constraints<T>();
    typename F::template Work<T> work(formulation, *constraints);
    return {formulation, std::move(constraints), std::move(work)};
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
    return facets(of_phase_space ? Facet::constraints : Facet::holonomic);
  }
  [[nodiscard]] std::string refuses(const Model& model) const override {
    if (!model.constrained() || !model.source().formulation.empty())
      return "formulation " + name() + " needs a system with constraints; " + model.name() + " offers " +
             to_string(model.facets());
    if (!of_phase_space && !model.facets().has(Facet::holonomic))
      return "formulation " + name() + " needs holonomic; " + model.name() + " offers " +
             to_string(model.facets());
    return {};
  }
  [[nodiscard]] std::shared_ptr<const Model> apply(const std::shared_ptr<const Model>& model,
                                                   const Assignments& assignments) const override {
    return on_behalf_of("formulation " + name(), [&]() -> std::shared_ptr<const Model> {
      const F object = make(assignments);
      if (const std::string reason = refuses(*model); !reason.empty()) throw InputError(reason);
      ModelSource source = model->source();
      source.formulation = name();
      source.formulation_parameters = resolved(parameters(), &object);
      source.given[index(Formula::field)] = nullptr;
      source.compiled[index(Formula::field)] = nullptr;
      if (model->facets().has(Facet::holonomic)) {
        source.programs[index(Formula::field)] = std::make_shared<const Program<detail::FormulatedField<F>>>(
            detail::FormulatedField<F>{model, object});
        return std::make_shared<const Model>(std::move(source));
      }
      if constexpr (of_phase_space)
        source.given[index(Formula::field)] = std::make_shared<const Tape>(object.field_tape(*model));
      return std::make_shared<const Model>(std::move(source));
    });
  }
  [[nodiscard]] FormulationStatement states(const Assignments& assignments) const override {
    FormulationStatement statement{descriptor().reactions, FrictionForm::none, descriptor().keeps};
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

  [[nodiscard]] F make(const Assignments& assignments) const {
    F object;
    assign_all(parameters(), &object, assignments, "formulation " + name());
    return object;
  }
};

}  // namespace pfaff
