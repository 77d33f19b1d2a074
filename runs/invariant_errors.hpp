// InvariantErrors: how far the invariants of a model have been from where they began.
#pragma once

#include <algorithm>
#include <array>
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
    initial_.clear();
    if (count == 0) return;
    values_ = std::make_unique<BlockValues<T>>(run.model(), Formula::invariants, count, run.block_rows());
    const std::span<const T> initial = values_->at(run.time(), run.state());
    initial_.assign(initial.begin(), initial.end());
  }
  void look(const Integration<T>& /*run*/, const Block<T>& block) override {
    if (initial_.empty()) return;
    const Tiles<T>& values = (*values_)(block);
    for (std::size_t i = 0; i < initial_.size(); ++i) {
      const T worst = largest_error(values, i, block.rows);
      if (!(worst <= largest_[i])) largest_[i] = isfinite(worst) ? worst : T(infinity);
    }
  }
  /// The largest absolute difference from its first value of each invariant, in its unit.
  [[nodiscard]] const std::vector<T>& largest() const { return largest_; }

 private:
  // The largest error of invariant i at so many rows; not finite where one of them is not.
  [[nodiscard]] T largest_error(const Tiles<T>& values, std::size_t i, std::size_t rows) const {
    std::array<T, lanes<T>> worst{}, zero{};  // zero times an error is zero where it is finite
    const auto take = [&](const T* value, std::size_t lane) {
      const T error = abs(value[lane] - initial_[i]);
      worst[lane] = error > worst[lane] ? error : worst[lane];
      zero[lane] += error * T(0);
    };
    const std::size_t tiles = rows / lanes<T>, rest = rows % lanes<T>;
    for (std::size_t tile = 0; tile < tiles; ++tile)
      for (std::size_t lane = 0; lane < lanes<T>; ++lane) take(values.tile(tile) + i * lanes<T>, lane);
    for (std::size_t lane = 0; lane < rest; ++lane) take(values.tile(tiles) + i * lanes<T>, lane);
    T largest(0);
    for (std::size_t lane = 0; lane < lanes<T>; ++lane) largest = std::max(largest, worst[lane]) + zero[lane];
    return largest;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::unique_ptr<BlockValues<T>> values_;
  std::vector<T> initial_, largest_;
};

}  // namespace pfaff
