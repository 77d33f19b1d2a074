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
//   refuses(model)            why it does not fit a model that has the constraints it needs. A whole
//                             message, where that of a method is a predicate; empty where the
//                             formulation fits
//   static instances(full)    the parameters that verification runs through
// What a formulation says of itself, its reactions, what it keeps and its form of friction, is tested on
// every system that it fits (verify/formulation_checks.cpp).
#pragma once

#include <limits>
#include <memory>
#include <utility>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/formulation_members.hpp>
#include <pfaff/core/formulation_statement.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace pfaff {

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

namespace detail {

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

/// What two units leave each other of F.
template <class F>
void leave_code_of_formulation() {
  if constexpr (!formulation::writes_hamiltonian_tape<F>) Program<FormulatedField<F>>::leave_code();
}

}  // namespace detail

/// Registers F when the library that holds it is loaded.
template <class F, class Unit = detail::ThisUnit>
class Formulation final : public FormulationPlugin {
 public:
  explicit Formulation(FormulationDescriptor descriptor,
                       const std::source_location& where = std::source_location::current())
      : FormulationPlugin(std::move(descriptor), parameters_of<F>(), typeid(F), where) {
    detail::check_formulation_members<F>();
    detail::leave_code_of_formulation<F>();
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
    if constexpr (detail::formulation::writes_refuses<F>)
      if (reason.empty()) reason = on_behalf_of("formulation " + name(), [&] { return F().refuses(model); });
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
                                   detail::formulation::writes_hamiltonian_tape<F>};
    const F object = make(assignments);
    if constexpr (detail::formulation::writes_friction<F>) statement.friction = object.friction();
    if constexpr (detail::formulation::writes_keeps<F>) statement.keeps = object.keeps();
    return statement;
  }
  [[nodiscard]] std::vector<Assignments> instances([[maybe_unused]] bool full) const override {
    if constexpr (detail::formulation::writes_instances<F>)
      return on_behalf_of("formulation " + name(), [&] { return F::instances(full); });
    return {{}};
  }

 private:
  static constexpr bool of_phase_space = detail::formulation::writes_field_tape<F>;

  // What the formulated model is made of.
  static ModelSource motion(const F& object, const std::shared_ptr<const Model>& model) {
    if constexpr (detail::formulation::writes_hamiltonian_tape<F>) {
      return motion_of_energy(*model, object.hamiltonian_tape(*model));
    } else {
      ModelSource source = model->source();
      constexpr std::size_t field = index(Formula::field);
      source.given[field] = nullptr;
      source.compiled[field] = {};
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

/// The registration in the unit that makes code in double (core/facets/scalar_units.hpp).
template <class F>
class Formulation<F, detail::InDouble> {
 public:
  explicit Formulation(const FormulationDescriptor& /*descriptor*/) {
    detail::leave_code_of_formulation<F>();
  }
};

}  // namespace pfaff
