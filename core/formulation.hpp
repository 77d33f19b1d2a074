// What the author of a formulation includes: from a system with constraints to a vector field.
//
// F is a struct in an anonymous namespace that holds parameters and, for holonomic constraints,
//   template <class T> struct Work { Work(std::size_t degrees, std::size_t count); … };
//   template <class T> Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p,
//                                   Out<T> q_rate, Out<T> p_rate, Work<T>& work) const;
// without comparisons, so that it can be recorded. Optional: field_tape(model), the same for constraints of
// the phase space, phi(z, t) = 0.
#pragma once

#include <limits>
#include <memory>
#include <utility>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace pfaff {

/// What is said about a formulation.
struct FormulationDescriptor {
  std::string name;       // kebab-case
  std::string title;      // one line
  std::string reference;  // bib key and equations
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
  /// Why the formulation does not fit a model, naming both sides; empty when it does.
  [[nodiscard]] virtual std::string refuses(const Model& model) const = 0;
  /// The motion of a constrained model in this formulation: a model that offers a vector field. InputError
  /// where the formulation does not fit.
  [[nodiscard]] virtual std::shared_ptr<const Model> apply(const std::shared_ptr<const Model>& model,
                                                           const Assignments& assignments) const = 0;

 private:
  FormulationDescriptor descriptor_;
};

namespace detail {

/// F on one model, as a program.
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
      // No numbers are made up where a factorisation failed: whoever steps sees that the state is not finite.
      if constexpr (!std::is_same_v<T, Recorded>)
        if (status != Status::converged)
          for (T& x : rate) x = T(std::numeric_limits<double>::quiet_NaN());
    }
  };
  template <class T>
  [[nodiscard]] Object<T> make() const {
    auto constraints = model->template holonomic_constraints<T>();
    const std::size_t n = constraints->degrees(), count = constraints->count();
    return {formulation, std::move(constraints), typename F::template Work<T>(n, count)};
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
    formulations().add(this);
  }
  [[nodiscard]] Assignments resolve(const Assignments& assignments) const override {
    const F object = make(assignments);
    return resolved(parameters(), &object);
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
  }

 private:
  static constexpr bool of_phase_space = requires(const F& f, const Model& model) { f.field_tape(model); };

  [[nodiscard]] F make(const Assignments& assignments) const {
    F object;
    assign_all(parameters(), &object, assignments, "formulation " + name());
    return object;
  }
};

}  // namespace pfaff
