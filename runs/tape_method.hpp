// Methods whose step is a recorded formula: a tape (t, z, h) -> z', made for each model that the method steps
// on.
//
// Such a method is made in a program, as a Python function is, and not registered. It steps in every scalar,
// since a tape is replayed with any, and in double by compiled code where that is asked for.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// A step on one model.
struct StepTape {
  std::shared_ptr<const Tape> tape;  // of the state, the memory and the step h, at the time t
  std::int64_t fields = 0;           // right-hand sides that a step counts as
  // Numbers that a step keeps for the next one; zeros at first, and where a step does not begin where the
  // last one, of the same size, ended.
  std::size_t memory = 0;
};

/// What is said of such a method beside its step.
struct TapeMethodStatement {
  MethodDescriptor descriptor;
  Assignments parameters;
  FacetSet needs;
  bool compiled = false;  // compile the tapes (core/native/compiled_model.hpp), in double
};

/// A method of a recorded step.
class TapeMethod final : public MakerOf<TapeMethod, MethodInstance> {
 public:
  using Record = std::function<StepTape(const std::shared_ptr<const Model>&)>;
  /// `record` makes the tape of a model; threads may call it at once. What it throws reaches whoever makes a
  /// stepper.
  TapeMethod(TapeMethodStatement statement, Record record)
      : statement_(std::move(statement)), record_(std::move(record)) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return statement_.descriptor; }
  [[nodiscard]] Assignments parameters() const override { return statement_.parameters; }
  [[nodiscard]] FacetSet needs() const override { return statement_.needs; }
  [[nodiscard]] int order(const Model& /*model*/) const override { return statement_.descriptor.order; }
  [[nodiscard]] std::vector<Claim> preserves(const Model& /*model*/) const override {
    return statement_.descriptor.preserves;
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

  /// The step on a model, recorded once for as long as the model lives.
  [[nodiscard]] StepTape on(const std::shared_ptr<const Model>& model) const;

 private:
  TapeMethodStatement statement_;
  Record record_;
  mutable std::mutex mutex_;
  mutable std::vector<std::pair<std::weak_ptr<const Model>, StepTape>> known_;
};

extern template StepperPointer<double> TapeMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<Quad> TapeMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<StepDual<double>> TapeMethod::made(std::shared_ptr<const Model>) const;
extern template StepperPointer<StepDual<Quad>> TapeMethod::made(std::shared_ptr<const Model>) const;

}  // namespace pfaff
