// Random matrices of the groups and algebras that the fractional transformation is about. Fixed seeds.
#pragma once

#include <random>

#include <pfaff/integrators/generating/fractional_transformation.hpp>

namespace pfaff::testing {

template <class T>
class RandomMatrices {
 public:
  explicit RandomMatrices(unsigned seed) : random_(seed) {}

  T number() {
    std::uniform_int_distribution<int> draw(-9, 9);
    return T(draw(random_)) / T(10);
  }
  Matrix<T> any(std::size_t n) {
    Matrix<T> m(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) m(i, j) = number();
    return m;
  }
  Matrix<T> symmetric(std::size_t n) {
    const Matrix<T> m = any(n);
    return T(1) / T(2) * (m + m.transposed());
  }
  /// Regular: near the identity.
  Matrix<T> regular(std::size_t n) { return Matrix<T>::identity(n) + T(1) / T(5) * any(n); }
  /// S with S^T J S = J: shears one after the other.
  Matrix<T> symplectic(std::size_t n) {
    const std::size_t half = n / 2;
    Matrix<T> product = Matrix<T>::identity(n);
    for (int k = 0; k < 4; ++k) {
      const Matrix<T> s = T(1) / T(2) * symmetric(half);
      Matrix<T> shear = Matrix<T>::identity(n);
      for (std::size_t i = 0; i < half; ++i)
        for (std::size_t j = 0; j < half; ++j)
          (k % 2 == 0 ? shear(i, half + j) : shear(half + i, j)) = s(i, j);
      product = shear * product;
    }
    return product;
  }
  /// V with V^T J + J V = 0, an element of sp(n): J times a symmetric matrix.
  Matrix<T> hamiltonian(std::size_t n) { return canonical_structure<T>(n / 2) * symmetric(n); }

 private:
  std::mt19937 random_;
};

}  // namespace pfaff::testing
