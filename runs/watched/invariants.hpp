// The invariants of a system along a run: what is left of those that are conserved (DriftAccumulator), and
// how far the others move against the direction that is expected of them (Setback).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/runs/block_values.hpp>
#include <pfaff/runs/support/early_extents.hpp>
#include <pfaff/runs/support/rounding_sizes.hpp>
#include <pfaff/runs/support/setback.hpp>
#include <pfaff/runs/support/watched_error.hpp>

namespace pfaff {

/// What is left of the invariants of a model at the end of a run, in the order of Model::invariants().
struct InvariantsLeft {
  std::vector<Drift> drift;         // of all, meaningful for those that are conserved
  std::vector<RoundOff> round_off;  // what round-off and loss mean for each
  std::vector<double> setback;      // 0 for one without an expected direction
};

/// Watches the invariants of one run in the scalar T. States are taken in their order, the start first: one
/// by one, or many of a block together. Some of them are samples too, at which it is found what roundings do:
/// that takes longer than a short step, so that of many samples those at ever larger distances are taken.
template <class T>
class WatchedInvariants {
 public:
  /// Of a run forwards or backwards in time, with so many samples at most.
  WatchedInvariants(std::shared_ptr<const Model> model, bool backwards, std::size_t samples);

  /// Takes a state, of which values() are then the invariants. What is not finite, as a phrase; or nothing.
  [[nodiscard]] std::string take(const T& t, const std::vector<T>& z);
  /// Evaluates the invariants at all rows of a block, behind the first state that was taken. False where one
  /// is not finite; then the rows have to be taken one by one.
  [[nodiscard]] bool evaluate(const Block<T>& block);
  /// Takes the first rows of the block that was evaluated.
  void take(const Block<T>& block, std::size_t rows);
  /// Makes values() those at a row of it.
  void at_row(std::size_t row);

  [[nodiscard]] const std::vector<T>& values() const { return values_; }
  [[nodiscard]] const std::vector<T>& initial() const { return initial_; }

  /// Those at all rows of it; null where the model has none.
  [[nodiscard]] const Tiles<T>* rows() const { return in_block_; }

  /// Samples a state, of which values() are the invariants.
  void sample(double t, const std::vector<double>& z);
  /// Samples rows of a block, behind the first sample.
  void sample(const Block<T>& block, const ChosenRows& rows);

  /// After so many steps.
  [[nodiscard]] InvariantsLeft left(std::int64_t steps);

 private:
  [[nodiscard]] bool errors_of(std::size_t i, std::span<double> errors) const;
  [[nodiscard]] std::vector<double> ranges();
  [[nodiscard]] std::size_t to_next_looked_at() const;
  void count_samples(std::size_t count);

  std::shared_ptr<const Model> model_;
  std::optional<Problem<T>> problem_;  // none where the model has no invariants, as is the next
  std::optional<RoundingSizes> roundings_;
  std::unique_ptr<BlockValues<T>> block_values_;  // made with the first block
  const Tiles<T>* in_block_ = nullptr;            // the invariants at its rows,
  std::vector<double> errors_;                    // and each less its first value
  std::vector<T> values_, initial_;
  std::vector<WatchedError> drift_;
  std::vector<Setback<T>> setbacks_;
  static constexpr std::size_t most_roundings = 256;  // at one distance
  std::size_t samples_ = 0;
  std::size_t apart_ = 1;  // the distance, in samples, of those at which roundings are found; a power of two
  EarlyExtents extents_;
  double first_time_ = 0;
  std::vector<double> first_state_;
};

extern template class WatchedInvariants<double>;
extern template class WatchedInvariants<Quad>;

}  // namespace pfaff
