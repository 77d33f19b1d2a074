// Scaled: a scalar that rewrites a tape by being replayed on it. A number is a sign and a power of two times
// a recorded core, s x. The factors are taken out of products, quotients and sums, so that expressions which
// differ in them are one node: the 1/2 of a kinetic energy meets the 2 of the derivative of a square and is
// gone, and a negation becomes a subtraction.
//
//   (s x)(u y) = (s u) (x y),   (s x)/(u y) = (s/u) (x/y),   s x + u y = s (x + (u/s) y)
//   x + x = 2 x,   x - x = 0,   x/x = 1,   x (1/x) = 1
//
// All factors are exact in every scalar, so that rounding does not change.
#pragma once

#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// +-2^power.
struct PowerOfTwo {
  int power = 0;
  bool negative = false;

  [[nodiscard]] bool is_one() const { return power == 0 && !negative; }
  /// The number itself; |power| <= 62.
  [[nodiscard]] Real value() const;
  friend PowerOfTwo operator-(PowerOfTwo a) { return {a.power, !a.negative}; }
  friend PowerOfTwo operator*(PowerOfTwo a, PowerOfTwo b) {
    return {a.power + b.power, a.negative != b.negative};
  }
  friend PowerOfTwo operator/(PowerOfTwo a, PowerOfTwo b) {
    return {a.power - b.power, a.negative != b.negative};
  }
};

class Scaled {
 public:
  Scaled() = default;
  Scaled(int value) : Scaled(Recorded(value)) {}  // NOLINT(google-explicit-constructor)
  explicit Scaled(const Real& value) : Scaled(Recorded(value)) {}
  explicit Scaled(const Recorded& core) : core_(core) {}

  /// The number as one node.
  [[nodiscard]] Recorded whole() const;

  friend Scaled operator-(const Scaled& a);
  friend Scaled operator+(const Scaled& a, const Scaled& b);
  friend Scaled operator-(const Scaled& a, const Scaled& b);
  friend Scaled operator*(const Scaled& a, const Scaled& b);
  friend Scaled operator/(const Scaled& a, const Scaled& b);
  friend Scaled sqrt(const Scaled& a);
  friend Scaled exp(const Scaled& a);
  friend Scaled log(const Scaled& a);
  friend Scaled sin(const Scaled& a);
  friend Scaled cos(const Scaled& a);
  friend Scaled pow(const Scaled& a, const Real& y);
  friend Scaled special(SpecialFunction which, const Scaled& a, const Scaled& slope);
  friend Scaled select(const Scaled& condition, const Scaled& positive, const Scaled& otherwise);

 private:
  Scaled(PowerOfTwo scale, const Recorded& core) : scale_(scale), core_(core) {}
  // The factors of a constant are a part of it; a constant has the scale 1.
  static Scaled of(PowerOfTwo scale, const Recorded& core);
  [[nodiscard]] bool is_constant() const { return core_.is_constant(); }

  PowerOfTwo scale_;
  Recorded core_;
  int inverse_of_ = -1;  // the slot y where the core is 1/y
};
inline bool structurally_zero(const Scaled& x) { return structurally_zero(x.whole()); }

/// Dense systems stay systems.
template <>
class TapeSolver<Scaled> {
 public:
  explicit TapeSolver(int size) : size_(static_cast<std::size_t>(size)) {}
  void operator()(const LinearSystem& system, std::vector<Scaled>& slots, std::size_t first) const;

 private:
  std::size_t size_;
};

/// The tape rewritten in this way, with equal expressions shared and without what no output needs.
Tape simplified(const Tape& tape);

}  // namespace pfaff
