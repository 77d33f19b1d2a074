// A composition of a base: what the base makes of the weights, under the name and with the order of the
// plug-in that chose them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/integrator.hpp>

namespace pfaff {

/// What the plug-in says of a composition.
struct ComposedStatement {
  const MethodPlugin* plugin = nullptr;  // outlives the composition
  Assignments parameters{};              // of the plug-in, with their values
  std::string called{};                  // as messages call the method
  int order = 0;
  bool palindrome = true;  // the weights read the same from both ends
};

class ComposedInstance final : public MakerOf<ComposedInstance, MethodInstance> {
 public:
  ComposedInstance(ComposedStatement statement, std::unique_ptr<MethodInstance> composed)
      : statement_(std::move(statement)), composed_(std::move(composed)) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override {
    return statement_.plugin->descriptor();
  }
  [[nodiscard]] Assignments parameters() const override { return statement_.parameters; }
  [[nodiscard]] FacetSet needs() const override { return composed_->needs(); }
  [[nodiscard]] int order(const Model& /*model*/) const override { return statement_.order; }
  /// What the base keeps in steps of either sign; symmetry only where the weights are symmetric. Claims on
  /// entropy are left out: a sub-step back in time lets it fall.
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const override {
    std::vector<Claim> kept = composed_->preserves(model);
    std::erase(kept, Claim::entropy);
    if (!statement_.palindrome) {
      std::erase(kept, Claim::symmetric);
      std::erase(kept, Claim::reversible);
    }
    return kept;
  }
  [[nodiscard]] std::string called() const override { return statement_.called; }
  /// That of compositions, unless the base steps on constraints.
  [[nodiscard]] std::string family() const override {
    return needs_constraints() ? composed_->family() : descriptor().family;
  }
  [[nodiscard]] std::string objection(const Model& model) const override {
    return composed_->objection(model);
  }
  [[nodiscard]] bool adaptive() const override { return false; }
  [[nodiscard]] bool processed() const override { return composed_->processed(); }
  [[nodiscard]] std::size_t coefficient_count() const override { return composed_->coefficient_count(); }
  [[nodiscard]] std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t index,
                                                                         Quad amount) const override {
    return std::make_unique<ComposedInstance>(statement_, composed_->with_changed_coefficient(index, amount));
  }
  /// Null, because the weights of compositions are made for bases of order 2.
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> /*weights*/,
                                                         std::size_t /*processor*/) const override {
    return nullptr;
  }
  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    return composed_->stepper(std::move(model), T());
  }

 private:
  ComposedStatement statement_;
  std::unique_ptr<MethodInstance> composed_;
};

}  // namespace pfaff
