// A metric at a point: g of vectors, its inverse of covectors, and the maps between the two kinds (the
// musical morphisms of pitanga-rodrigues 2.1).
#pragma once

#include <pfaff/brackets/almost_product/independence.hpp>
#include <pfaff/brackets/almost_product/vectors_and_covectors.hpp>

namespace pfaff {

/// A symmetric regular g, of any signature.
template <class T>
class Metric {
 public:
  /// g_ij. InputError where it is not symmetric to round-off, or degenerate (which rows depend on which).
  explicit Metric(const Matrix<T>& g) : flat_(g), sharp_(checked_inverse(g)) {}

  /// Z -> g(., Z), and its inverse.
  [[nodiscard]] const CovariantTensor<T>& flat() const { return flat_; }
  [[nodiscard]] const ContravariantTensor<T>& sharp() const { return sharp_; }

 private:
  static Matrix<T> checked_inverse(const Matrix<T>& g) {
    const auto values = detail::values_of(g);
    const auto accepted = static_cast<double>(largest(values)) * detail::rounding<Value<T>>(1);
    for (std::size_t i = 0; i < g.rows(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (static_cast<double>(abs(values(i, j) - values(j, i))) > accepted)
          throw InputError("metric: entries (" + std::to_string(j + 1) + ", " + std::to_string(i + 1) +
                           ") and (" + std::to_string(i + 1) + ", " + std::to_string(j + 1) +
                           ") differ; expected a symmetric matrix");
    detail::expect_independent_rows(g, "metric", "a metric that is not degenerate");
    return inverse(g);
  }
  CovariantTensor<T> flat_;
  ContravariantTensor<T> sharp_;
};

}  // namespace pfaff
