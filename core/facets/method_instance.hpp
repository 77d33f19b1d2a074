// What callers know of a method: its descriptor, the method with its parameters fixed, and its entry in the
// registry. Authors include core/integrator.hpp, which makes these of a struct that steps.
#pragma once

#include <cstddef>
#include <memory>
#include <source_location>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/stepper.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace pfaff {

/// What is said about a method, once.
struct MethodDescriptor {
  std::string name;           // kebab-case
  std::string title;          // one line
  std::string family{};       // to which it belongs in reports, as bench/report/families.py has them; or none
  std::string reference;      // bib key and equations
  std::string description{};  // two to four sentences: what it is, when to take it, where it ends
  int order = 0;              // 0: M::order(model) says
  std::vector<Claim> preserves{};
  bool double_coefficients = false;  // third-party methods whose coefficients are doubles: no claims in quad
};

/// A method with its parameters fixed.
class MethodInstance : public Maker<StepperPointer, StepScalars, std::shared_ptr<const Model>> {
 public:
  [[nodiscard]] virtual const MethodDescriptor& descriptor() const = 0;
  [[nodiscard]] virtual Assignments parameters() const = 0;
  /// Facets the method cannot do without.
  [[nodiscard]] virtual FacetSet needs() const = 0;
  /// True for methods that work on the constraints themselves, whatever kind these are, and not on a motion
  /// that a formulation has made of them.
  [[nodiscard]] bool needs_constraints() const {
    return needs().meets(facets(Facet::holonomic, Facet::constraints, Facet::velocity_constraints));
  }
  /// Order claimed on this model.
  [[nodiscard]] virtual int order(const Model& model) const = 0;
  /// What the method claims, on this model or on others (claims_in_scope says what speaks of this one).
  [[nodiscard]] virtual std::vector<Claim> preserves(const Model& model) const = 0;
  /// The method as messages call it.
  [[nodiscard]] virtual std::string called() const { return descriptor().name; }
  /// The family that reports show it in. Virtual for methods that are made of others.
  [[nodiscard]] virtual std::string family() const { return descriptor().family; }
  /// Why the method rejects a model that offers what it needs, as a predicate; empty when it does not.
  [[nodiscard]] virtual std::string objection(const Model& model) const = 0;
  /// Why the method cannot run on this model, naming both sides; empty when it can.
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (!model.facets().includes(needs()))
      return called() + " needs " + to_string(needs()) + "; " + model.name() + " offers " +
             to_string(model.facets()) + model.advice(needs());
    if (model.forced() && needs_constraints() && !needs().has(Facet::vector_field))
      return called() + " keeps the constraints of a motion that an energy makes alone; " + model.name() +
             " has applied forces, which methods for vector fields take, beside a formulation of its "
             "constraints";
    const std::string reason =
        on_behalf_of([this] { return "integrator " + called(); }, [&] { return objection(model); });
    return reason.empty() ? reason : called() + " " + reason;
  }
  /// True when the method can choose its steps (advance_to).
  [[nodiscard]] virtual bool adaptive() const = 0;
  /// True where steps cost less in a row than one by one, because a processor is taken at the ends of a loop
  /// of steps alone. Whoever looks at the state after every step then pays for the processor in every step.
  [[nodiscard]] virtual bool processed() const = 0;
  /// How many numbers define the method (0: not exposed), and the same method with one of them changed.
  [[nodiscard]] virtual std::size_t coefficient_count() const = 0;
  [[nodiscard]] virtual std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t index,
                                                                                 Quad amount) const = 0;
  /// The composition of sub-steps of the lengths weights[i] h, of which the first `processor` are those of a
  /// processor and as many at the end undo them; null where M has no Composed.
  [[nodiscard]] virtual std::unique_ptr<MethodInstance> composed(std::vector<Quad> weights,
                                                                 std::size_t processor) const = 0;

  /// The method on one model, in the scalar T.
  template <class T>
  [[nodiscard]] StepperPointer<T> stepper(std::shared_ptr<const Model> model, T /*scalar*/) const {
    return make_for(std::type_identity<T>(), std::move(model));
  }
};

/// A registered method.
class MethodPlugin : public Plugin {
 public:
  MethodPlugin(MethodDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
               const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const MethodDescriptor& descriptor() const { return descriptor_; }
  [[nodiscard]] virtual std::unique_ptr<MethodInstance> make(const Assignments& assignments) const = 0;
  /// The parameters the method's claims are verified with; `full` asks for more than a quick check needs.
  [[nodiscard]] virtual std::vector<Assignments> instances(bool full) const = 0;

 private:
  MethodDescriptor descriptor_;
};

}  // namespace pfaff
