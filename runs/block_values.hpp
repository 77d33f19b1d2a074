// BlockValues: a formula of a model at all states of a block, eight states together where the scalar is
// double.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff {

/// The values of one formula, which reads a state and gives `outputs` numbers. Eight states together give the
/// bits that one gives alone.
template <class T>
class BlockValues {
 public:
  BlockValues(const std::shared_ptr<const Model>& model, Formula formula, std::size_t outputs,
              std::size_t capacity)
      : values_(outputs, capacity),
        one_(make_evaluator<T>(model, formula)),
        state_(static_cast<std::size_t>(model->dimension())),
        results_(outputs) {
    if constexpr (in_lanes) lanes_ = make_evaluator_in_lanes<static_cast<int>(lanes<T>)>(model, formula);
  }

  /// The values at the rows of a block, which has at most `capacity` of them.
  [[nodiscard]] const Tiles<T>& operator()(const Block<T>& block) {
    if constexpr (in_lanes)
      if (lanes_.call != nullptr) {
        evaluate_in_lanes(block);
        return values_;
      }
    for (std::size_t row = 0; row < block.rows; ++row) {
      block.states.get(row, state_);
      one_.call(one_.context, block.time(row), state_.data(), results_.data());
      values_.put(row, results_.data());
    }
    values_.fill_behind(block.rows);
    return values_;
  }
  /// The values at a single state.
  [[nodiscard]] std::span<const T> at(const T& t, std::span<const T> z) {
    one_.call(one_.context, t, z.data(), results_.data());
    return results_;
  }

 private:
  static constexpr bool in_lanes = std::is_same_v<T, double>;
  using Lanes = std::conditional_t<in_lanes, Pack<8>, double>;  // the latter is not used

  void evaluate_in_lanes(const Block<T>& block) {
    static_assert(!in_lanes || lanes<T> == 8);
    Lanes arguments_of_time;
    for (std::size_t tile = 0; tile * lanes<T> < block.rows; ++tile) {
      for (std::size_t lane = 0; lane < lanes<T>; ++lane)
        arguments_of_time.set(lane, block.time(std::min(tile * lanes<T> + lane, block.rows - 1)));
      // A tile is what packs of its numbers are in memory.
      lanes_.call(lanes_.context, arguments_of_time, reinterpret_cast<const Lanes*>(block.states.tile(tile)),
                  reinterpret_cast<Lanes*>(values_.tile(tile)));
    }
  }

  Tiles<T> values_;
  Evaluator<T> one_;
  Evaluator<Lanes> lanes_;
  std::vector<T> state_, results_;
};

}  // namespace pfaff
