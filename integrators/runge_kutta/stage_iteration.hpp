// The implicit part of a collocation step, whatever the form of the equations: stages S_i and scaled rates
// L_i = rates(S_i) of m components with
//   S_i = line_i + sum_j m_ij L_j.
//
// Stages are lanes (stage_lanes.hpp), so that the sums over j are formed for all of them together. The first
// stages of a step are extrapolated from the rates of the step before, by the polynomial through them. A
// fixed-point iteration goes on until the rates are known (stage_convergence.hpp); where it contracts slowly,
// simplified Newton iteration can take over. The rates that remain are those at the last stages: an update by
// rates from one iteration earlier makes conserved quantities drift.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/numbers/sum_of_two.hpp>
#include <pfaff/integrators/runge_kutta/stage_convergence.hpp>
#include <pfaff/integrators/runge_kutta/stage_lanes.hpp>
#include <pfaff/integrators/runge_kutta/stage_newton.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>

namespace pfaff {

/// `Components` and `Stages` may be dynamic.
template <class T, int Components, int Stages>
class StageIteration : private StageLayout<T, Components, Stages> {
  using Layout = StageLayout<T, Components, Stages>;
  using Layout::at, Layout::blocks_known, Layout::of_stages, Layout::width;
  using typename Layout::Lanes, typename Layout::Matrix;
  static constexpr std::size_t parts = Sizes<T>::parts;

 public:
  using Layout::blocks, Layout::components, Layout::filled_row_of, Layout::row_of, Layout::stages;
  using typename Layout::Lane, typename Layout::Number, typename Layout::Row, typename Layout::Table;

  /// The matrix m and the one that extrapolates the rates of the last step, row-major. `in_turns`: see
  /// StageConvergence. `newton`: whether to make room for solve_by_newton now, so that no step allocates.
  StageIteration(std::size_t component_count, std::size_t stage_count, const std::vector<Number>& matrix,
                 const std::vector<Number>& extrapolation, bool in_turns, bool newton)
      : Layout(component_count, stage_count),
        matrix_(this->matrix_of(matrix, true)),
        extrapolation_(this->matrix_of(extrapolation, false)),
        line_(components() * blocks()),
        stage_(line_),
        rate_(line_),
        before_(line_),
        expected_(line_),
        moved_(components()),
        small_(components()),
        scale_(components()),
        missed_(stages() * components(), levels()),
        in_turns_(in_turns),
        newton_(newton ? std::make_unique<StageNewton<T>>(stages(), components()) : nullptr) {}

  /// What a step sets before it solves: the lines of component k, block by block and filled with copies of
  /// the last, and a size that its rates are measured against where they vanish.
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

  /// Component k of stage i among those that a function is given that evaluates rates, and of the rate there.
  [[nodiscard]] T stage(const Table& table, std::size_t i, std::size_t k) const {
    return Lanes::get(at(table, i, k), i % width);
  }
  void set_rate(std::size_t i, std::size_t k, const T& x) { Lanes::set(at(rate_, i, k), i % width, x); }

  /// The same for all stages in a block of lanes, for a function that evaluates them together.
  [[nodiscard]] const Lane& stages_in(const Table& table, std::size_t block, std::size_t k) const {
    return table[k * blocks() + block];
  }
  void set_rates(std::size_t block, std::size_t k, const Lane& x) {
    rate_[k * blocks() + block] = of_stages(block, x);
  }

  /// Solves for the rates. evaluate(stages) calls set_rate for every stage and component. All components are
  /// judged together where `together`. `Inlined` says whether that code becomes part of this function, where
  /// numbers stay in registers while it runs, or calls others.
  template <bool Inlined, class Evaluate>
  Status solve(const Evaluate& evaluate, bool together, auto&& iterations) {
    const bool extrapolated = known_;
    if (extrapolated) extrapolate();
    known_ = false;
    StageConvergence<T> convergence(in_turns_);
    // A local matrix whose columns are a register each is kept in registers by the compiler; a member it
    // would read again after every number that is written. A matrix of twice as many registers does not fit,
    // and a copy of it would only cost time.
    constexpr bool fits = Inlined && blocks_known == 1 && Lanes::in_one_register;
    const std::conditional_t<fits, Matrix, const Matrix&> matrix = matrix_;
    evaluate_at_stages(evaluate, matrix);
    before_ = rate_;
    measure(together);
    do {
      convergence.begin_iteration();
      evaluate_at_stages(evaluate, matrix);
      if constexpr (Stages == dynamic)
        compare_apart(convergence, together);
      else
        compare(convergence, together);
      ++iterations;
    } while (!convergence.finished());
    known_ = convergence.status() == Status::converged;
    if (extrapolated && known_ && levels() > 0)
      missed_.remember([this](std::size_t k) { return rate_number(rate_, k) - rate_number(expected_, k); });
    return convergence.status();
  }

  /// The same by simplified Newton iteration (stage_newton.hpp), where the rates' derivatives are scale_j G,
  /// G m x m and row-major. Corrections of component k are measured by size(k) or, in the end, by what
  /// rounded(sizes) fills in for the components.
  template <class Evaluate, class Size, class Rounded>
  [[gnu::noinline]] Status solve_by_newton(const Evaluate& evaluate, const std::vector<T>& slopes,
                                           const T* scale, const Size& size, const Rounded& rounded,
                                           auto&& iterations) {
    const std::size_t s = stages(), m = components();
    if (!newton_) newton_ = std::make_unique<StageNewton<T>>(s, m);
    StageNewton<T>& newton = *newton_;
    const bool regular = newton.factor([&](std::size_t i, std::size_t k, std::size_t j, std::size_t l) {
      return value_of(
          T(Lanes::get(matrix_[j * blocks() + i / width], i % width) * scale[j] * slopes[k * m + l]));
    });
    if (!regular) return Status::singular;
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t i = 0; i < s; ++i) newton.begin(i, k, Lanes::get(at(line_, i, k), i % width), size(k));
    const auto evaluate_there = [&] {
      for (std::size_t lane = 0; lane < blocks() * width; ++lane)
        for (std::size_t k = 0; k < m; ++k)
          Lanes::set(at(stage_, lane, k), lane % width, newton.stage(std::min(lane, s - 1), k));
      evaluate(stage_);
    };
    const Status status = newton.solve(
        [&](std::span<T> unknowns, std::span<T> residual) {
          evaluate_there();
          combine_apart(stage_);
          for (std::size_t i = 0; i < s; ++i)
            for (std::size_t k = 0; k < m; ++k)
              residual[i * m + k] = unknowns[i * m + k] - stage(stage_, i, k);
        },
        rounded, iterations);
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
    detail::add_lanes(sums, rest, sum, lost);
  }

 private:
  // f(k) for every component, unrolled where they are few. What an iteration consists of is inlined by force:
  // GCC leaves it in functions of its own, behind which numbers wait for the store buffer.
  template <class F>
  [[gnu::always_inline]] void for_components(const F& f) const {
    if constexpr (Components != dynamic && Components <= 3) {
      f(0);
      if constexpr (Components > 1) f(1);
      if constexpr (Components > 2) f(2);
    } else {
      for (std::size_t k = 0; k < components(); ++k) f(k);
    }
  }

  // The rate of component k at stage i, in every lane.
  [[nodiscard]] Lane rate_of(std::size_t i, std::size_t k) const {
    return Lane(Lanes::get(at(rate_, i, k), i % width));
  }

  // The rates that the polynomial through the last ones has in this step, and, where few stages make a
  // polynomial of low degree, what it is expected to miss.
  void extrapolate() {
    for_components([&](std::size_t k) __attribute__((always_inline)) {
      for (std::size_t b = 0; b < blocks(); ++b) {
        Lane sum = extrapolation_[b] * rate_of(0, k);
        for (std::size_t j = 1; j < stages(); ++j)
          sum = sum + extrapolation_[j * blocks() + b] * rate_of(j, k);
        expected_[k * blocks() + b] = of_stages(b, sum);
      }
    });
    rate_ = expected_;
    if (levels() == 0) return;
    for (std::size_t k = 0; k < components() * stages(); ++k) {
      Lane& lanes = at(rate_, k % stages(), k / stages());
      const std::size_t lane = k % stages() % width;
      Lanes::set(lanes, lane, Lanes::get(lanes, lane) + missed_.expected(k));
    }
  }
  // A polynomial through s stages predicts as much as s - 1 differences from step to step.
  [[nodiscard]] std::size_t levels() const {
    return static_cast<std::size_t>(std::max(difference_levels<T> + 1 - static_cast<int>(stages()), 0));
  }
  // Number k of all rates, the stages of a component in a row.
  [[nodiscard]] T rate_number(const Table& table, std::size_t k) const {
    return Lanes::get(at(table, k % stages(), k / stages()), k % stages() % width);
  }

  // Makes the stages and evaluates rates there. A local table of known size stays in registers on the way,
  // where one in memory would have to be stored before it could be read.
  template <class Evaluate>
  [[gnu::always_inline]] void evaluate_at_stages(const Evaluate& evaluate, const Matrix& matrix) {
    if constexpr (std::is_same_v<Table, Vector<Lane, dynamic>>) {
      combine_apart(stage_);
      evaluate(stage_);
    } else {
      Table table;
      combine(matrix, table);
      evaluate(table);
    }
  }
  // The stages that the rates make, and how far they have moved.
  [[gnu::always_inline]] void combine(const Matrix& matrix, Table& table) {
    for_components([&](std::size_t k) __attribute__((always_inline)) {
      moved_[k] = {};
      std::size_t block = 0;
      for (; block + 1 < blocks(); block += 2) combine_blocks<2>(matrix, table, k, block);
      if (block < blocks()) combine_blocks<1>(matrix, table, k, block);
    });
  }
  template <std::size_t Count>
  [[gnu::always_inline]] void combine_blocks(const Matrix& matrix, Table& table, std::size_t k,
                                             std::size_t block) {
    std::array<Lane, Count> sum;
    const Lane first = rate_of(0, k);
    for (std::size_t b = 0; b < Count; ++b) sum[b] = matrix[block + b] * first;
    for (std::size_t j = 1; j < stages(); ++j) {
      const Lane rate = rate_of(j, k);
      for (std::size_t b = 0; b < Count; ++b) sum[b] = sum[b] + matrix[j * blocks() + block + b] * rate;
    }
    for (std::size_t b = 0; b < Count; ++b) {
      const std::size_t place = k * blocks() + block + b;
      const Lane next = line_[place] + sum[b];
      moved_[k].add(of_stages(block + b, next - stage_[place]));
      stage_[place] = next;
      table[place] = next;
    }
  }

  // Where the number of stages is not known, one copy serves all.
  [[gnu::noinline]] void combine_apart(Table& table) { combine(matrix_, table); }
  [[gnu::noinline]] void compare_apart(StageConvergence<T>& convergence, bool together) {
    compare(convergence, together);
  }

  // What changes of rates and stages are measured against: the rates themselves and, where those vanish, a
  // small part of what they are added to.
  void measure(bool together) {
    std::array<std::array<Number, parts>, 2> group{};
    for (std::size_t k = 0; k < components(); ++k) {
      Sizes<Lane> size;
      for (std::size_t b = 0; b < blocks(); ++b) size.add(rate_[k * blocks() + b]);
      for (std::size_t part = 0; part < parts; ++part) {
        scale_[k][part] = size.part(part) + small_[k].part(part);
        Number& all = group[group_of(k)][part];
        all = all + scale_[k][part];
      }
    }
    for (std::size_t k = 0; k < components(); ++k)
      for (std::size_t part = 0; part < parts; ++part) {
        const Number size = together ? group[0][part] + group[1][part]
                                     : scale_[k][part] + group[group_of(k)][part] * negligible;
        scale_[k][part] = Number(1) / (size + Number(std::numeric_limits<double>::min()));
      }
  }
  // Components of a group are measured against each other: what is 2^-26 times as large as they are together,
  // such as the front of a wave that enters a chain, need not be known to its own last digit. Positions and
  // momenta of a chart may be forty decades apart, and are two groups.
  static constexpr Number negligible{0x1p-26};
  [[nodiscard]] std::size_t group_of(std::size_t k) const {
    return in_turns_ && 2 * k >= components() ? 1 : 0;
  }

  // Takes the rates that have been evaluated, and judges how far they have moved. Where they have changed
  // much, what they are measured against has, too.
  [[gnu::always_inline]] void compare(StageConvergence<T>& convergence, bool together) {
    std::array<Number, parts> moves{}, changes{};
    for_components([&](std::size_t k) __attribute__((always_inline)) {
      Sizes<Lane> changed;
      for (std::size_t b = 0; b < blocks(); ++b) {
        const Lane& rate = rate_[k * blocks() + b];
        Lane& before = before_[k * blocks() + b];
        changed.add(rate - before);
        before = rate;
      }
      for (std::size_t part = 0; part < parts; ++part) {
        const Number moved = moved_[k].part(part) * scale_[k][part],
                     change = changed.part(part) * scale_[k][part];
        if (together) {
          moves[part] = moves[part] + moved;
          changes[part] = changes[part] + change;
        } else {
          convergence.add(part, moved, change);
        }
      }
    });
    for (std::size_t part = 0; part < parts; ++part)
      if (together) convergence.add(part, moves[part], changes[part]);
    if (convergence.changed_by_more_than(Number(0x1p-4))) measure(together);
  }

  Matrix matrix_, extrapolation_;
  Table line_, stage_, rate_, before_, expected_;
  Vector<Sizes<Lane>, Components> moved_;
  Vector<Sizes<T>, Components> small_;
  Vector<std::array<Number, parts>, Components> scale_;  // the reciprocal
  DifferencePredictor<T, dynamic, dynamic> missed_;
  bool in_turns_, known_ = false;
  std::unique_ptr<StageNewton<T>> newton_;
};

}  // namespace pfaff
