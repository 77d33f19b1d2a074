// Pack: W doubles that are added and multiplied together, in the widest vector registers the build may use; a
// scalar that formulas can be evaluated with. Functions are those of the standard library, lane by lane.
//
// For code that does the same to several nodes at once. Registers of 16 bytes belong to every machine of this
// architecture; those of 32 and of 64 bytes are used where the build allows them. Results do not depend on
// it: every lane is computed by itself, and sums go from lane to lane. The lanes of a pack that a caller has
// no use for should hold copies of the last one that it has, never rubbish: arithmetic on rubbish can be very
// slow, and functions of copies cost nothing.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include <pfaff/core/numbers/special.hpp>

namespace pfaff {

namespace detail {
#ifdef __AVX512F__
inline constexpr int widest_register = 8;
#elif defined(__AVX__)
inline constexpr int widest_register = 4;
#else
inline constexpr int widest_register = 2;
#endif
template <int Doubles>
struct RegisterOf {
  // NOLINTNEXTLINE(modernize-use-using): an alias of a dependent size loses the attribute
  typedef double type __attribute__((vector_size(static_cast<unsigned>(Doubles) * sizeof(double))));
  // NOLINTNEXTLINE(modernize-use-using)
  typedef unsigned long long bits
      __attribute__((vector_size(static_cast<unsigned>(Doubles) * sizeof(double))));
};
template <>
struct RegisterOf<1> {
  using type = double;
  using bits = unsigned long long;
};

// The root of every number in a register, which the machine rounds correctly, as the standard library does.
inline double root_of(double x) { return std::sqrt(x); }
template <class Register>
Register root_of(const Register& x) {
#if defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
#ifdef __AVX512F__
  if constexpr (sizeof(Register) == 64)
    return __builtin_ia32_sqrtpd512_mask(x, x, -1, 4);  // all lanes, rounded as set
#endif
#ifdef __AVX__
  if constexpr (sizeof(Register) == 32) return __builtin_ia32_sqrtpd256(x);
#endif
  if constexpr (sizeof(Register) == 16) return __builtin_ia32_sqrtpd(x);
#else
  Register r;
  for (std::size_t k = 0; k < sizeof(Register) / sizeof(double); ++k) r[k] = std::sqrt(x[k]);
  return r;
#endif
}
}  // namespace detail

/// W doubles, W a power of two.
template <int W>
class Pack {
 public:
  static constexpr int register_width = W < detail::widest_register ? W : detail::widest_register;
  static constexpr std::size_t count = W / register_width;
  using Register = typename detail::RegisterOf<register_width>::type;

  Pack() = default;
  /// The same number in every lane.
  Pack(double x) {  // NOLINT(google-explicit-constructor)
    for (Register& r : registers_) r = broadcast(x);
  }

  explicit Pack(const Real& x) : Pack(x.value()) {}

  /// W numbers in a row, and the other way round.
  [[nodiscard]] static Pack load(const double* from) {
    Pack r;
    std::memcpy(&r.registers_, from, W * sizeof(double));
    return r;
  }
  void store(double* to) const { std::memcpy(to, &registers_, W * sizeof(double)); }

  /// One number in each lane, put together in registers, where set() may go through memory.
  Pack(double first, double second) requires(W == 2) : registers_{{Register{first, second}}} {}

  [[nodiscard]] double operator[](std::size_t lane) const {
    if constexpr (register_width == 1)
      return registers_[lane];
    else
      return registers_[lane / register_width][lane % register_width];
  }
  void set(std::size_t lane, double x) {
    if constexpr (register_width == 1)
      registers_[lane] = x;
    else
      registers_[lane / register_width][lane % register_width] = x;
  }
  /// The first and the second half of the lanes.
  [[nodiscard]] Pack<W / 2> lower() const requires(W > 1) { return half<0>(); }
  [[nodiscard]] Pack<W / 2> upper() const requires(W > 1) { return half<1>(); }

  /// The sum over all lanes, one after the other.
  [[nodiscard]] double sum() const {
    double total = (*this)[0];
    for (std::size_t lane = 1; lane < W; ++lane) total += (*this)[lane];
    return total;
  }

  friend Pack operator-(const Pack& a) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = -a.registers_[k];
    return r;
  }
  friend Pack operator+(const Pack& a, const Pack& b) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = a.registers_[k] + b.registers_[k];
    return r;
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = a.registers_[k] - b.registers_[k];
    return r;
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = a.registers_[k] * b.registers_[k];
    return r;
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = a.registers_[k] / b.registers_[k];
    return r;
  }
  /// In every lane `positive` where condition > 0, `otherwise` elsewhere.
  friend Pack select(const Pack& condition, const Pack& positive, const Pack& otherwise) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k)
      r.registers_[k] = condition.registers_[k] > 0 ? positive.registers_[k] : otherwise.registers_[k];
    return r;
  }

  /// f of the number in every lane, computed once for lanes in a row that hold the same number.
  template <class F>
  [[nodiscard]] Pack each(const F& f) const {
    Pack r;
    double x = (*this)[0], y = f(x);
    r.set(0, y);
    for (std::size_t lane = 1; lane < W; ++lane) {
      const double next = (*this)[lane];
      if (std::bit_cast<unsigned long long>(next) != std::bit_cast<unsigned long long>(x)) y = f(x = next);
      r.set(lane, y);
    }
    return r;
  }
  friend Pack sqrt(const Pack& a) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) r.registers_[k] = detail::root_of(a.registers_[k]);
    return r;
  }
  friend Pack abs(const Pack& a) {
    Pack r;
    for (std::size_t k = 0; k < count; ++k) {
      if constexpr (register_width == 1)
        r.registers_[k] = std::abs(a.registers_[k]);
      else  // without the bit of the sign
        r.registers_[k] = std::bit_cast<Register>(std::bit_cast<Bits>(a.registers_[k]) & (~0ULL >> 1));
    }
    return r;
  }
  friend Pack exp(const Pack& a) {
    return a.each([](double x) { return std::exp(x); });
  }
  friend Pack log(const Pack& a) {
    return a.each([](double x) { return std::log(x); });
  }
  friend Pack sin(const Pack& a) {
    return a.each([](double x) { return std::sin(x); });
  }
  friend Pack cos(const Pack& a) {
    return a.each([](double x) { return std::cos(x); });
  }
  friend Pack special(SpecialFunction which, const Pack& a, const Pack& /*slope*/) {
    return a.each([which](double x) { return special(which, x, 0.0); });
  }
  /// x^y for a constant exponent.
  friend Pack pow(const Pack& a, const Real& y) {
    if (is_small_half_integer(y)) return half_power(a, static_cast<int>(y.numerator()));
    return a.each([e = y.value()](double x) { return std::pow(x, e); });
  }

 private:
  template <int>
  friend class Pack;
  using Bits = typename detail::RegisterOf<register_width>::bits;

  // Half number H of the lanes: registers, or the half of one.
  template <std::size_t H>
  [[nodiscard]] Pack<W / 2> half() const {
    Pack<W / 2> r;
    if constexpr (count > 1) {
      for (std::size_t k = 0; k < count / 2; ++k) r.registers_[k] = registers_[H * count / 2 + k];
    } else if constexpr (W == 2) {
      r.registers_[0] = registers_[0][H];
    } else {
      const Register& x = registers_[0];
      if constexpr (W == 4)
        r.registers_[0] = __builtin_shufflevector(x, x, 2 * H, 2 * H + 1);
      else
        r.registers_[0] = __builtin_shufflevector(x, x, 4 * H, 4 * H + 1, 4 * H + 2, 4 * H + 3);
    }
    return r;
  }
  static Register broadcast(double x) {
    if constexpr (register_width == 1)
      return x;
    else
      return x - Register{};
  }
  std::array<Register, count> registers_{};
};

}  // namespace pfaff
