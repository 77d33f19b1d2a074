// The parts of a split system, dz/dt = X_1(z) + ... + X_m(z), each of which is solved exactly, for one
// scalar.
//
// The flow phi_h of a part is the map that carries a state along its field X_k for the time h, of either
// sign. Parts do not depend on time, so that phi_s o phi_t = phi_(s+t). Where the system has a structure,
// each flow keeps it. This, and that the fields of the parts add up to that of the system, is what
// verification measures of every system with the facet (verify/flow_checks.cpp).
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

template <class T>
class ExactFlows {
 public:
  ExactFlows() = default;
  ExactFlows(const ExactFlows&) = delete;
  ExactFlows& operator=(const ExactFlows&) = delete;
  virtual ~ExactFlows() = default;

  /// change = phi_h(z) - z for the flow of a part. The change and not the end is what is written, so that a
  /// method can add it with compensation and a short flow has an error relative to its own size. A status
  /// other than `converged` where the flow was not found to round-off; the change is then of no use.
  virtual Status change(std::size_t part, const T& h, In<T> z, Out<T> change) = 0;
};

template <class T>
using ExactFlowsPointer = std::unique_ptr<ExactFlows<T>>;

/// Makes the flows of one system for every scalar in which methods step. They iterate and may fail, so that
/// they are compiled and never recorded.
class ExactFlowsFactory : public Maker<ExactFlowsPointer, StepScalars> {};

/// The factory that calls system->part_flow(part, h, z, change).
template <class S>
class ExactFlowsFactoryOf final : public detail::MakerInUnits<ExactFlowsFactoryOf<S>, ExactFlowsFactory> {
 public:
  explicit ExactFlowsFactoryOf(std::shared_ptr<const S> system) : system_(std::move(system)) {}
  template <class T>
  [[nodiscard]] ExactFlowsPointer<T> made() const {
    return std::make_unique<Flows<T>>(system_);
  }

 private:
  template <class T>
  class Flows final : public ExactFlows<T> {
   public:
    explicit Flows(std::shared_ptr<const S> system) : system_(std::move(system)) {}
    Status change(std::size_t part, const T& h, In<T> z, Out<T> change) override {
      return system_->part_flow(part, h, z, change);
    }

   private:
    std::shared_ptr<const S> system_;
  };
  std::shared_ptr<const S> system_;
};

}  // namespace pfaff
