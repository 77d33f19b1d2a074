// Methods whose step is a function of Python that is called at every step, with floats or, in other scalars,
// with arrays of objects.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/python/src/callbacks.hpp>

namespace pfaff::python {

/// `step` is called as step(evaluate, model, t, h, z, work) and gives the new state; evaluate(name, t, x)
/// gives the numbers of a formula of the problem, and `work` is a dictionary of the method's own, which is
/// empty where a step does not begin where the last one, of the same size, ended.
class CalledMethod final : public MakerOf<CalledMethod, MethodInstance> {
 public:
  CalledMethod(MethodDescriptor descriptor, Assignments parameters, FacetSet needs, SharedObject step)
      : descriptor_(std::move(descriptor)),
        parameters_(std::move(parameters)),
        needs_(needs),
        step_(std::move(step)) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return descriptor_; }
  [[nodiscard]] Assignments parameters() const override { return parameters_; }
  [[nodiscard]] FacetSet needs() const override { return needs_; }
  [[nodiscard]] int order(const Model& /*model*/) const override { return descriptor_.order; }
  [[nodiscard]] std::vector<Claim> preserves(const Model& /*model*/) const override {
    return descriptor_.preserves;
  }
  [[nodiscard]] std::string objection(const Model& /*model*/) const override { return {}; }
  [[nodiscard]] bool adaptive() const override { return false; }
  [[nodiscard]] bool processed() const override { return false; }
  [[nodiscard]] std::size_t coefficient_count() const override { return 0; }
  [[nodiscard]] std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t /*index*/,
                                                                         Quad /*amount*/) const override {
    return nullptr;
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> /*weights*/,
                                                         std::size_t /*processor*/) const override {
    return nullptr;
  }
  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const;

 private:
  MethodDescriptor descriptor_;
  Assignments parameters_;
  FacetSet needs_;
  SharedObject step_;
};

extern template StepperPointer<double> CalledMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<Quad> CalledMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<StepDual<double>> CalledMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<StepDual<Quad>> CalledMethod::made(std::shared_ptr<const Model>) const;

}  // namespace pfaff::python
