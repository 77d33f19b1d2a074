// Stages side by side: the stages of one component of a collocation step are lanes, several to a pack in
// double.
//
// Lanes beyond the last stage are copies of it, so that rates evaluated in lanes are evaluated at stages
// only; their own rates are zero and add nothing. The sum over all stages is formed in one order whatever the
// lanes and the registers behind them: blocks of lanes one after the other, then the lanes by halves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/numbers/sum_of_two.hpp>

namespace pfaff {
namespace detail {

/// What holds several stages of a component where there are `Stages` of them, and how many it holds.
template <class T, int Stages>
struct StageLanes {
  using type = T;
  static constexpr std::size_t width = 1;
  static constexpr bool in_one_register = false;
  static T get(const T& lanes, std::size_t /*lane*/) { return lanes; }
  static void set(T& lanes, std::size_t /*lane*/, const T& x) { lanes = x; }
};
// One pack for up to eight stages, where the compiler knows their number.
template <int Stages>
struct StageLanes<double, Stages> {
  static constexpr std::size_t width = Stages > 4 && Stages <= 8 ? 8 : 4;
  using type = Pack<static_cast<int>(width)>;
  static constexpr bool in_one_register = type::count == 1;
  static double get(const type& lanes, std::size_t lane) { return lanes[lane]; }
  static void set(type& lanes, std::size_t lane, double x) { lanes.set(lane, x); }
};

/// sum + lost = the sum over all lanes of `sums` + `rest`, where `lost` is what additions rounded off.
template <class T>
void add_lanes(const T& sums, const T& rest, T& sum, T& lost) {
  sum = sums;
  lost = rest;
}
template <int W>
void add_lanes(const Pack<W>& sums, const Pack<W>& rest, double& sum, double& lost) {
  if constexpr (W == 1) {
    sum = sums[0];
    lost = rest[0];
  } else {
    Pack<W / 2> half, error;
    two_sum(sums.lower(), sums.upper(), half, error);
    add_lanes(half, error + (rest.lower() + rest.upper()), sum, lost);
  }
}

/// a b, where both are known to the compiler.
constexpr int product_of_sizes(int a, int b) { return a == dynamic || b == dynamic ? dynamic : a * b; }

}  // namespace detail

/// Where numbers of every stage of every component lie. `Components` and `Stages` may be dynamic.
template <class T, int Components, int Stages>
class StageLayout {
 protected:
  using Lanes = detail::StageLanes<T, Stages>;
  static constexpr std::size_t width = Lanes::width;
  static constexpr int blocks_known =
      Stages == dynamic ? dynamic : (Stages + static_cast<int>(width) - 1) / static_cast<int>(width);

 public:
  using Number = Value<T>;
  using Lane = typename Lanes::type;
  using Row = Vector<Lane, blocks_known>;  // a number for every stage
  using Table =
      Vector<Lane, detail::product_of_sizes(Components, blocks_known)>;  // [component][block of stages]
  using Matrix = Vector<Lane, detail::product_of_sizes(Stages, blocks_known)>;  // [column][block of rows]

  StageLayout(std::size_t components, std::size_t stages)
      : components_(components), stages_(stages), used_(row_of(std::vector<Number>(stages, Number(1)))) {}

  [[nodiscard]] std::size_t stages() const {
    return Stages == dynamic ? stages_ : static_cast<std::size_t>(Stages);
  }
  [[nodiscard]] std::size_t components() const {
    return Components == dynamic ? components_ : static_cast<std::size_t>(Components);
  }
  /// Blocks of lanes that hold all stages of a component.
  [[nodiscard]] std::size_t blocks() const { return (stages() + width - 1) / width; }

  /// One number for each stage, in lanes; zero beyond the last stage.
  [[nodiscard]] Row row_of(const std::vector<Number>& numbers) const {
    Row row(blocks());
    for (std::size_t i = 0; i < stages(); ++i) Lanes::set(row[i / width], i % width, T(numbers[i]));
    return row;
  }
  /// The same with copies of the last number there.
  [[nodiscard]] Row filled_row_of(const std::vector<Number>& numbers) const {
    Row row(blocks());
    for (std::size_t lane = 0; lane < blocks() * width; ++lane)
      Lanes::set(row[lane / width], lane % width, T(numbers[std::min(lane, stages() - 1)]));
    return row;
  }
  /// A matrix, given row-major, that makes numbers of every stage from numbers of every stage. Beyond the
  /// last stage its rows are zero or, where `filled`, copies of the last one.
  [[nodiscard]] Matrix matrix_of(const std::vector<Number>& numbers, bool filled) const {
    Matrix matrix(stages() * blocks());
    for (std::size_t lane = 0; lane < (filled ? blocks() * width : stages()); ++lane)
      for (std::size_t j = 0; j < stages(); ++j)
        Lanes::set(matrix[j * blocks() + lane / width], lane % width,
                   T(numbers[std::min(lane, stages() - 1) * stages() + j]));
    return matrix;
  }

  /// The pack that holds component k of stage i.
  [[nodiscard]] const Lane& at(const Table& table, std::size_t i, std::size_t k) const {
    return table[k * blocks() + i / width];
  }
  [[nodiscard]] Lane& at(Table& table, std::size_t i, std::size_t k) const {
    return table[k * blocks() + i / width];
  }
  /// x in the lanes of stages, zero beyond the last one.
  [[nodiscard]] Lane of_stages([[maybe_unused]] std::size_t block, const Lane& x) const {
    if constexpr (width == 1 || (Stages != dynamic && Stages % static_cast<int>(width) == 0))
      return x;
    else
      return select(used_[block], x, Lane(0));
  }

 private:
  std::size_t components_, stages_;
  Row used_;  // 1 in the lanes of stages
};

}  // namespace pfaff
