// What the author of an integrator includes: the facets' concepts and the registration object Method<M>.
//
// M is a struct in an anonymous namespace that holds parameters only and steps:
//   template <class P> struct Work { Work(const M&, const P&); … };                        // optional
//   template <HasVectorField P>
//   Status step(const P&, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>&) const;
//
// Optional members of M. One of these names with another signature is refused by the compiler, which says
// what was expected (core/facets/method_members.hpp).
//   static parameters()          the settings of the method
//   validate()                   called once parameters are set. What it cannot accept it throws as an
//                                InputError that says what was given and what was expected; the name of the
//                                registered method is put before it
//   order(model)                 where the order depends on parameters or problem
//   preserves(model)             where what is kept depends on parameters or problem
//   refuses(model)               why the method cannot run on a model that offers what it needs, or empty.
//                                The reason is the predicate of a sentence, such as "keeps energies and needs
//                                a system without friction". Its subject, the name of the registered method,
//                                is put before it, so that a method built on another refuses in its own name
//                                and not in that of the other
//   coefficients()               a mutable span over the numbers that define the method: the control that
//                                changes one of them by 1e-6 needs it
//   static instances(full)       the parameters that verification runs through
//   advance_to(p, t, end, tolerance, z, work)   for methods that choose their steps, from t to `end` with
//                                what a Tolerance allows of each (core/facets/tolerance.hpp): a member
//                                CoordinateScales<P> of Work finds the scales that it is relative to, judges
//                                the errors of a step by them, and proposes the first step. Before each step
//                                it asks AllowedSteps (core/facets/allowed_steps.hpp), and where it may take
//                                no more it returns `converged` with z and t as they are
//   bool compensated             the loop over steps is compiled once for each of its two values
//   static constexpr bool fixed_sizes = false   for methods that gain nothing from a known dimension: the
//                                loop is then not compiled for the dimensions 2, 4 and 6 separately
//   processed(), preprocess(p, t, h, z, work), kernel(p, t, h, z, work), postprocess(p, t, h, z, work)
//                                for methods whose step is a processor, a kernel and the inverse of the
//                                processor: the three parts by themselves, of the step that begins at t, or
//                                of the last step, which ends at t, for postprocess. One that does not
//                                converge leaves z as it was. Where processed() is true, a loop of steps
//                                takes the processor at its beginning and its end alone; step() still takes
//                                all three (core/facets/processed.hpp)
//   using Composed = Composition<B>
//                                for a symmetric M of order 2 that derives from B: the type by which the
//                                integrator `composition` composes M (core/facets/composition.hpp)
//
// Optional members of Work, by which compositions of the method pass on what it keeps between steps:
//   carry                        what compensated sums have rounded off; swapped from sub-step to sub-step
//   hand_over(next)              instead: gives all that belongs to the state to the workspace of the next
//                                sub-step
//   restart()                    forgets the history of past steps, from which the next one is predicted
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/facets/composition.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/method_members.hpp>
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/facets/stepper.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/core/solve/summation.hpp>

namespace pfaff {

namespace detail {

// A facet is needed when the method cannot step on problems that have every facet but this one.
template <class M, unsigned K>
constexpr FacetSet needed_facet() {
  constexpr Facet f = static_cast<Facet>(K);
  return Steps<M, Problem<double, dynamic, FacetSet::all().without(f)>> ? FacetSet{} : FacetSet{}.with(f);
}
template <class M, unsigned... K>
constexpr FacetSet needed_facets(std::integer_sequence<unsigned, K...>) {
  return {(needed_facet<M, K>().bits | ...)};
}

}  // namespace detail

/// The facets without which M does not step.
template <class M>
constexpr FacetSet needs_of() {
  return detail::needed_facets<M>(
      std::make_integer_sequence<unsigned, static_cast<unsigned>(Facet::count)>());
}

namespace detail {

template <class M>
class Instance final : public MakerInUnits<Instance<M>, MethodInstance> {
 public:
  Instance(const MethodPlugin& plugin, M method) : plugin_(plugin), method_(std::move(method)) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return plugin_.descriptor(); }
  [[nodiscard]] Assignments parameters() const override { return resolved(plugin_.parameters(), &method_); }
  [[nodiscard]] FacetSet needs() const override { return needs_of<M>(); }
  [[nodiscard]] int order(const Model& model) const override {
    if constexpr (requires { method_.order(model); }) {
      return method_.order(model);
    } else {
      return plugin_.descriptor().order;
    }
  }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const override {
    if constexpr (requires { method_.preserves(model); }) {
      return method_.preserves(model);
    } else {
      return plugin_.descriptor().preserves;
    }
  }
  [[nodiscard]] std::string objection(const Model& model) const override {
    if constexpr (requires { method_.refuses(model); }) return method_.refuses(model);
    return {};
  }
  [[nodiscard]] bool adaptive() const override {
    using P = Problem<double>;
    return requires(const P& p, double& t, const Tolerance<double>& tolerance, State<P>& z, Work<M, P>& w) {
      method_.advance_to(p, t, t, tolerance, z, w);
    };
  }
  [[nodiscard]] bool processed() const override {
    if constexpr (requires { method_.processed(); }) return method_.processed();
    return false;
  }
  [[nodiscard]] std::size_t coefficient_count() const override {
    if constexpr (requires(M m) { m.coefficients(); }) {
      M copy = method_;
      return copy.coefficients().size();
    } else {
      return 0;
    }
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t index,
                                                                         Quad amount) const override {
    M copy = method_;
    if constexpr (requires(M m) { m.coefficients(); }) copy.coefficients()[index] += amount;
    return std::make_unique<Instance>(plugin_, std::move(copy));
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> weights,
                                                         std::size_t processor) const override {
    if constexpr (requires { typename M::Composed; }) {
      typename M::Composed composition;
      assign_all(parameters_of<typename M::Composed>(), &composition, parameters(),
                 "composed integrator " + plugin_.name());
      composition.weights = std::move(weights);
      composition.processor = processor;
      return std::make_unique<Instance<typename M::Composed>>(plugin_, std::move(composition));
    } else {
      return nullptr;
    }
  }

  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    constexpr bool sizes = [] {
      if constexpr (requires { M::fixed_sizes; }) return M::fixed_sizes;
#ifdef PFAFF_COLD  // compiled to be soon there (cmake/PfaffTargets.cmake)
      return false;
#else
      return true;
#endif
    }();
    if constexpr (sizes && std::is_same_v<T, double>) {  // the sizes worth a copy of the code each
      if (model->dimension() == 2) return on<Problem<T, 2>>(std::move(model));
      if (model->dimension() == 4) return on<Problem<T, 4>>(std::move(model));
      if (model->dimension() == 6) return on<Problem<T, 6>>(std::move(model));
    }
    return on<Problem<T>>(std::move(model));
  }

 private:
  template <class P>
  auto on(std::shared_ptr<const Model> model) const {
    return std::make_unique<SteppingOn<M, P>>(method_, std::move(model));
  }

  const MethodPlugin& plugin_;
  M method_;
};

/// What two units leave each other of M.
template <class M>
void leave_code_of_method() {
  // Of a method that does not step check_method_members says so; its code would be errors by the dozen.
  if constexpr (StepsInScalars<M>) {
    leave_code_of<Instance<M>>();
    if constexpr (requires { typename M::Composed; }) leave_code_of<Instance<typename M::Composed>>();
  }
}

}  // namespace detail

/// Registers M when the library that holds it is loaded.
template <class M, class Unit = detail::ThisUnit>
class Method final : public MethodPlugin {
 public:
  explicit Method(MethodDescriptor descriptor,
                  const std::source_location& where = std::source_location::current())
      : MethodPlugin(std::move(descriptor), parameters_of<M>(), typeid(M), where) {
    detail::check_method_members<M>();
    static_assert(!detail::StepsInScalars<M> || needs_of<M>().bits != 0,
                  "step: expected the concept of the facet that it needs, as in template <HasVectorField P>: "
                  "with template <class P> it would step on systems whose motion it does not know");
    detail::leave_code_of_method<M>();
    integrators().add(this);
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    return on_behalf_of("integrator " + name(), [&]() -> std::unique_ptr<MethodInstance> {
      M method;
      assign_all(parameters(), &method, assignments, "integrator " + name());
      if constexpr (requires { method.validate(); }) {
        try {
          method.validate();
        } catch (const InputError& error) {
          throw InputError("integrator " + name() + ": " + error.what());
        }
      }
      if constexpr (detail::StepsInScalars<M>)
        return std::make_unique<detail::Instance<M>>(*this, std::move(method));
      return nullptr;  // refused by check_method_members
    });
  }
  [[nodiscard]] std::vector<Assignments> instances(bool full) const override {
    if constexpr (requires { M::instances(full); })
      return on_behalf_of("integrator " + name(), [&] { return M::instances(full); });
    return {{}};
  }
};

/// The registration in the unit that makes code in double (core/facets/scalar_units.hpp).
template <class M>
class Method<M, detail::InDouble> {
 public:
  explicit Method(const MethodDescriptor& /*descriptor*/) { detail::leave_code_of_method<M>(); }
};

}  // namespace pfaff
