#include <pfaff/core/tape/derivatives.hpp>

#include <pfaff/core/tape/replay.hpp>

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
}  // namespace

std::vector<Recorded> gradient(const Tape& tape, const Recorded& t, std::span<const Recorded> z,
                               std::span<const Recorded> weights) {
  Replay<Recorded> replay(borrow(tape));
  std::vector<Recorded> outputs(tape.outputs.size());
  replay(t, z.data(), outputs.data());
  const std::vector<Recorded>& x = replay.slots();
  std::vector<Recorded> adjoint(x.size()), result(z.size());
  std::vector<Guard> guards(x.size());
  const auto at = [&](int slot) -> const Recorded& { return x[static_cast<std::size_t>(slot)]; };
  const auto add_within = [&](const Guard& guard, int slot, const Recorded& value) {
    if (structurally_zero(value)) return;
    Recorded& a = adjoint[static_cast<std::size_t>(slot)];
    a = a + value;
    guards[static_cast<std::size_t>(slot)].join(guard);
  };
  for (std::size_t k = 0; k < weights.size(); ++k) add_within(Guard::always(), tape.outputs[k], weights[k]);

  // Functions of constants and time alone have no gradient: the sweep stops at the first state instruction.
  for (std::size_t k = x.size(); k-- > static_cast<std::size_t>(tape.state_begin);) {
    const Instruction& i = tape.code[k];
    const Recorded& w = adjoint[k];
    // `pass` hands an adjoint on as it is. `add` is for an adjoint times a derivative, which may be NaN in a
    // branch that is not taken and is therefore guarded.
    const auto pass = [&](int slot, const Recorded& value) { add_within(guards[k], slot, value); };
    const auto add = [&](int slot, const Recorded& value) { add_within(guards[k], slot, guards[k](value)); };
    if (i.operation == Operation::solve) {
      // A x = b: b_bar = A^-T x_bar, A_bar = -b_bar x^T.
      const auto s = static_cast<std::size_t>(i.a);
      const LinearSystem& system = tape.solves[s];
      const auto n = static_cast<std::size_t>(system.size);
      std::vector<Recorded> transposed(n * n), bar(n);
      bool zero = true;
      for (std::size_t r = 0; r < n; ++r) {
        bar[r] = adjoint[k + r];
        if (!structurally_zero(bar[r])) guards[k].join(guards[k + r]);
        zero = zero && structurally_zero(bar[r]);
        for (std::size_t c = 0; c < n; ++c) transposed[c * n + r] = at(system.matrix[r * n + c]);
      }
      if (zero) continue;
      const auto b_bar = solve(transposed, bar);
      for (std::size_t r = 0; r < n; ++r) {
        add(system.right_hand_side[r], b_bar[r]);
        for (std::size_t c = 0; c < n; ++c) add(system.matrix[r * n + c], -(b_bar[r] * x[k + c]));
      }
      continue;
    }
    if (structurally_zero(w)) continue;
    switch (i.operation) {
      case Operation::input:
        result[static_cast<std::size_t>(i.a)] = w;
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
        add(i.b, -(w * x[k] / at(i.b)));
        break;
      case Operation::square_root:
        add(i.a, w / (Recorded(2) * x[k]));
        break;
      case Operation::exponential:
        add(i.a, w * x[k]);
        break;
      case Operation::logarithm:
        add(i.a, w / at(i.a));
        break;
      case Operation::sine:
        add(i.a, w * x[k + 1]);
        break;
      case Operation::cosine:
        add(i.a, -(w * x[k - 1]));
        break;
      case Operation::power: {
        const Real& y = tape.constants[static_cast<std::size_t>(i.b)];
        add(i.a, w * (Recorded(y) * pow(at(i.a), y - Real(1))));
        break;
      }
      case Operation::select:
        add_within(guards[k].within(at(i.a), true), i.b, select(at(i.a), w, Recorded(0)));
        add_within(guards[k].within(at(i.a), false), i.c, select(at(i.a), Recorded(0), w));
        break;
      default:
        break;
    }
  }
  return result;
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
