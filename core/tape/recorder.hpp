// The recording scalar and the recorder that turns a templated formula into a Tape.
//
// Recording folds constants exactly (fractions stay fractions), drops additions of zero and multiplications
// by zero and one, doubles factors instead of sums, shares common subexpressions, and keeps sine and cosine
// of one argument together.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/special.hpp>
#include <pfaff/core/tape/instruction_index.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

class Recorder;

/// A number that records what is done with it. Plain constants belong to no recorder and fold immediately.
///
/// Formulas of long chains hold hundreds of thousands of these at once. A number is therefore two words: a
/// slot and its recorder, or a small integer, or a constant of another kind that stands elsewhere, shared by
/// the copies.
class Recorded {
 public:
  Recorded() = default;
  Recorded(int value) : number_(value) {}  // NOLINT(google-explicit-constructor)
  explicit Recorded(const Real& value);
  /// Refused, because a floating-point number would be cut to an int. The constants of a formula are ints and
  /// Reals.
  template <std::floating_point F>
  Recorded(F value) = delete;  // expected a Real: a member of that type, or a literal such as 0.3_r
  Recorded(Recorder* recorder, int slot) : kind_(Kind::slot), number_(slot), target_(recorder) {}

  Recorded(const Recorded& o) : kind_(o.kind_), number_(o.number_), target_(o.target_) {
    if (kind_ == Kind::shared) share();
  }
  Recorded(Recorded&& o) noexcept { swap(o); }
  Recorded& operator=(const Recorded& o) {
    Recorded copy(o);
    swap(copy);
    return *this;
  }
  Recorded& operator=(Recorded&& o) noexcept {
    swap(o);
    return *this;
  }
  ~Recorded() {
    if (kind_ == Kind::shared) release();
  }

  /// A zero that tells that nobody has assigned to it.
  static Recorded unwritten() {
    Recorded zero;
    zero.kind_ = Kind::unwritten;
    return zero;
  }
  [[nodiscard]] bool is_unwritten() const { return kind_ == Kind::unwritten; }

  [[nodiscard]] bool is_constant() const { return kind_ != Kind::slot; }
  /// The value of a constant.
  [[nodiscard]] Real constant() const { return kind_ == Kind::shared ? shared_constant() : Real(number_); }
  /// Null for a constant.
  [[nodiscard]] Recorder* recorder() const {
    return kind_ == Kind::slot ? static_cast<Recorder*>(target_) : nullptr;
  }
  /// Of a number that is no constant.
  [[nodiscard]] int slot() const { return kind_ == Kind::slot ? number_ : -1; }
  /// The value where it is an int and is known as one, which saves exact arithmetic.
  [[nodiscard]] std::optional<int> small_integer() const {
    return kind_ == Kind::integer || kind_ == Kind::unwritten ? std::optional<int>(number_) : std::nullopt;
  }
  [[nodiscard]] bool is(int value) const {
    if (kind_ == Kind::slot) return false;
    return kind_ == Kind::shared ? shared_constant().is(value) : number_ == value;
  }

  Recorded& operator+=(const Recorded& o) { return *this = *this + o; }
  Recorded& operator-=(const Recorded& o) { return *this = *this - o; }
  Recorded& operator*=(const Recorded& o) { return *this = *this * o; }
  Recorded& operator/=(const Recorded& o) { return *this = *this / o; }

  friend Recorded operator-(const Recorded& a);
  friend Recorded operator+(const Recorded& a, const Recorded& b);
  friend Recorded operator-(const Recorded& a, const Recorded& b);
  friend Recorded operator*(const Recorded& a, const Recorded& b);
  friend Recorded operator/(const Recorded& a, const Recorded& b);

 private:
  enum class Kind : std::uint8_t { integer, unwritten, shared, slot };
  struct SharedConstant;

  void share() const noexcept;
  void release() const noexcept;
  [[nodiscard]] const Real& shared_constant() const;
  void swap(Recorded& o) noexcept {
    std::swap(kind_, o.kind_);
    std::swap(number_, o.number_);
    std::swap(target_, o.target_);
  }

  Kind kind_ = Kind::integer;
  int number_ = 0;          // the integer or the slot
  void* target_ = nullptr;  // the recorder or the shared constant
};

/// One of two operands is recorded.
template <class A, class B>
concept ARecordedOperand = std::same_as<A, Recorded> || std::same_as<B, Recorded>;
/// The other one is a number that is neither an int nor a Real.
template <class A, class B>
concept AFloatingOperand = ARecordedOperand<A, B> &&(std::floating_point<A> || std::floating_point<B>);

// Comparisons, of values that are not there yet when a formula is recorded, and constants in doubles are
// refused in one sentence. (Deleted operators would list every other one.)
namespace detail {
template <class A, class B>
void refuse_comparison() {
  static_assert(!ARecordedOperand<A, B>,
                "a formula compares no values, which are not known when it is recorded: expected select(x - "
                "y, a, b), which is a where x > y and b elsewhere");
}
template <class A, class B>
Recorded refuse_floating() {
  static_assert(!AFloatingOperand<A, B>,
                "the constants of a formula are Reals and ints, exact in every precision: expected a member "
                "of the type Real, or a literal such as 0.3_r, and not a double");
  return {};
}
}  // namespace detail
template <class A, class B>
requires ARecordedOperand<A, B>
bool operator==(const A& /*a*/, const B& /*b*/) {
  detail::refuse_comparison<A, B>();
  return false;
}
template <class A, class B>
requires ARecordedOperand<A, B> std::partial_ordering operator<=>(const A& /*a*/, const B& /*b*/) {
  detail::refuse_comparison<A, B>();
  return std::partial_ordering::unordered;
}
template <class A, class B>
requires AFloatingOperand<A, B> Recorded operator+(const A& /*a*/, const B& /*b*/) {
  return detail::refuse_floating<A, B>();
}
template <class A, class B>
requires AFloatingOperand<A, B> Recorded operator-(const A& /*a*/, const B& /*b*/) {
  return detail::refuse_floating<A, B>();
}
template <class A, class B>
requires AFloatingOperand<A, B> Recorded operator*(const A& /*a*/, const B& /*b*/) {
  return detail::refuse_floating<A, B>();
}
template <class A, class B>
requires AFloatingOperand<A, B> Recorded operator/(const A& /*a*/, const B& /*b*/) {
  return detail::refuse_floating<A, B>();
}

Recorded sqrt(const Recorded& x);
Recorded exp(const Recorded& x);
Recorded log(const Recorded& x);
Recorded sin(const Recorded& x);
Recorded cos(const Recorded& x);
/// x^y: small integer powers become products, the power 1/2 a square root.
Recorded pow(const Recorded& x, const Real& y);
Recorded pow(const Recorded& x, const Recorded& y);
Recorded special(SpecialFunction which, const Recorded& x, const Recorded& slope);
Recorded select(const Recorded& condition, const Recorded& positive, const Recorded& otherwise);
/// That of core/numbers/special.hpp is for numbers without comparisons, and these have some, which refuse.
inline Recorded abs(const Recorded& x) { return select(x, x, -x); }
inline bool structurally_zero(const Recorded& x) { return x.is(0); }
/// 0, with the domain of x: where x has no value the product 0 x is recorded, and so has none either. A
/// product with a zero is a plain 0, as sparse matrices and their derivatives are made of such products; who
/// takes the words of an author, who may mean a domain by them, asks for this one.
Recorded nothing_of(const Recorded& x);

/// Solves the n x n system `matrix` (row-major) x = `right_hand_side`; a matrix with one entry in every row
/// and column becomes divisions, everything else one pivoted solve when the tape is replayed.
std::vector<Recorded> solve(std::span<const Recorded> matrix, std::span<const Recorded> right_hand_side);

/// Collects instructions; one recorder per tape.
class Recorder {
 public:
  explicit Recorder(int inputs);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  [[nodiscard]] Recorded time() { return {this, time_slot_}; }
  [[nodiscard]] std::vector<Recorded> inputs();

  /// The slot that holds x, recording a constant if need be.
  int slot_of(const Recorded& x);
  /// The slot of an instruction, shared with an equal earlier one.
  Recorded append(const Instruction& instruction);
  Recorded append_sine(int argument, bool cosine);
  Recorded append_nothing_of(int slot);
  std::vector<Recorded> append_solve(LinearSystem system);
  /// c and x where a slot is a product c x with a constant other than zero.
  std::optional<std::pair<Real, Recorded>> multiple_at(int slot);
  int constant_index(const Real& value);

  /// Removes what no output needs, orders by dependence and returns the tape.
  Tape finish(std::span<const Recorded> outputs);

 private:
  struct ConstantHash {
    std::size_t operator()(const Real& x) const;
  };
  struct SameConstant {
    bool operator()(const Real& a, const Real& b) const;
  };

  int inputs_;
  int time_slot_ = 0;
  std::vector<Instruction> code_;
  std::vector<Real> constants_;
  std::unordered_map<Real, int, ConstantHash, SameConstant> constant_places_;
  std::vector<LinearSystem> solves_;
  InstructionIndex known_;
};

/// Records formula(t, z, outputs) with `inputs` state variables and `outputs` results.
template <class Formula>
Tape record(int inputs, int outputs, Formula&& formula) {
  Recorder recorder(inputs);
  const std::vector<Recorded> z = recorder.inputs();
  std::vector<Recorded> results(static_cast<std::size_t>(outputs));
  formula(recorder.time(), In<Recorded>(z), Out<Recorded>(results));
  return recorder.finish(results);
}

}  // namespace pfaff
