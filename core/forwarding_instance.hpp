// What a method says that is made of another one: that which the other says, until Self says something else.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

template <class Self>
class ForwardingInstance : public MakerOf<Self, MethodInstance> {
 public:
  explicit ForwardingInstance(std::shared_ptr<const MethodInstance> method) : method_(std::move(method)) {}
  ForwardingInstance(const ForwardingInstance& other)
      : MakerOf<Self, MethodInstance>(), method_(other.method_) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return method_->descriptor(); }
  [[nodiscard]] Assignments parameters() const override { return method_->parameters(); }
  [[nodiscard]] FacetSet needs() const override { return method_->needs(); }
  [[nodiscard]] std::string family() const override { return method_->family(); }
  [[nodiscard]] int order(const Model& model) const override { return method_->order(model); }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const override {
    return method_->preserves(model);
  }
  [[nodiscard]] std::string objection(const Model& model) const override { return method_->objection(model); }
  [[nodiscard]] bool adaptive() const override { return method_->adaptive(); }
  [[nodiscard]] bool processed() const override { return method_->processed(); }
  [[nodiscard]] std::size_t coefficient_count() const override { return method_->coefficient_count(); }
  /// The same of the method with the changed coefficient.
  [[nodiscard]] std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t index,
                                                                         Quad amount) const override {
    auto changed = std::make_unique<Self>(static_cast<const Self&>(*this));
    changed->method_ = method_->with_changed_coefficient(index, amount);
    return changed;
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> weights,
                                                         std::size_t processor) const override {
    return method_->composed(std::move(weights), processor);
  }
  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    return method_->stepper(std::move(model), T());
  }

 protected:
  [[nodiscard]] const MethodInstance& method() const { return *method_; }

 private:
  std::shared_ptr<const MethodInstance> method_;
};

}  // namespace pfaff
