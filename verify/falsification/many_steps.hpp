// Several steps of a method as one step, with all that the method keeps between them. A method of one step
// keeps over many what it keeps over one. A method that uses its past may not: where its two-step recursion
// lets a parasitic oscillation grow, a single step, which has no past, does not show it.
#pragma once

#include <pfaff/core/forwarding_instance.hpp>

namespace pfaff {

/// `count` steps of `method`, each of the length h/count, as one step of the length h.
class ManySteps final : public ForwardingInstance<ManySteps> {
 public:
  /// `method` must outlive the object.
  ManySteps(const MethodInstance& method, int count)
      : ForwardingInstance(std::shared_ptr<const MethodInstance>(std::shared_ptr<void>(), &method)),
        count_(count) {}

  [[nodiscard]] bool adaptive() const override { return false; }
  /// None: compositions are of single steps.
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> /*weights*/,
                                                         std::size_t /*processor*/) const override {
    return nullptr;
  }

  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    return std::make_unique<Stepping<T>>(ForwardingInstance::made<T>(std::move(model)), count_);
  }

 private:
  template <class T>
  class Stepping final : public Stepper<T> {
   public:
    Stepping(StepperPointer<T> stepper, int count) : stepper_(std::move(stepper)), count_(count) {}
    Status advance(const T& t0, std::int64_t first, const T& h, std::int64_t count, std::span<T> z,
                   std::int64_t& completed) override {
      const Status status =
          stepper_->advance(t0, first * count_, h / T(count_), count * count_, z, completed);
      completed /= count_;
      return status;
    }
    Status fill(Block<T>& block, std::size_t rows, std::span<T> z, std::int64_t& completed) override {
      const std::int64_t first = block.first, stride = block.stride;
      const T h = block.h;
      const auto as_asked = [&] {
        block.first = first, block.stride = stride, block.h = h, completed /= count_;
      };
      block.first *= count_, block.stride *= count_, block.h = h / T(count_);
      try {
        const Status status = stepper_->fill(block, rows, z, completed);
        as_asked();
        return status;
      } catch (...) {
        as_asked();
        throw;
      }
    }
    Status advance_to(T& /*t*/, const T& /*end*/, const Tolerance<T>& /*tolerance*/,
                      std::span<T> /*z*/) override {
      throw InputError("several steps as one are of a fixed size");
    }
    void forget() override { stepper_->forget(); }
    [[nodiscard]] const Counters& counters() const override { return stepper_->counters(); }

   private:
    StepperPointer<T> stepper_;
    int count_;
  };

  int count_;
};

}  // namespace pfaff
