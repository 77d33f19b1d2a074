// The implicit part of a collocation step, whatever the form of the equations: stages S_i and scaled rates
// L_i = rates(S_i) of m components with
//   S_i = line_i + sum_j m_ij L_j.
//
// Stages are lanes: those of one component lie side by side, four to a pack in double, so that the sums over
// j are formed for all of them together. Lanes beyond the last stage have zero coefficients. The first stages
// of a step are extrapolated from the rates of the step before, by the polynomial through them. A fixed-point
// iteration goes on until the rates are known (stage_convergence.hpp); where it contracts slowly, simplified
// Newton iteration can take over. The rates that remain are those at the last stages: an update by rates from
// one iteration earlier makes conserved quantities drift.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/solve/newton.hpp>
#include <pfaff/core/solve/sum_of_two.hpp>
#include <pfaff/integrators/runge_kutta/stage_convergence.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>

namespace pfaff {

namespace detail {
/// What holds several stages of a component, and how many.
template <class T>
struct StageLanes {
  using type = T;
  static constexpr std::size_t width = 1;
  static T get(const T& lanes, std::size_t /*lane*/) { return lanes; }
  static void set(T& lanes, std::size_t /*lane*/, const T& x) { lanes = x; }
};
template <>
struct StageLanes<double> {
  using type = Pack<4>;
  static constexpr std::size_t width = 4;
  static double get(const Pack<4>& lanes, std::size_t lane) { return lanes[lane]; }
  static void set(Pack<4>& lanes, std::size_t lane, double x) { lanes.set(lane, x); }
};
}  // namespace detail

/// a b, where both are known to the compiler.
constexpr int product_of_sizes(int a, int b) { return a == dynamic || b == dynamic ? dynamic : a * b; }

/// `Components` and `Stages` may be dynamic.
template <class T, int Components, int Stages>
class StageIteration {
  using Lanes = detail::StageLanes<T>;
  static constexpr std::size_t width = Lanes::width;
  static constexpr int blocks_known =
      Stages == dynamic ? dynamic : (Stages + static_cast<int>(width) - 1) / static_cast<int>(width);

 public:
  using Number = Value<T>;
  using Lane = typename Lanes::type;
  using Row = Vector<Lane, blocks_known>;  // a number for every stage

  /// The matrix m and the one that extrapolates the rates of the last step, row-major. `in_turns`: see
  /// StageConvergence. `newton`: whether to make room for solve_by_newton.
  StageIteration(std::size_t components, std::size_t stages, const std::vector<Number>& matrix,
                 const std::vector<Number>& extrapolation, bool in_turns, bool newton)
      : stages_(stages),
        components_(components),
        matrix_(stages * blocks()),
        extrapolation_(stages * blocks()),
        line_(components * blocks()),
        stage_(line_),
        rate_(line_),
        next_(line_),
        expected_(line_),
        moved_(components),
        small_(components),
        measures_(components),
        levels_(static_cast<std::size_t>(std::max(difference_levels<T> + 1 - static_cast<int>(stages), 0))),
        missed_(stages * components, levels_),
        in_turns_(in_turns),
        newton_(newton ? stages * components : 0) {
    for (std::size_t i = 0; i < stages; ++i)
      for (std::size_t j = 0; j < stages; ++j) {
        Lanes::set(matrix_[j * blocks() + i / width], i % width, T(matrix[i * stages + j]));
        Lanes::set(extrapolation_[j * blocks() + i / width], i % width, T(extrapolation[i * stages + j]));
      }
  }

  [[nodiscard]] std::size_t stages() const {
    return Stages == dynamic ? stages_ : static_cast<std::size_t>(Stages);
  }
  [[nodiscard]] std::size_t components() const {
    return Components == dynamic ? components_ : static_cast<std::size_t>(Components);
  }
  /// Blocks of lanes that hold all stages of a component.
  [[nodiscard]] std::size_t blocks() const { return (stages() + width - 1) / width; }
  /// One number for each stage, in lanes.
  [[nodiscard]] Row row_of(const std::vector<Number>& numbers) const {
    Row row(blocks());
    for (std::size_t i = 0; i < stages(); ++i) Lanes::set(row[i / width], i % width, T(numbers[i]));
    return row;
  }

  /// What a step sets before it solves: the lines of component k, block by block, and a size that its
  /// rates are measured against where they vanish.
  Lane& line(std::size_t k, std::size_t block) { return line_[k * blocks() + block]; }
  Sizes<T>& small(std::size_t k) { return small_[k]; }

  /// Are the rates of the last step known?
  [[nodiscard]] bool known() const { return known_; }
  void forget() {
    known_ = false;
    missed_.forget();
  }
  /// The rates of component k to begin with where they are not: scale_i x at stage i.
  void begin_with(std::size_t k, const T* scale, const T& x) {
    for (std::size_t i = 0; i < stages(); ++i) Lanes::set(at(rate_, i, k), i % width, scale[i] * x);
  }

  /// Component k of stage i, and of the rate there, for the function that evaluates rates.
  [[nodiscard]] T stage(std::size_t i, std::size_t k) const {
    return Lanes::get(at(stage_, i, k), i % width);
  }
  void set_rate(std::size_t i, std::size_t k, const T& x) { Lanes::set(at(next_, i, k), i % width, x); }

  /// The same for all stages in a block of lanes, for a function that evaluates them together. Rates in lanes
  /// beyond the last stage have to be zero.
  [[nodiscard]] const Lane& stages_in(std::size_t block, std::size_t k) const {
    return stage_[k * blocks() + block];
  }
  void set_rates(std::size_t block, std::size_t k, const Lane& x) { next_[k * blocks() + block] = x; }

  /// Solves for the rates. evaluate() calls set_rate for every stage and component. All components are judged
  /// together where `together`.
  template <class Evaluate>
  Status solve(const Evaluate& evaluate, bool together, auto&& iterations) {
    const bool extrapolated = known_;
    if (extrapolated) extrapolate();
    combine<false>(matrix_);
    evaluate();
    rate_ = next_;
    known_ = false;
    StageConvergence<T> convergence(in_turns_);
    do {
      convergence.begin_iteration();
      combine<true>(matrix_);
      evaluate();
      compare(convergence, together);
      ++iterations;
    } while (!convergence.finished());
    known_ = convergence.status() == Status::converged;
    if (extrapolated && known_ && levels_ > 0)
      missed_.remember([this](std::size_t k) { return rate_number(rate_, k) - rate_number(expected_, k); });
    return convergence.status();
  }

  /// The same by simplified Newton iteration, where the rates' derivatives are scale_j G, G m x m and
  /// row-major. Corrections of component k are measured by size(k).
  template <class Evaluate, class Size>
  [[gnu::noinline]] Status solve_by_newton(const Evaluate& evaluate, const std::vector<T>& slopes,
                                           const T* scale, const Size& size, auto&& iterations) {
    const std::size_t s = stages(), m = components();
    Newton& w = newton_;
    for (std::size_t row = 0; row < s * m; ++row)
      for (std::size_t column = 0; column < s * m; ++column) {
        const std::size_t i = row / m, j = column / m;
        const T coupling = Lanes::get(matrix_[j * blocks() + i / width], i % width) * scale[j] *
                           slopes[row % m * m + column % m];
        w.matrix(row, column) = (row == column ? Number(1) : Number(0)) - value_of(coupling);
      }
    if (!w.matrix.factor()) return Status::singular;
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t k = 0; k < m; ++k) {
        w.unknowns[i * m + k] = Lanes::get(at(line_, i, k), i % width);
        w.reference[i * m + k] = size(k);
      }
    const auto evaluate_there = [&] {
      for (std::size_t i = 0; i < s; ++i)
        for (std::size_t k = 0; k < m; ++k) Lanes::set(at(stage_, i, k), i % width, w.unknowns[i * m + k]);
      evaluate();
      rate_ = next_;
    };
    int count = 0;
    const Status status = newton<T>(
        w.matrix,
        [&](std::span<T> unknowns, std::span<T> residual) {
          evaluate_there();
          combine<false>(matrix_);
          for (std::size_t i = 0; i < s; ++i)
            for (std::size_t k = 0; k < m; ++k) residual[i * m + k] = unknowns[i * m + k] - stage(i, k);
        },
        w.unknowns, w.reference, w.residual, w.correction, 100, count);
    iterations += count;
    if (status != Status::converged) return status;
    evaluate_there();
    known_ = true;
    return status;
  }

  /// sum_j weights_j L_j of component k, and what its additions rounded off.
  void total(const Row& weights, std::size_t k, T& sum, T& lost) const {
    const Lane* rate = rate_.data() + k * blocks();
    Lane sums = weights[0] * rate[0], rest(0);
    for (std::size_t b = 1; b < blocks(); ++b) {
      Lane error;
      two_sum(sums, weights[b] * rate[b], sums, error);
      rest = rest + error;
    }
    sum = Lanes::get(sums, 0);
    lost = Lanes::get(rest, 0);
    for (std::size_t lane = 1; lane < width; ++lane) {
      T error;
      two_sum(sum, Lanes::get(sums, lane), sum, error);
      lost = lost + (error + Lanes::get(rest, lane));
    }
  }

 private:
  using Matrix = Vector<Lane, product_of_sizes(Stages, blocks_known)>;     // [column][block of rows]
  using Table = Vector<Lane, product_of_sizes(Components, blocks_known)>;  // [component][block of stages]

  struct Newton {
    explicit Newton(std::size_t n) : matrix(n), unknowns(n), reference(n), residual(n), correction(n) {}
    LU<Number> matrix;
    std::vector<T> unknowns, reference, residual, correction;
  };

  // The pack that holds component k of stage i.
  [[nodiscard]] const Lane& at(const Table& table, std::size_t i, std::size_t k) const {
    return table[k * blocks() + i / width];
  }
  [[nodiscard]] Lane& at(Table& table, std::size_t i, std::size_t k) const {
    return table[k * blocks() + i / width];
  }

  // The rates that the polynomial through the last ones has in this step, and, where few stages make a
  // polynomial of low degree, what it is expected to miss.
  void extrapolate() {
    for (std::size_t k = 0; k < components(); ++k)
      for (std::size_t b = 0; b < blocks(); ++b) {
        Lane sum(0);
        for (std::size_t j = 0; j < stages(); ++j)
          sum = sum + extrapolation_[j * blocks() + b] * Lane(Lanes::get(at(rate_, j, k), j % width));
        expected_[k * blocks() + b] = sum;
      }
    rate_ = expected_;
    if (levels_ == 0) return;
    for (std::size_t k = 0; k < components() * stages(); ++k) {
      Lane& lanes = at(rate_, k % stages(), k / stages());
      const std::size_t lane = k % stages() % width;
      Lanes::set(lanes, lane, Lanes::get(lanes, lane) + missed_.expected(k));
    }
  }
  // Number k of all rates, the stages of a component in a row.
  [[nodiscard]] T rate_number(const Table& table, std::size_t k) const {
    return Lanes::get(at(table, k % stages(), k / stages()), k % stages() % width);
  }

  // The stages that the rates make, and how far they have moved.
  template <bool Measured>
  void combine(const Matrix& matrix) {
    for (std::size_t k = 0; k < components(); ++k) {
      Sizes<Lane> moved;
      std::size_t block = 0;
      for (; block + 1 < blocks(); block += 2) combine_blocks<2, Measured>(matrix, k, block, moved);
      if (block < blocks()) combine_blocks<1, Measured>(matrix, k, block, moved);
      if constexpr (Measured) moved_[k] = moved;
    }
  }
  template <std::size_t Count, bool Measured>
  void combine_blocks(const Matrix& matrix, std::size_t k, std::size_t block, Sizes<Lane>& moved) {
    std::array<Lane, Count> sum;
    for (std::size_t b = 0; b < Count; ++b) sum[b] = Lane(0);
    for (std::size_t j = 0; j < stages(); ++j) {
      const Lane rate(Lanes::get(at(rate_, j, k), j % width));
      for (std::size_t b = 0; b < Count; ++b) sum[b] = sum[b] + matrix[j * blocks() + block + b] * rate;
    }
    for (std::size_t b = 0; b < Count; ++b) {
      Lane& stage = stage_[k * blocks() + block + b];
      const Lane next = line_[k * blocks() + block + b] + sum[b];
      if constexpr (Measured) moved.add(next - stage);
      stage = next;
    }
  }

  // What the change of a component is judged by, part by part.
  struct Measure {
    std::array<Number, Sizes<T>::parts> stages{}, rates{}, sizes{};
  };

  // Takes the rates that have been evaluated, and measures how far they have moved.
  void compare(StageConvergence<T>& convergence, bool together) {
    constexpr std::size_t parts = Sizes<T>::parts;
    std::array<Measure, 2> group;
    for (std::size_t k = 0; k < components(); ++k) {
      Sizes<Lane> changed, size;
      for (std::size_t b = 0; b < blocks(); ++b) {
        const Lane& next = next_[k * blocks() + b];
        Lane& rate = rate_[k * blocks() + b];
        changed.add(next - rate);
        size.add(next);
        rate = next;
      }
      Measure& measure = measures_[k];
      Measure& all = group[group_of(k)];
      for (std::size_t part = 0; part < parts; ++part) {
        measure.stages[part] = moved_[k].part(part);
        measure.rates[part] = changed.part(part);
        measure.sizes[part] = size.part(part) + small_[k].part(part);
        all.stages[part] = all.stages[part] + measure.stages[part];
        all.rates[part] = all.rates[part] + measure.rates[part];
        all.sizes[part] = all.sizes[part] + measure.sizes[part];
      }
    }
    for (std::size_t part = 0; part < parts; ++part) {
      if (together)
        convergence.add(part, group[0].stages[part] + group[1].stages[part],
                        group[0].rates[part] + group[1].rates[part],
                        group[0].sizes[part] + group[1].sizes[part]);
      for (std::size_t k = 0; k < components() && !together; ++k) {
        const Measure& one = measures_[k];
        convergence.add(part, one.stages[part], one.rates[part],
                        one.sizes[part] + group[group_of(k)].sizes[part] * negligible);
      }
    }
  }
  // Components of a group are measured against each other: what is 2^-26 times as large as they are together,
  // such as the front of a wave that enters a chain, need not be known to its own last digit. Positions and
  // momenta of a chart may be forty decades apart, and are two groups.
  static constexpr Number negligible{0x1p-26};
  [[nodiscard]] std::size_t group_of(std::size_t k) const {
    return in_turns_ && 2 * k >= components() ? 1 : 0;
  }

  std::size_t stages_, components_;
  Matrix matrix_, extrapolation_;
  Table line_, stage_, rate_, next_, expected_;
  Vector<Sizes<Lane>, Components> moved_;
  Vector<Sizes<T>, Components> small_;
  Vector<Measure, Components> measures_;
  // A polynomial through s stages predicts as much as s - 1 differences from step to step.
  std::size_t levels_;
  DifferencePredictor<T, dynamic, dynamic> missed_;
  bool in_turns_, known_ = false;
  Newton newton_;
};

}  // namespace pfaff
