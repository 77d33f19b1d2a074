// Random constants for the initial states of systems that have a parameter `seed`.
#pragma once

#include <cstdint>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

/// splitmix64 (steele-lea-flood2014), the same on every machine.
class RandomNumbers {
 public:
  explicit RandomNumbers(int seed) : state_(static_cast<std::uint64_t>(seed)) {}
  /// A fraction in -1 .. 1, exact in every precision.
  Real next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    x ^= x >> 31U;
    constexpr std::int64_t half = std::int64_t{1} << 30U;
    return Real::fraction(static_cast<std::int64_t>(x >> 33U) - half, half);
  }

 private:
  std::uint64_t state_;
};

}  // namespace pfaff
