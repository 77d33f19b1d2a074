#include <pfaff/derive/derivation/scaled.hpp>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace pfaff {

namespace {

// Beyond this a factor stays in the tape, as a number that every scalar holds exactly.
constexpr int largest_power = 20;

// The number as a factor, where it is one: +-2^k with a small k.
std::optional<PowerOfTwo> factor_of(const Real& x) {
  if (!x.is_fraction() || x.numerator() == 0) return std::nullopt;
  const auto magnitude = static_cast<std::uint64_t>(x.numerator() < 0 ? -x.numerator() : x.numerator());
  const auto denominator = static_cast<std::uint64_t>(x.denominator());
  if (!std::has_single_bit(magnitude) || !std::has_single_bit(denominator)) return std::nullopt;
  const int power = std::countr_zero(magnitude) - std::countr_zero(denominator);
  if (std::abs(power) > largest_power) return std::nullopt;
  return PowerOfTwo{power, x.numerator() < 0};
}
bool negative(const Real& x) { return x < Real(0); }
bool same(const Recorded& a, const Recorded& b) {
  return !a.is_constant() && !b.is_constant() && a.slot() == b.slot();
}

}  // namespace

Real PowerOfTwo::value() const {
  const std::int64_t magnitude = std::int64_t{1} << std::abs(power);
  const std::int64_t sign = negative ? -1 : 1;
  return power < 0 ? Real::fraction(sign, magnitude) : Real::fraction(sign * magnitude, 1);
}

Recorded Scaled::whole() const {
  if (scale_.is_one()) return core_;
  return scale_.power == 0 ? -core_ : Recorded(scale_.value()) * core_;
}

Scaled Scaled::of(PowerOfTwo scale, const Recorded& core) {
  if (core.is_constant()) return Scaled(Recorded(scale.value() * core.constant()));
  return std::abs(scale.power) <= largest_power ? Scaled(scale, core)
                                                : Scaled(Recorded(scale.value()) * core);
}

Scaled operator-(const Scaled& a) {
  Scaled opposite = Scaled::of(-a.scale_, a.core_);
  opposite.inverse_of_ = a.inverse_of_;
  return opposite;
}

Scaled operator*(const Scaled& a, const Scaled& b) {
  if (a.is_constant() && b.is_constant()) return Scaled(a.core_ * b.core_);
  if (b.is_constant()) return b * a;
  if (a.is_constant()) {
    const Real& c = a.core_.constant();
    if (c.is(0)) return Scaled(0);
    if (const auto factor = factor_of(c)) return Scaled::of(*factor * b.scale_, b.core_);
    // The sign of a constant goes with the factors.
    return negative(c) ? Scaled::of(-b.scale_, Recorded(-c) * b.core_)
                       : Scaled::of(b.scale_, Recorded(c) * b.core_);
  }
  const bool inverse = a.inverse_of_ == b.core_.slot() || b.inverse_of_ == a.core_.slot();
  return Scaled::of(a.scale_ * b.scale_, inverse ? Recorded(1) : a.core_ * b.core_);
}

Scaled operator/(const Scaled& a, const Scaled& b) {
  if (a.is_constant() && b.is_constant()) return Scaled(a.core_ / b.core_);
  if (b.is_constant()) {
    const Real& c = b.core_.constant();
    if (const auto factor = factor_of(c)) return Scaled::of(a.scale_ / *factor, a.core_);
    return negative(c) ? Scaled::of(-a.scale_, a.core_ / Recorded(-c))
                       : Scaled::of(a.scale_, a.core_ / b.core_);
  }
  if (a.is_constant()) {
    const Real& c = a.core_.constant();
    if (c.is(0)) return Scaled(0);
    if (const auto factor = factor_of(c)) {
      Scaled inverse = Scaled::of(*factor / b.scale_, Recorded(1) / b.core_);
      inverse.inverse_of_ = b.core_.slot();
      return inverse;
    }
    return negative(c) ? Scaled::of(PowerOfTwo{0, true} / b.scale_, Recorded(-c) / b.core_)
                       : Scaled::of(PowerOfTwo{} / b.scale_, a.core_ / b.core_);
  }
  return Scaled::of(a.scale_ / b.scale_, same(a.core_, b.core_) ? Recorded(1) : a.core_ / b.core_);
}

Scaled operator+(const Scaled& a, const Scaled& b) {
  if (a.is_constant() && b.is_constant()) return Scaled(a.core_ + b.core_);
  if (a.core_.is(0)) return b;
  if (b.core_.is(0)) return a;
  if (same(a.core_, b.core_)) return Scaled(a.scale_.value() + b.scale_.value()) * Scaled(a.core_);
  // The operand of the smaller slot leads, so that a + b and b + a are one node; constants come last.
  if (a.is_constant() || (!b.is_constant() && b.core_.slot() < a.core_.slot())) return b + a;
  if (b.is_constant()) {
    const Real c = b.core_.constant() / a.scale_.value();
    return Scaled::of(a.scale_, negative(c) ? a.core_ - Recorded(-c) : a.core_ + Recorded(c));
  }
  const PowerOfTwo ratio = b.scale_ / a.scale_;
  const Recorded other = Scaled::of({ratio.power, false}, b.core_).whole();
  return Scaled::of(a.scale_, ratio.negative ? a.core_ - other : a.core_ + other);
}
Scaled operator-(const Scaled& a, const Scaled& b) { return a + (-b); }

Scaled sqrt(const Scaled& a) { return Scaled(sqrt(a.whole())); }
Scaled exp(const Scaled& a) { return Scaled(exp(a.whole())); }
Scaled log(const Scaled& a) { return Scaled(log(a.whole())); }
Scaled sin(const Scaled& a) {
  return a.scale_.negative ? -Scaled(sin((-a).whole())) : Scaled(sin(a.whole()));
}
Scaled cos(const Scaled& a) { return Scaled(cos((a.scale_.negative ? -a : a).whole())); }
Scaled pow(const Scaled& a, const Real& y) { return Scaled(pow(a.whole(), y)); }
Scaled special(SpecialFunction which, const Scaled& a, const Scaled& slope) {
  return Scaled(special(which, a.whole(), slope.whole()));
}
Scaled select(const Scaled& condition, const Scaled& positive, const Scaled& otherwise) {
  // A positive factor of the condition decides nothing.
  const Recorded sign = condition.is_constant()     ? condition.core_
                        : condition.scale_.negative ? -condition.core_
                                                    : condition.core_;
  return Scaled(select(sign, positive.whole(), otherwise.whole()));
}

void TapeSolver<Scaled>::operator()(const LinearSystem& system, std::vector<Scaled>& slots,
                                    std::size_t first) const {
  std::vector<Recorded> matrix, right;
  for (const int slot : system.matrix) matrix.push_back(slots[static_cast<std::size_t>(slot)].whole());
  for (const int slot : system.right_hand_side)
    right.push_back(slots[static_cast<std::size_t>(slot)].whole());
  const std::vector<Recorded> x = solve(matrix, right);
  for (std::size_t i = 0; i < size_; ++i) slots[first + i] = Scaled(x[i]);
}

Tape simplified(const Tape& tape) {
  Recorder recorder(tape.inputs);
  std::vector<Scaled> z, results(tape.outputs.size());
  for (const Recorded& x : recorder.inputs()) z.emplace_back(x);
  Replay<Scaled> replay({std::shared_ptr<const Tape>(), &tape});
  replay(Scaled(recorder.time()), z.data(), results.data());
  std::vector<Recorded> outputs;
  for (const Scaled& x : results) outputs.push_back(x.whole());
  return recorder.finish(outputs);
}

}  // namespace pfaff
