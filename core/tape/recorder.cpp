#include <pfaff/core/tape/recorder.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <pfaff/core/tape/operands.hpp>

namespace pfaff {

namespace {
Recorder* recorder_of(const Recorded& a, const Recorded& b) {
  return a.recorder() != nullptr ? a.recorder() : b.recorder();
}
Recorded binary(Operation operation, const Recorded& a, const Recorded& b) {
  Recorder* r = recorder_of(a, b);
  int left = r->slot_of(a), right = r->slot_of(b);
  // One order for commutative operations, so that a b and b a are shared.
  if ((operation == Operation::add || operation == Operation::multiply) && right < left)
    std::swap(left, right);
  return r->append({operation, left, right, 0});
}
Recorded unary(Operation operation, const Recorded& a) {
  return a.recorder()->append({operation, a.slot(), 0, 0});
}

// What an operation makes of two small integers, where that is an int again.
template <class Combine>
std::optional<Recorded> of_integers(const Recorded& a, const Recorded& b, const Combine& combine) {
  const std::optional<int> left = a.small_integer(), right = b.small_integer();
  if (!left || !right) return std::nullopt;
  const std::int64_t value = combine(std::int64_t{*left}, std::int64_t{*right});
  if (std::abs(value) > std::numeric_limits<int>::max()) return std::nullopt;
  return Recorded(static_cast<int>(value));
}
}  // namespace

Recorded operator-(const Recorded& a) {
  if (a.is_constant()) return Recorded(-a.constant());
  return unary(Operation::negate, a);
}
Recorded operator+(const Recorded& a, const Recorded& b) {
  if (a.is(0)) return b;
  if (b.is(0)) return a;
  if (a.is_constant() && b.is_constant()) return Recorded(a.constant() + b.constant());
  // Twice c x is (2 c) x with the same bits, since doubling rounds nothing: so are p / 2 + p / 2, which is
  // the derivative of p p / 2, and p.
  if (a.recorder() == b.recorder() && a.slot() == b.slot())
    if (const auto multiple = a.recorder()->multiple_at(a.slot()))
      return multiple->second * Recorded(multiple->first + multiple->first);
  return binary(Operation::add, a, b);
}
Recorded operator-(const Recorded& a, const Recorded& b) {
  if (b.is(0)) return a;
  if (a.is(0)) return -b;
  if (a.is_constant() && b.is_constant()) return Recorded(a.constant() - b.constant());
  if (a.recorder() == b.recorder() && a.slot() == b.slot()) return Recorded(0);
  return binary(Operation::subtract, a, b);
}
Recorded operator*(const Recorded& a, const Recorded& b) {
  if (a.is_constant() && b.is_constant()) {
    if (const auto whole = of_integers(a, b, [](auto x, auto y) { return x * y; })) return *whole;
    return Recorded(a.constant() * b.constant());
  }
  if (a.is(0) || b.is(0)) return Recorded(0);
  if (a.is(1)) return b;
  if (b.is(1)) return a;
  if (a.is(-1)) return -b;
  if (b.is(-1)) return -a;
  return binary(Operation::multiply, a, b);
}
Recorded operator/(const Recorded& a, const Recorded& b) {
  if (b.is_constant()) {
    if (a.is_constant()) return Recorded(a.constant() / b.constant());
    // Division by a power of two is a multiplication without a rounding.
    for (const int power : {1, 2, 4, 8, 16})
      if (b.is(power)) return a * Recorded(Real::fraction(1, power));
  }
  if (a.is(0)) return Recorded(0);
  return binary(Operation::divide, a, b);
}

Recorded sqrt(const Recorded& x) {
  return x.is_constant() ? Recorded(sqrt(x.constant())) : unary(Operation::square_root, x);
}
Recorded exp(const Recorded& x) {
  return x.is_constant() ? Recorded(exp(x.constant())) : unary(Operation::exponential, x);
}
Recorded log(const Recorded& x) {
  return x.is_constant() ? Recorded(log(x.constant())) : unary(Operation::logarithm, x);
}
Recorded sin(const Recorded& x) {
  return x.is_constant() ? Recorded(sin(x.constant())) : x.recorder()->append_sine(x.slot(), false);
}
Recorded cos(const Recorded& x) {
  return x.is_constant() ? Recorded(cos(x.constant())) : x.recorder()->append_sine(x.slot(), true);
}

Recorded pow(const Recorded& x, const Real& y) {
  if (x.is_constant()) return Recorded(pow(x.constant(), y));
  if (y == Real::fraction(1, 2)) return sqrt(x);
  const bool small = y.is_fraction() && y.denominator() == 1 && std::abs(y.numerator()) <= 32;
  // Powers that are no products stay powers, also those of half an integer: the derivative of x^2 sqrt x, as
  // that of a product with a root, is 0/0 at 0, where that of x^(5/2) is 0.
  if (!small) return x.recorder()->append({Operation::power, x.slot(), x.recorder()->constant_index(y), 0});
  auto whole = std::abs(y.numerator());
  Recorded result(1);
  for (Recorded square = x; whole > 0; whole /= 2, square = whole > 0 ? square * square : square)
    if (whole % 2 == 1) result = result * square;
  return y.numerator() < 0 ? Recorded(1) / result : result;
}
Recorded pow(const Recorded& x, const Recorded& y) {
  return y.is_constant() ? pow(x, y.constant()) : exp(y * log(x));
}

Recorded special(SpecialFunction which, const Recorded& x, const Recorded& slope) {
  if (x.is_constant())
    return x.is(0) ? Recorded(0) : Recorded(Real(special(which, x.constant().quad(), Quad(0))));
  Recorder* r = x.recorder();
  return r->append({Operation::special, x.slot(), r->slot_of(slope), static_cast<int>(which)});
}

Recorded select(const Recorded& condition, const Recorded& positive, const Recorded& otherwise) {
  if (condition.is_constant()) return condition.constant() > Real(0) ? positive : otherwise;
  Recorder* r = condition.recorder();
  return r->append({Operation::select, condition.slot(), r->slot_of(positive), r->slot_of(otherwise)});
}

namespace {
// The solution of a system of constants by elimination: fractions stay fractions. NaN where the matrix is
// singular.
std::vector<Recorded> solve_constants(std::span<const Recorded> matrix,
                                      std::span<const Recorded> right_hand_side) {
  const std::size_t n = right_hand_side.size();
  std::vector<Real> a, b;
  for (const Recorded& e : matrix) a.push_back(e.constant());
  for (const Recorded& e : right_hand_side) b.push_back(e.constant());
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(a[i * n + k].quad()) > abs(a[pivot * n + k].quad())) pivot = i;
    if (a[pivot * n + k].is(0))
      return std::vector<Recorded>(n, Recorded(Real(std::numeric_limits<Quad>::quiet_NaN())));
    for (std::size_t j = 0; j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Real factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
      b[i] = b[i] - factor * b[k];
    }
  }
  std::vector<Recorded> x(n);
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] = b[i] - a[i * n + j] * b[j];
    b[i] = b[i] / a[i * n + i];
    x[i] = Recorded(b[i]);
  }
  return x;
}
}  // namespace

std::vector<Recorded> solve(std::span<const Recorded> matrix, std::span<const Recorded> right_hand_side) {
  const std::size_t n = right_hand_side.size();
  std::vector<Recorded> x(n);
  std::vector<std::size_t> column_of(n, n);
  std::vector<char> used(n, 0);
  bool monomial = true;
  for (std::size_t i = 0; i < n && monomial; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (!structurally_zero(matrix[i * n + j])) {
        monomial = monomial && column_of[i] == n && used[j] == 0;
        column_of[i] = j;
        used[j] = 1;
      }
  monomial = monomial && std::find(column_of.begin(), column_of.end(), n) == column_of.end();
  if (monomial) {
    for (std::size_t i = 0; i < n; ++i) x[column_of[i]] = right_hand_side[i] / matrix[i * n + column_of[i]];
    return x;
  }
  Recorder* recorder = nullptr;
  for (const Recorded& e : matrix) recorder = recorder != nullptr ? recorder : e.recorder();
  for (const Recorded& e : right_hand_side) recorder = recorder != nullptr ? recorder : e.recorder();
  if (recorder == nullptr) return solve_constants(matrix, right_hand_side);
  LinearSystem system{static_cast<int>(n), {}, {}};
  for (const Recorded& e : matrix) system.matrix.push_back(recorder->slot_of(e));
  for (const Recorded& e : right_hand_side) system.right_hand_side.push_back(recorder->slot_of(e));
  return recorder->append_solve(std::move(system));
}

namespace {
// True where the formula of a slot has a value for every time and state: it is made of operations that have
// one for every argument.
bool defined_everywhere(const std::vector<Instruction>& code, int slot) {
  std::vector<char> seen(static_cast<std::size_t>(slot) + 1, 0);
  std::vector<int> open{slot};
  while (!open.empty()) {
    const auto k = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (std::exchange(seen[k], 1) != 0) continue;
    const Instruction& i = code[k];
    switch (i.operation) {
      case Operation::divide:
        if (code[static_cast<std::size_t>(i.b)].operation != Operation::constant) return false;
        open.push_back(i.a);
        break;
      case Operation::square_root:
      case Operation::logarithm:
      case Operation::power:
      case Operation::solve:
      case Operation::solve_next:
        return false;
      default:
        operands(i, {}, [&](int operand) { open.push_back(operand); });
    }
  }
  return true;
}
}  // namespace

Recorded nothing_of(const Recorded& x) {
  return x.is_constant() ? Recorded(0) : x.recorder()->append_nothing_of(x.slot());
}

Recorded Recorder::append_nothing_of(int slot) {
  if (defined_everywhere(code_, slot)) return Recorded(0);
  return append({Operation::multiply, slot_of(Recorded(0)), slot, 0});
}

Recorder::Recorder(int inputs) : inputs_(inputs) {
  // Room for what the formulas of many variables record, some tens of instructions for each. What is not used
  // of it costs nothing, while moving the code of a long chain to larger and larger memory takes a third of
  // the time of its recording.
  constexpr std::size_t instructions_for_each = 32;
  code_.reserve(instructions_for_each * static_cast<std::size_t>(inputs));
  time_slot_ = append({Operation::time, 0, 0, 0}).slot();
  for (int k = 0; k < inputs; ++k) append({Operation::input, k, 0, 0});
}

std::vector<Recorded> Recorder::inputs() {
  std::vector<Recorded> z;
  z.reserve(static_cast<std::size_t>(inputs_));
  for (int k = 0; k < inputs_; ++k) z.emplace_back(this, time_slot_ + 1 + k);
  return z;
}

std::size_t Recorder::ConstantHash::operator()(const Real& x) const {
  // Equal constants have equal doubles, of zeros up to the sign.
  return std::hash<double>()(x.value() == 0 ? 0.0 : x.value());
}
bool Recorder::SameConstant::operator()(const Real& a, const Real& b) const {
  return a == b && a.is_fraction() == b.is_fraction();
}

int Recorder::constant_index(const Real& value) {
  // A NaN equals nothing, itself included, and so is a new constant each time.
  const auto [found, added] = constant_places_.try_emplace(value, static_cast<int>(constants_.size()));
  if (added) constants_.push_back(value);
  return found->second;
}

std::optional<std::pair<Real, Recorded>> Recorder::multiple_at(int slot) {
  const Instruction& i = code_[static_cast<std::size_t>(slot)];
  if (i.operation != Operation::multiply) return std::nullopt;
  for (const auto& [one, other] : {std::pair(i.a, i.b), std::pair(i.b, i.a)})
    if (const Instruction& factor = code_[static_cast<std::size_t>(one)];
        factor.operation == Operation::constant) {
      const Real& c = constants_[static_cast<std::size_t>(factor.a)];
      if (!c.is(0)) return std::pair(c, Recorded(this, other));
    }
  return std::nullopt;
}

int Recorder::slot_of(const Recorded& x) {
  if (!x.is_constant()) return x.slot();
  return append({Operation::constant, constant_index(x.constant()), 0, 0}).slot();
}

Recorded Recorder::append(const Instruction& instruction) {
  if (const int known = known_.find(instruction, code_); known != InstructionIndex::none)
    return {this, known};
  const int added = static_cast<int>(code_.size());
  code_.push_back(instruction);
  known_.add(added, code_);
  return {this, added};
}

Recorded Recorder::append_sine(int argument, bool cosine) {
  int slot = known_.find({Operation::sine, argument, 0, 0}, code_);
  if (slot == InstructionIndex::none) {
    slot = append({Operation::sine, argument, 0, 0}).slot();
    append({Operation::cosine, argument, 0, 0});
  }
  return {this, slot + (cosine ? 1 : 0)};
}

std::vector<Recorded> Recorder::append_solve(LinearSystem system) {
  const int size = system.size;
  solves_.push_back(std::move(system));
  const int first = static_cast<int>(code_.size());
  const int index = static_cast<int>(solves_.size()) - 1;
  std::vector<Recorded> x;
  for (int k = 0; k < size; ++k) {
    code_.push_back({k == 0 ? Operation::solve : Operation::solve_next, index, k, 0});
    x.emplace_back(this, first + k);
  }
  return x;
}

}  // namespace pfaff
