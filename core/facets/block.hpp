// Block: states of one integration in a row, laid out for evaluation in lanes.
//
// States lie in tiles of `lanes<T>` rows: the numbers of one component at the rows of a tile are neighbours,
// and a tile is what an evaluator in lanes reads as its arguments, so that nothing is copied to evaluate a
// formula at eight states together. Scalars other than double have tiles of one row: plain states in a row.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The rows of a tile.
template <class T>
inline constexpr std::size_t lanes = std::is_same_v<T, double> ? 8 : 1;

/// `components` numbers at each of `rows` rows, in tiles; zeros at first.
template <class T>
class Tiles {
 public:
  Tiles(std::size_t components, std::size_t rows)
      : components_(components), data_(made(components * whole(rows))) {}

  [[nodiscard]] std::size_t components() const { return components_; }
  /// Tile k, that is rows k lanes<T>, …, component after component.
  [[nodiscard]] T* tile(std::size_t k) { return data_.get() + k * components_ * lanes<T>; }
  [[nodiscard]] const T* tile(std::size_t k) const { return data_.get() + k * components_ * lanes<T>; }
  [[nodiscard]] const T& at(std::size_t row, std::size_t component) const {
    return tile(row / lanes<T>)[component * lanes<T> + row % lanes<T>];
  }
  /// Copies `components` numbers to a row, and from it.
  void put(std::size_t row, const T* from) {
    T* const to = tile(row / lanes<T>) + row % lanes<T>;
    for (std::size_t i = 0; i < components_; ++i) to[i * lanes<T>] = from[i];
  }
  void get(std::size_t row, std::span<T> to) const {
    for (std::size_t i = 0; i < components_; ++i) to[i] = at(row, i);
  }
  /// Gives the lanes behind the last of `rows` rows the numbers of that row: of rubbish arithmetic can be
  /// very slow (core/numbers/pack.hpp).
  void fill_behind(std::size_t rows) {
    for (std::size_t row = rows; rows > 0 && row % lanes<T> != 0; ++row)
      for (std::size_t i = 0; i < components_; ++i)
        tile(row / lanes<T>)[i * lanes<T> + row % lanes<T>] = at(rows - 1, i);
  }
  /// The first of `rows` rows that has a number which is not finite; `rows` where none has.
  [[nodiscard]] std::size_t first_not_finite(std::size_t rows) const {
    for (std::size_t begin = 0; begin < rows; begin += lanes<T>) {
      // Lanes behind the last row may hold anything and are left out.
      const std::size_t filled = std::min(lanes<T>, rows - begin);
      if (filled == lanes<T> && finite(tile(begin / lanes<T>))) continue;
      for (std::size_t row = begin; row < begin + filled; ++row)
        for (std::size_t i = 0; i < components_; ++i)
          if (!isfinite(value_of(at(row, i)))) return row;
    }
    return rows;
  }

 private:
  // Zero times a number is zero, or no number where that is not finite. Sums of the lanes do not wait for
  // each other.
  [[nodiscard]] bool finite(const T* tile_of_all) const {
    std::array<Value<T>, lanes<T>> sums{};
    for (std::size_t i = 0; i < components_; ++i)
      for (std::size_t lane = 0; lane < lanes<T>; ++lane)
        sums[lane] += value_of(tile_of_all[i * lanes<T> + lane]) * Value<T>(0);
    return std::all_of(sums.begin(), sums.end(), [](const Value<T>& sum) { return sum == Value<T>(0); });
  }

  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t whole(std::size_t rows) { return (rows + lanes<T> - 1) / lanes<T> * lanes<T>; }
  struct Free {
    void operator()(T* data) const { ::operator delete(data, alignment); }
  };
  static std::unique_ptr<T[], Free> made(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "scalars are numbers");
    T* const data = static_cast<T*>(::operator new(count * sizeof(T), alignment));
    std::uninitialized_value_construct_n(data, count);
    return std::unique_ptr<T[], Free>(data);
  }
  std::size_t components_;
  std::unique_ptr<T[], Free> data_;
};

/// Row r is the state after step number first + r stride, at the time t0 + (first + r stride) h, where steps
/// are of one size; at times[r] where the method chooses its steps.
template <class T>
struct Block {
  /// Room for `capacity` states of `components` numbers.
  Block(std::size_t components, std::size_t most_rows) : states(components, most_rows), capacity(most_rows) {}

  Tiles<T> states;
  std::size_t capacity, rows = 0;  // there is room for, and are filled
  std::int64_t first = 0, stride = 1;
  T t0{0}, h{0};
  std::vector<T> times;  // of the rows, where these are not equally spaced; empty otherwise

  /// How many steps lie before the state of a row.
  [[nodiscard]] std::int64_t step(std::size_t row) const {
    return first + static_cast<std::int64_t>(row) * stride;
  }
  /// The row after `step` steps; `rows` where there is none.
  [[nodiscard]] std::size_t row_of(std::int64_t step_number) const {
    const std::int64_t behind = step_number - first;
    return behind < 0 || behind % stride != 0 ? rows
                                              : std::min(rows, static_cast<std::size_t>(behind / stride));
  }
  [[nodiscard]] T time(std::size_t row) const {
    return times.empty() ? t0 + T(static_cast<double>(step(row))) * h : times[row];
  }
};

}  // namespace pfaff
