// BlockValues: a formula of a model at all states of a block, eight states together where the scalar is
// double, and four times eight where its tape is replayed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff {

/// The values of one formula, which reads a state and gives `outputs` numbers. States that are evaluated
/// together give the bits that one gives alone.
template <class T>
class BlockValues {
 public:
  BlockValues(const std::shared_ptr<const Model>& model, Formula formula, std::size_t outputs,
              std::size_t capacity)
      : values_(outputs, capacity),
        one_(make_evaluator<T>(model, formula)),
        state_(static_cast<std::size_t>(model->dimension())),
        results_(outputs) {
    if constexpr (in_lanes) {
      wide_ = make_evaluator_in_lanes<static_cast<int>(tiles_together * lanes<T>)>(model, formula);
      if (wide_.call != nullptr) {
        arguments_.resize(state_.size());
        wide_results_.resize(outputs);
      } else {
        lanes_ = make_evaluator_in_lanes<static_cast<int>(lanes<T>)>(model, formula);
      }
    }
  }

  /// The values at the rows of a block, which has at most `capacity` of them. Lanes behind the last row have
  /// no meaning.
  [[nodiscard]] const Tiles<T>& operator()(const Block<T>& block) {
    if constexpr (in_lanes)
      if (wide_.call != nullptr || lanes_.call != nullptr) {
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
  // An operation of a tape costs a jump, which is shared by so many tiles.
  static constexpr std::size_t tiles_together = 4;
  using Lanes = std::conditional_t<in_lanes, Pack<8>, double>;  // the latter is not used
  using Wide = std::conditional_t<in_lanes, Pack<8 * tiles_together>, double>;

  void evaluate_in_lanes(const Block<T>& block) {
    static_assert(!in_lanes || lanes<T> == 8);
    if (wide_.call != nullptr) {
      for (std::size_t row = 0; row < block.rows; row += tiles_together * lanes<T>) evaluate_wide(block, row);
      return;
    }
    // A tile is what packs of its numbers are in memory.
    for (std::size_t row = 0; row < block.rows; row += lanes<T>)
      lanes_.call(lanes_.context, times<Lanes>(block, row),
                  reinterpret_cast<const Lanes*>(block.states.tile(row / lanes<T>)),
                  reinterpret_cast<Lanes*>(values_.tile(row / lanes<T>)));
  }
  // At the rows of so many tiles from a row on; copies of the last one stand for those that are missing.
  void evaluate_wide(const Block<T>& block, std::size_t row) {
    constexpr std::size_t tile_size = lanes<T> * sizeof(double);
    const std::size_t first = row / lanes<T>,
                      there = std::min(tiles_together, (block.rows - 1) / lanes<T> + 1 - first);
    const auto part = [](auto& of, std::size_t k) {
      return reinterpret_cast<std::byte*>(&of) + k * tile_size;
    };
    for (std::size_t i = 0; i < arguments_.size(); ++i)
      for (std::size_t k = 0; k < tiles_together; ++k)
        std::memcpy(part(arguments_[i], k), block.states.tile(first + std::min(k, there - 1)) + i * lanes<T>,
                    tile_size);
    wide_.call(wide_.context, times<Wide>(block, row), arguments_.data(), wide_results_.data());
    for (std::size_t i = 0; i < wide_results_.size(); ++i)
      for (std::size_t k = 0; k < there; ++k)
        std::memcpy(values_.tile(first + k) + i * lanes<T>, part(wide_results_[i], k), tile_size);
  }
  // Block::time of the rows from one on. Lanes behind the last row have times of their own, and values of no
  // meaning.
  template <class P>
  static P times(const Block<T>& block, std::size_t row) {
    if (block.times.empty())
      return P(block.t0) +
             (P(static_cast<double>(block.step(row))) + numbers<P>() * P(static_cast<double>(block.stride))) *
                 P(block.h);
    P t;
    for (std::size_t lane = 0; lane < sizeof(P) / sizeof(double); ++lane)
      t.set(lane, block.times[std::min(row + lane, block.rows - 1)]);
    return t;
  }
  // 0, 1, 2, …
  template <class P>
  static const P& numbers() {
    static const P made = [] {
      P numbers;
      for (std::size_t lane = 0; lane < sizeof(P) / sizeof(double); ++lane)
        numbers.set(lane, static_cast<double>(lane));
      return numbers;
    }();
    return made;
  }

  Tiles<T> values_;
  Evaluator<T> one_;
  Evaluator<Lanes> lanes_;
  Evaluator<Wide> wide_;
  std::vector<Wide> arguments_, wide_results_;
  std::vector<T> state_, results_;
};

}  // namespace pfaff
