// InvariantErrors: how far the invariants of a model have been from where they began.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <pfaff/runs/block_values.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff {

/// Watches the invariants of a model, in the order of Model::invariants(). A value that is not finite makes
/// the error of its invariant infinite.
template <class T = double>
class InvariantErrors final : public Watcher<T> {
 public:
  void start(const Integration<T>& run) override {
    const std::size_t count = run.model()->invariants().size();
    largest_.assign(count, T(0));
    if (count == 0) return;
    values_ = std::make_unique<BlockValues<T>>(run.model(), Formula::invariants, count, run.block_rows());
    const std::span<const T> initial = values_->at(run.time(), run.state());
    initial_.assign(initial.begin(), initial.end());
  }
  std::size_t look(const Integration<T>& /*run*/, const Block<T>& block) override {
    if (initial_.empty()) return block.rows;
    const Tiles<T>& values = (*values_)(block);
    for (std::size_t i = 0; i < initial_.size(); ++i)
      for (std::size_t row = 0; row < block.rows; ++row) {
        const T error = abs(values.at(row, i) - initial_[i]);
        if (!(error <= largest_[i])) largest_[i] = isfinite(error) ? error : infinity;
      }
    return block.rows;
  }
  /// The largest absolute difference from its first value of each invariant, in its unit.
  [[nodiscard]] const std::vector<T>& largest() const { return largest_; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::unique_ptr<BlockValues<T>> values_;
  std::vector<T> initial_, largest_;
};

}  // namespace pfaff
