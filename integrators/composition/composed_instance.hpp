// A composition of a base: what the base makes of the weights, under the name and with the order of the
// plug-in that chose them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/forwarding_instance.hpp>

namespace pfaff {

/// What the plug-in says of a composition.
struct ComposedStatement {
  const MethodPlugin* plugin = nullptr;  // outlives the composition
  Assignments parameters{};              // of the plug-in, with their values
  std::string called{};                  // as messages call the method
  int order = 0;
  bool palindrome = true;  // the weights read the same from both ends
};

class ComposedInstance final : public ForwardingInstance<ComposedInstance> {
 public:
  ComposedInstance(ComposedStatement statement, std::unique_ptr<MethodInstance> composed)
      : ForwardingInstance(std::move(composed)), statement_(std::move(statement)) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override {
    return statement_.plugin->descriptor();
  }
  [[nodiscard]] Assignments parameters() const override { return statement_.parameters; }
  [[nodiscard]] int order(const Model& /*model*/) const override { return statement_.order; }
  /// What the base keeps in steps of either sign; symmetry only where the weights are symmetric. Claims on
  /// entropy are left out: a sub-step back in time lets it fall.
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const override {
    std::vector<Claim> kept = method().preserves(model);
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
    return needs_constraints() ? method().family() : descriptor().family;
  }
  [[nodiscard]] bool adaptive() const override { return false; }
  /// Null, because the weights of compositions are made for bases of order 2.
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> /*weights*/,
                                                         std::size_t /*processor*/) const override {
    return nullptr;
  }

 private:
  ComposedStatement statement_;
};

}  // namespace pfaff
