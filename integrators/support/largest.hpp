// Largest: the largest size in a vector, each derivative part of a dual by itself.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The largest absolute value among those given so far; NaN once one of them was not finite.
template <class T>
class Largest {
 public:
  void add(const T& x) {
    const T size = abs(x);
    largest_ = std::max(largest_, size);
    sum_ = sum_ + size;
  }
  [[nodiscard]] T get() const { return isfinite(sum_) ? largest_ : std::numeric_limits<T>::quiet_NaN(); }

 private:
  T largest_{0}, sum_{0};
};
/// For doubles the bits are compared as integers. Without the sign they are in the order of the numbers, with
/// infinities and NaN above all, and comparisons of integers wait for one another less than those of
/// floating-point numbers.
template <>
class Largest<double> {
 public:
  void add(double x) {
    constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    largest_ = std::max(largest_, std::bit_cast<std::uint64_t>(x) & ~sign);
  }
  [[nodiscard]] double get() const { return std::bit_cast<double>(largest_); }

 private:
  std::uint64_t largest_ = 0;
};
template <class T, int N>
class Largest<Dual<T, N>> {
 public:
  void add(const Dual<T, N>& x) {
    value_.add(x.value);
    for (std::size_t k = 0; k < N; ++k) derivative_[k].add(x.derivative[k]);
  }
  [[nodiscard]] Dual<T, N> get() const {
    Dual<T, N> result(value_.get());
    for (std::size_t k = 0; k < N; ++k) result.derivative[k] = derivative_[k].get();
    return result;
  }

 private:
  Largest<T> value_;
  std::array<Largest<T>, static_cast<std::size_t>(N)> derivative_;
};

}  // namespace pfaff
