// The solution of one initial value problem, for all who compare with it.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include <pfaff/runs/support/reference.hpp>

namespace pfaff {

/// A solution that is made when it is first asked for, as far as it is asked for, and kept. Threads may ask
/// at once; one that asks while it is made waits for it.
class SharedSolution {
 public:
  SharedSolution(std::shared_ptr<const Model> model, const Quad& t0, std::vector<Quad> initial)
      : model_(std::move(model)), t0_(t0), initial_(std::move(initial)) {}
  /// The solution over a time that is `duration` at least, in its direction; it may end before that
  /// (ReferenceSolution::ended). BudgetSpent where it is asked to stop.
  [[nodiscard]] std::shared_ptr<const ReferenceSolution> to(const Quad& duration) const;

 private:
  std::shared_ptr<const Model> model_;
  Quad t0_;
  std::vector<Quad> initial_;
  mutable std::mutex mutex_;
  mutable Quad duration_{0};
  mutable std::shared_ptr<const ReferenceSolution> longest_;
};

}  // namespace pfaff
