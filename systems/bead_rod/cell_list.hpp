// Pairs of points closer than a cut-off, in O(N): cells as wide as the cut-off, found by hashing, so that
// neither the extent of the cloud nor its emptiness costs memory. Nothing is allocated after construction.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pfaff {

template <int D>
class CellList {
 public:
  explicit CellList(std::size_t points)
      : mask_(std::bit_ceil(std::max<std::size_t>(points, 1)) - 1),
        cells_(points),
        start_(mask_ + 3),
        sorted_(points) {}

  /// Sorts the points into cells of this width; point i is at position(i, axis), a double. False where a
  /// coordinate is not finite or too far away to be counted in cells.
  template <class Position>
  bool fill(double width, const Position& position) {
    constexpr double farthest = 1e15;  // cells from the origin: still exact as a double and as an integer
    std::fill(start_.begin(), start_.end(), 0U);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      for (std::size_t d = 0; d < D; ++d) {
        const double cell = std::floor(position(i, d) / width);
        if (!(std::abs(cell) < farthest)) return false;
        cells_[i][d] = static_cast<std::int64_t>(cell);
      }
      ++start_[bucket(cells_[i]) + 2];
    }
    for (std::size_t b = 2; b < start_.size(); ++b) start_[b] += start_[b - 1];
    for (std::size_t i = 0; i < cells_.size(); ++i)
      sorted_[start_[bucket(cells_[i]) + 1]++] = static_cast<std::uint32_t>(i);
    return true;
  }

  /// Calls use(i, j), i < j, once for every pair in the same or in adjacent cells, among which are all pairs
  /// closer than the width. Pairs come in the order of i.
  template <class Use>
  void each_pair(const Use& use) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      Cell offset;
      offset.fill(-1);
      for (bool more = true; more; more = next(offset)) {
        Cell cell = cells_[i];
        for (std::size_t d = 0; d < D; ++d) cell[d] += offset[d];
        const std::size_t b = bucket(cell);
        for (std::uint32_t k = start_[b]; k < start_[b + 1]; ++k)
          if (const std::uint32_t j = sorted_[k]; j > i && cells_[j] == cell) use(i, j);
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, D>;

  [[nodiscard]] std::size_t bucket(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t x : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32U;
    }
    return static_cast<std::size_t>(hash) & mask_;
  }
  static bool next(Cell& offset) {
    for (std::int64_t& x : offset) {
      if (++x <= 1) return true;
      x = -1;
    }
    return false;
  }

  std::size_t mask_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> start_;  // of bucket b: sorted_[start_[b] .. start_[b + 1])
  std::vector<std::uint32_t> sorted_;
};

}  // namespace pfaff
