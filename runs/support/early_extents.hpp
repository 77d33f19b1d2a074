// How far the coordinates of a run reach early in it.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pfaff/core/facets/tile_rows.hpp>

namespace pfaff {

/// The largest size of every coordinate over the first samples of a run. How many these are is known only
/// when it has ended. So extents are kept as they were after each number of samples up to 128, and behind
/// that after numbers of which there are 64 between two powers of two, and that which is looked for in a run
/// that goes to its end.
class EarlyExtents {
 public:
  /// For a run of so many samples, if it does not end before.
  explicit EarlyExtents(std::size_t samples) : planned_(early(samples)) {}
  void add(const std::vector<double>& z) {
    ++samples_;
    if (samples_ > planned_) return;
    extents_.resize(z.size());
    bool wider = samples_ == 1;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (std::abs(z[i]) > extents_[i]) extents_[i] = std::abs(z[i]), wider = true;
    changed_ = changed_ || wider;
    const std::size_t apart = std::max<std::size_t>(1, std::bit_floor(samples_) / 64);
    if (!changed_ || (samples_ % apart != 0 && samples_ != planned_)) return;
    kept_.push_back({samples_, extents_});
    changed_ = false;
  }
  /// Adds rows of a block, behind the first sample.
  template <class T>
  void add(const Tiles<T>& states, const ChosenRows& rows) {
    for (std::size_t k = 0; k < rows.count;) {
      if (samples_ >= planned_) {
        samples_ += rows.count - k;
        return;
      }
      const bool whole = rows.apart == 1 && rows[k] % lanes<T> == 0 && k + lanes<T> <= rows.count;
      if (whole && !changed_ && within(states.tile(rows[k] / lanes<T>))) {
        samples_ += lanes<T>;
        k += lanes<T>;
        continue;
      }
      add(state(states, rows[k++]));
    }
  }
  /// The state in a row, in double.
  template <class T>
  const std::vector<double>& state(const Tiles<T>& states, std::size_t row) {
    state_.resize(states.components());
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = static_cast<double>(states.at(row, i));
    return state_;
  }
  /// Those of the first tenth of all samples, and of eight at least.
  [[nodiscard]] std::vector<double> first_tenth() const {
    std::vector<double> extents(extents_.size());
    for (const Kept& kept : kept_)
      if (kept.samples <= early(samples_)) extents = kept.extents;
    return extents;
  }

 private:
  struct Kept {
    std::size_t samples;
    std::vector<double> extents;
  };
  // Whether none of the states in a tile goes beyond the extents.
  template <class T>
  [[nodiscard]] bool within(const T* tile) const {
    bool all = true;
    for (std::size_t i = 0; i < extents_.size(); ++i)
      for (std::size_t lane = 0; lane < lanes<T>; ++lane)
        all = all && !(abs(tile[i * lanes<T> + lane]) > T(extents_[i]));
    return all;
  }
  static std::size_t early(std::size_t samples) { return std::max<std::size_t>(8, samples / 10); }

  std::size_t planned_, samples_ = 0;
  std::vector<double> extents_;
  bool changed_ = false;  // since extents were last kept
  std::vector<Kept> kept_;
  std::vector<double> state_;
};

}  // namespace pfaff
