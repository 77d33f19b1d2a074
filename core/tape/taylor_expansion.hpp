// TaylorExpansion: the solution of z' = X(z, t) through a point as a power series in the time since then.
//
// X is a tape, evaluated in truncated series (series.hpp). Coefficient l of X needs the coefficients of z up
// to l only, and gives the next one, z_{l+1} = X_l / (l + 1), so that one pass makes them all, without any
// derivative being written down.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/tape/kinks.hpp>
#include <pfaff/core/tape/series.hpp>

namespace pfaff {

template <class T>
class TaylorExpansion {
 public:
  /// Of degree `order` >= 1, for the field on a tape of n inputs and n outputs.
  TaylorExpansion(std::shared_ptr<const Tape> field, int order)
      : n_(static_cast<std::size_t>(field->inputs)),
        order_(static_cast<std::size_t>(order)),
        kinks_(*field),
        series_(std::move(field), order, 1),
        coefficients_(n_ * (order_ + 1)) {}

  /// Expands the solution that is at z, n numbers, at time t.
  void expand(const T& t, const T* z) {
    const T one(1);
    series_.set_time(&t, &one);
    std::copy(z, z + n_, coefficients_.begin());
    for (std::size_t l = 0; l < order_; ++l) {
      series_.set_input(l, coefficients_.data() + l * n_);
      series_.advance(l);
      const T next(static_cast<int>(l + 1));
      for (std::size_t k = 0; k < n_; ++k) coefficients_[(l + 1) * n_ + k] = *series_.output(k, l) / next;
    }
  }

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t order() const { return order_; }
  /// coefficients()[degree * n + k]: that of s^degree in component k, s the time since the expansion.
  [[nodiscard]] const std::vector<T>& coefficients() const { return coefficients_; }
  /// The largest coefficient of a degree, in absolute value.
  [[nodiscard]] T largest(std::size_t degree) const {
    T most(0);
    for (std::size_t k = 0; k < n_; ++k) most = std::max(most, abs(coefficients_[degree * n_ + k]));
    return most;
  }
  /// The first kink of the field up to the time h, behind which the series is not that of the solution.
  [[nodiscard]] std::optional<Kink<Value<T>>> first_kink(const Value<T>& h) {
    if (kinks_.none()) return {};
    return kinks_.first(series_, h);
  }
  /// The time s about which a kink lies, with the derivatives of the time of the kink.
  [[nodiscard]] T time_of_kink(const Kink<Value<T>>& kink, const Value<T>& s) const {
    return kinks_.time(series_, kink, s);
  }
  /// Component k of z(s) - z(0).
  [[nodiscard]] T increment(const T& s, std::size_t k) const {
    T sum = coefficients_[order_ * n_ + k];
    for (std::size_t l = order_; --l > 0;) sum = sum * s + coefficients_[l * n_ + k];
    return sum * s;
  }

 private:
  std::size_t n_, order_;
  Kinks<T> kinks_;
  SeriesReplay<T> series_;
  std::vector<T> coefficients_;
};

}  // namespace pfaff
