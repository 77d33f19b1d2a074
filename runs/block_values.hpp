// BlockValues: a formula of a model at all states of a block, eight states together where the scalar is
// double.
#pragma once

#include <algorithm>
#include <array>
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

  /// The values at the rows of a block, which has at most `capacity` of them. Lanes behind the last row have
  /// no meaning.
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
    // A tile is what packs of its numbers are in memory.
    for (std::size_t tile = 0; tile * lanes<T> < block.rows; ++tile)
      lanes_.call(lanes_.context, times(block, tile * lanes<T>),
                  reinterpret_cast<const Lanes*>(block.states.tile(tile)),
                  reinterpret_cast<Lanes*>(values_.tile(tile)));
  }
  // Block::time of eight rows. Lanes behind the last row have times of their own, and values of no meaning.
  static Lanes times(const Block<T>& block, std::size_t row) {
    if (block.times.empty()) {
      static constexpr std::array<double, 8> numbers{0, 1, 2, 3, 4, 5, 6, 7};
      return Lanes(block.t0) + (Lanes(static_cast<double>(block.step(row))) +
                                Lanes::load(numbers.data()) * Lanes(static_cast<double>(block.stride))) *
                                   Lanes(block.h);
    }
    Lanes t;
    for (std::size_t lane = 0; lane < lanes<T>; ++lane)
      t.set(lane, block.times[std::min(row + lane, block.rows - 1)]);
    return t;
  }

  Tiles<T> values_;
  Evaluator<T> one_;
  Evaluator<Lanes> lanes_;
  std::vector<T> state_, results_;
};

}  // namespace pfaff
