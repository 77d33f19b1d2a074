#include <pfaff/core/tape/derivatives.hpp>

#include <algorithm>

#include <pfaff/core/tape/operands.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/sparse_gradients.hpp>

namespace pfaff {

namespace {
template <class T>
struct Operands {
  std::vector<T> matrix, right_hand_side;
};
template <class T>
Operands<T> operands_of(const LinearSystem& system, const std::vector<T>& slots) {
  Operands<T> o;
  for (const int slot : system.matrix) o.matrix.push_back(slots[static_cast<std::size_t>(slot)]);
  for (const int slot : system.right_hand_side)
    o.right_hand_side.push_back(slots[static_cast<std::size_t>(slot)]);
  return o;
}
std::shared_ptr<const Tape> borrow(const Tape& tape) { return {std::shared_ptr<const Tape>(), &tape}; }
}  // namespace

void TapeSolver<Recorded>::operator()(const LinearSystem& system, std::vector<Recorded>& slots,
                                      std::size_t first) const {
  const auto o = operands_of(system, slots);
  const auto x = solve(o.matrix, o.right_hand_side);
  for (std::size_t i = 0; i < size_; ++i) slots[first + i] = x[i];
}

void TapeSolver<Dual<Recorded, 1>>::operator()(const LinearSystem& system,
                                               std::vector<Dual<Recorded, 1>>& slots,
                                               std::size_t first) const {
  const auto o = operands_of(system, slots);
  std::vector<Recorded> a, da, b;
  for (const auto& e : o.matrix) {
    a.push_back(e.value);
    da.push_back(e.derivative[0]);
  }
  for (const auto& e : o.right_hand_side) b.push_back(e.value);
  const auto x = solve(a, b);
  for (std::size_t i = 0; i < size_; ++i) {
    b[i] = o.right_hand_side[i].derivative[0];
    for (std::size_t j = 0; j < size_; ++j) b[i] = b[i] - da[i * size_ + j] * x[j];
  }
  bool constant = true;
  for (const Recorded& e : b) constant = constant && structurally_zero(e);
  const auto dx = constant ? b : solve(a, b);
  for (std::size_t i = 0; i < size_; ++i) {
    slots[first + i].value = x[i];
    slots[first + i].derivative[0] = dx[i];
  }
}

std::vector<Recorded> evaluate(const Tape& tape, const Recorded& t, std::span<const Recorded> z) {
  Replay<Recorded> replay(borrow(tape));
  std::vector<Recorded> outputs(tape.outputs.size());
  replay(t, z.data(), outputs.data());
  return outputs;
}

std::vector<Recorded> directional_derivative(const Tape& tape, const Recorded& t, const Recorded& t_direction,
                                             std::span<const Recorded> z,
                                             std::span<const Recorded> direction) {
  using Directional = Dual<Recorded, 1>;
  Replay<Directional> replay(borrow(tape));
  std::vector<Directional> x(z.size()), y(tape.outputs.size());
  for (std::size_t k = 0; k < z.size(); ++k) {
    x[k].value = z[k];
    x[k].derivative[0] = direction[k];
  }
  Directional time(t);
  time.derivative[0] = t_direction;
  replay(time, x.data(), y.data());
  std::vector<Recorded> result;
  for (const Directional& e : y) result.push_back(e.derivative[0]);
  return result;
}

std::vector<Recorded> time_derivative(const Tape& tape, const Recorded& t, std::span<const Recorded> z) {
  return directional_derivative(tape, t, Recorded(1), z, std::vector<Recorded>(z.size()));
}

namespace {
// When an instruction's value is used: always, or only where a condition is positive because every use is in
// a branch of a select. A branch that is not taken has the adjoint 0, but 0 times the derivative of a root of
// a negative number is NaN; its contributions are therefore selected away too.
class Guard {
 public:
  static Guard always() { return Guard(true, Recorded()); }
  Guard() = default;

  /// The guard of a value that is used in one branch of a select which has this guard itself: in the branch
  /// that is taken where `condition` > 0 (`taken`), or in the other.
  [[nodiscard]] Guard within(const Recorded& condition, bool taken) const {
    const Recorded branch = taken ? condition : negated(condition);
    return Guard(false, always_ ? branch : select(condition_, branch, Recorded(-1)));
  }
  /// Adds a second use to those of this guard.
  void join(const Guard& other) {
    if (always_ || other.always_) {
      *this = always();
    } else if (!used_) {
      *this = other;
    } else if (same(condition_, negated(other.condition_)) || same(negated(condition_), other.condition_)) {
      *this = always();
    } else if (!same(condition_, other.condition_)) {
      condition_ = select(condition_, Recorded(1), other.condition_);
    }
  }
  /// `contribution` where the value is used, 0 elsewhere.
  [[nodiscard]] Recorded operator()(const Recorded& contribution) const {
    return always_ || contribution.is_constant() ? contribution
                                                 : select(condition_, contribution, Recorded(0));
  }

 private:
  Guard(bool always, const Recorded& condition) : used_(true), always_(always), condition_(condition) {}
  static Recorded negated(const Recorded& condition) { return select(condition, Recorded(-1), Recorded(1)); }
  static bool same(const Recorded& a, const Recorded& b) { return !a.is_constant() && a.slot() == b.slot(); }

  bool used_ = false, always_ = false;
  Recorded condition_;
};

// The adjoints of the slots of a tape (reverse mode), of which only those are kept that depend on the first
// inputs, the variables: all others have no part in a gradient.
class Adjoints {
 public:
  /// `x` are the values of the slots.
  Adjoints(const Tape& tape, const std::vector<Recorded>& x, std::size_t variables)
      : tape_(tape), x_(x), adjoint_(x.size()), active_(x.size(), 0) {
    if (std::any_of(tape.code.begin(), tape.code.end(),
                    [](const Instruction& i) { return i.operation == Operation::select; }))
      guards_.resize(x.size());
    for (std::size_t k = static_cast<std::size_t>(tape.state_begin); k < x.size(); ++k) {
      const Instruction& i = tape.code[k];
      const std::size_t start = group_start(tape.code, k);
      if (i.operation == Operation::input) {
        active_[k] = static_cast<std::size_t>(i.a) < variables ? 1 : 0;
      } else if (start != k) {
        active_[k] = active_[start];
      } else {
        operands(i, tape.solves, [&](int slot) { active_[k] |= active_[static_cast<std::size_t>(slot)]; });
      }
    }
  }

  [[nodiscard]] bool active(std::size_t k) const { return active_[k] != 0; }
  void seed(int slot, const Recorded& weight) { add_within(always_, slot, weight); }
  void clear(std::size_t k) {
    adjoint_[k] = Recorded();
    if (!guards_.empty()) guards_[k] = Guard();
  }

  /// Hands the adjoint of slot k on to the operands, or to result(input, adjoint) where it is an input. Slots
  /// are taken from the last to the first.
  template <class Result>
  void pass_on(std::size_t k, Result&& result) {
    const Instruction& i = tape_.code[k];
    const Recorded w = adjoint_[k];
    const auto at = [&](int slot) -> const Recorded& { return x_[static_cast<std::size_t>(slot)]; };
    // `pass` hands an adjoint on as it is. `add` is for an adjoint times a derivative, which may be NaN in a
    // branch that is not taken and is therefore guarded.
    const auto pass = [&](int slot, const Recorded& value) { add_within(guard(k), slot, value); };
    const auto add = [&](int slot, const Recorded& value) {
      if (active(static_cast<std::size_t>(slot))) add_within(guard(k), slot, guard(k)(value));
    };
    if (i.operation == Operation::solve) {
      // A x = b: b_bar = A^-T x_bar, A_bar = -b_bar x^T.
      const LinearSystem& system = tape_.solves[static_cast<std::size_t>(i.a)];
      const auto n = static_cast<std::size_t>(system.size);
      std::vector<Recorded> transposed(n * n), bar(n);
      bool zero = true;
      for (std::size_t r = 0; r < n; ++r) {
        bar[r] = adjoint_[k + r];
        if (!guards_.empty() && !structurally_zero(bar[r])) guards_[k].join(guards_[k + r]);
        zero = zero && structurally_zero(bar[r]);
        for (std::size_t c = 0; c < n; ++c) transposed[c * n + r] = at(system.matrix[r * n + c]);
      }
      if (zero) return;
      const auto b_bar = solve(transposed, bar);
      for (std::size_t r = 0; r < n; ++r) {
        add(system.right_hand_side[r], b_bar[r]);
        for (std::size_t c = 0; c < n; ++c) add(system.matrix[r * n + c], -(b_bar[r] * x_[k + c]));
      }
      return;
    }
    if (structurally_zero(w)) return;
    switch (i.operation) {
      case Operation::input:
        result(static_cast<std::size_t>(i.a), w);
        break;
      case Operation::negate:
        pass(i.a, -w);
        break;
      case Operation::add:
        pass(i.a, w);
        pass(i.b, w);
        break;
      case Operation::subtract:
        pass(i.a, w);
        pass(i.b, -w);
        break;
      case Operation::multiply:
        add(i.a, w * at(i.b));
        add(i.b, w * at(i.a));
        break;
      case Operation::divide:
        add(i.a, w / at(i.b));
        add(i.b, -(w * x_[k] / at(i.b)));
        break;
      case Operation::square_root:
        add(i.a, w / (Recorded(2) * x_[k]));
        break;
      case Operation::exponential:
        add(i.a, w * x_[k]);
        break;
      case Operation::logarithm:
        add(i.a, w / at(i.a));
        break;
      case Operation::sine:
        add(i.a, w * x_[k + 1]);
        break;
      case Operation::cosine:
        add(i.a, -(w * x_[k - 1]));
        break;
      case Operation::power: {
        const Real& y = tape_.constants[static_cast<std::size_t>(i.b)];
        add(i.a, w * (Recorded(y) * pow(at(i.a), y - Real(1))));
        break;
      }
      case Operation::special:
        add(i.a, w * at(i.b));
        break;
      case Operation::select:
        add_within(guard(k).within(at(i.a), true), i.b, select(at(i.a), w, Recorded(0)));
        add_within(guard(k).within(at(i.a), false), i.c, select(at(i.a), Recorded(0), w));
        break;
      default:
        break;
    }
  }

 private:
  [[nodiscard]] const Guard& guard(std::size_t k) const { return guards_.empty() ? always_ : guards_[k]; }
  void add_within(const Guard& guard, int slot, const Recorded& value) {
    const auto k = static_cast<std::size_t>(slot);
    if (structurally_zero(value) || !active(k)) return;
    adjoint_[k] = adjoint_[k] + value;
    if (!guards_.empty()) guards_[k].join(guard);
  }

  const Tape& tape_;
  const std::vector<Recorded>& x_;
  std::vector<Recorded> adjoint_;
  std::vector<Guard> guards_;  // none where the tape has no select
  Guard always_ = Guard::always();
  std::vector<char> active_;
};
}  // namespace

std::vector<Recorded> gradient(const Tape& tape, const Recorded& t, std::span<const Recorded> z,
                               std::span<const Recorded> weights) {
  Replay<Recorded> replay(borrow(tape));
  std::vector<Recorded> outputs(tape.outputs.size()), result(z.size());
  replay(t, z.data(), outputs.data());
  Adjoints adjoints(tape, replay.slots(), z.size());
  for (std::size_t k = 0; k < weights.size(); ++k) adjoints.seed(tape.outputs[k], weights[k]);
  // Functions of constants and time alone have no gradient: the sweep stops at the first state instruction.
  for (std::size_t k = tape.code.size(); k-- > static_cast<std::size_t>(tape.state_begin);)
    adjoints.pass_on(k, [&](std::size_t input, const Recorded& w) { result[input] = w; });
  return result;
}

std::vector<SparseGradient> sparse_gradients(const Tape& tape, const Recorded& t, std::span<const Recorded> z,
                                             std::size_t variables) {
  Replay<Recorded> replay(borrow(tape));
  std::vector<Recorded> outputs(tape.outputs.size());
  replay(t, z.data(), outputs.data());
  Adjoints adjoints(tape, replay.slots(), variables);
  std::vector<SparseGradient> rows(tape.outputs.size());
  std::vector<std::size_t> reached(tape.code.size(), 0), cone;  // `reached` from output r: r + 1
  for (std::size_t r = 0; r < rows.size(); ++r) {
    cone.clear();
    const auto reach = [&](std::size_t slot) {
      if (!adjoints.active(slot) || reached[slot] == r + 1) return;
      reached[slot] = r + 1;
      cone.push_back(slot);
    };
    reach(static_cast<std::size_t>(tape.outputs[r]));
    // NOLINTNEXTLINE(modernize-loop-convert): the cone grows
    for (std::size_t next = 0; next < cone.size(); ++next) {
      const std::size_t k = cone[next];
      if (tape.code[k].operation == Operation::solve_next) reach(group_start(tape.code, k));
      operands(tape.code[k], tape.solves, [&](int slot) { reach(static_cast<std::size_t>(slot)); });
    }
    std::sort(cone.begin(), cone.end());
    adjoints.seed(tape.outputs[r], Recorded(1));
    for (std::size_t next = cone.size(); next-- > 0;)
      adjoints.pass_on(cone[next], [&](std::size_t input, const Recorded& w) {
        if (!structurally_zero(w)) rows[r].emplace_back(input, w);
      });
    for (const std::size_t k : cone) adjoints.clear(k);
    std::sort(rows[r].begin(), rows[r].end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  return rows;
}

std::vector<Recorded> jacobian(const Tape& tape, const Recorded& t, std::span<const Recorded> z) {
  const std::size_t rows = tape.outputs.size(), columns = z.size();
  std::vector<Recorded> result(rows * columns);
  if (rows < columns) {
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<Recorded> weights(rows);
      weights[r] = Recorded(1);
      const auto row = gradient(tape, t, z, weights);
      for (std::size_t c = 0; c < columns; ++c) result[r * columns + c] = row[c];
    }
    return result;
  }
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<Recorded> direction(columns);
    direction[c] = Recorded(1);
    const auto column = directional_derivative(tape, t, Recorded(0), z, direction);
    for (std::size_t r = 0; r < rows; ++r) result[r * columns + c] = column[r];
  }
  return result;
}

Tape jacobian_tape(const Tape& tape) {
  const int rows = static_cast<int>(tape.outputs.size());
  return record(tape.inputs, rows * tape.inputs,
                [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
                  const auto j = jacobian(tape, t, z);
                  for (std::size_t k = 0; k < j.size(); ++k) out[k] = j[k];
                });
}

}  // namespace pfaff
