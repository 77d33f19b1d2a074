// Vectors and covectors at a point, and the linear maps between them, kept apart by their types.
//
// A velocity is a vector Z, a momentum or a force is a covector alpha, and alpha(Z) = sum_i alpha_i Z^i. A
// map L of vectors acts on covectors by its transpose: (L^T alpha)(Z) = alpha(L Z). Both are n x n numbers,
// so that formulas written with bare matrices mix them without notice, which is what goes wrong in
// pitanga-rodrigues (23)-(26) and (41). Here each map knows what it takes and what it gives, and mixing does
// not compile.
//
// Everything allocates and is meant for work at points, not for steps. T is any scalar with the four
// operations.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// The tangent space at a point, and its dual.
struct Vectors {};
struct Covectors {};
template <class Space>
using DualSpace = std::conditional_t<std::is_same_v<Space, Vectors>, Covectors, Vectors>;

/// An element of one of the two spaces by its components in coordinates.
template <class T, class Space>
class Element {
 public:
  explicit Element(std::size_t n) : components_(n, T(0)) {}
  explicit Element(std::vector<T> components) : components_(std::move(components)) {}

  [[nodiscard]] std::size_t size() const { return components_.size(); }
  [[nodiscard]] const std::vector<T>& components() const { return components_; }
  T& operator[](std::size_t i) { return components_[i]; }
  const T& operator[](std::size_t i) const { return components_[i]; }

  friend Element operator*(const T& factor, Element x) {
    for (T& c : x.components_) c = factor * c;
    return x;
  }

 private:
  std::vector<T> components_;
};
template <class T>
using TangentVector = Element<T, Vectors>;
template <class T>
using Covector = Element<T, Covectors>;

template <class T, class A, class B>
Element<T, A> operator+(Element<T, A> x, const Element<T, B>& y) {
  static_assert(std::is_same_v<A, B>, "a vector and a covector have no sum");
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + y[i];
  return x;
}
template <class T, class A, class B>
Element<T, A> operator-(Element<T, A> x, const Element<T, B>& y) {
  static_assert(std::is_same_v<A, B>, "a vector and a covector have no difference");
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] - y[i];
  return x;
}

/// alpha(Z).
template <class T, class A, class B>
T pairing(const Element<T, A>& alpha, const Element<T, B>& z) {
  static_assert(std::is_same_v<A, Covectors> && std::is_same_v<B, Vectors>,
                "a pairing takes a covector and then a vector");
  T sum(0);
  for (std::size_t i = 0; i < alpha.size(); ++i) sum = sum + alpha[i] * z[i];
  return sum;
}

/// A linear map by its n x n matrix.
template <class T, class From, class To>
class LinearMap {
 public:
  /// InputError unless the matrix is square.
  explicit LinearMap(Matrix<T> matrix) : matrix_(std::move(matrix)) {
    if (matrix_.rows() != matrix_.columns())
      throw InputError("linear map: a matrix of " + std::to_string(matrix_.rows()) + " x " +
                       std::to_string(matrix_.columns()) + "; expected a square one");
  }

  [[nodiscard]] std::size_t size() const { return matrix_.rows(); }
  [[nodiscard]] const Matrix<T>& matrix() const { return matrix_; }
  /// The same map on the duals, in the opposite direction: L^T of a map of vectors is a map of covectors.
  [[nodiscard]] LinearMap<T, DualSpace<To>, DualSpace<From>> transposed() const {
    return LinearMap<T, DualSpace<To>, DualSpace<From>>(matrix_.transposed());
  }
  friend LinearMap operator-(const LinearMap& a) { return LinearMap(-a.matrix_); }

 private:
  Matrix<T> matrix_;
};

/// Projectors and other maps of vectors, and of covectors.
template <class T>
using VectorOperator = LinearMap<T, Vectors, Vectors>;
template <class T>
using CovectorOperator = LinearMap<T, Covectors, Covectors>;
/// A metric g or a two-form: Z -> g(., Z). An inverse metric or a bivector: alpha -> Pi(., alpha).
template <class T>
using CovariantTensor = LinearMap<T, Vectors, Covectors>;
template <class T>
using ContravariantTensor = LinearMap<T, Covectors, Vectors>;

template <class T, class From, class To, class Space>
Element<T, To> operator*(const LinearMap<T, From, To>& map, const Element<T, Space>& x) {
  static_assert(std::is_same_v<From, Space>,
                "a map of vectors takes no covector, and a map of covectors no vector");
  return Element<T, To>(map.matrix() * x.components());
}
/// First the map on the right.
template <class T, class From, class Middle, class Other, class To>
LinearMap<T, From, To> operator*(const LinearMap<T, Middle, To>& left,
                                 const LinearMap<T, From, Other>& right) {
  static_assert(std::is_same_v<Middle, Other>,
                "the map on the left does not take what the one on the right gives");
  return LinearMap<T, From, To>(left.matrix() * right.matrix());
}
template <class T, class From, class To, class OtherFrom, class OtherTo>
LinearMap<T, From, To> operator+(const LinearMap<T, From, To>& a, const LinearMap<T, OtherFrom, OtherTo>& b) {
  static_assert(std::is_same_v<From, OtherFrom> && std::is_same_v<To, OtherTo>,
                "maps between different spaces have no sum");
  return LinearMap<T, From, To>(a.matrix() + b.matrix());
}
template <class T, class From, class To, class OtherFrom, class OtherTo>
LinearMap<T, From, To> operator-(const LinearMap<T, From, To>& a, const LinearMap<T, OtherFrom, OtherTo>& b) {
  return a + (-b);
}

/// Z (x) alpha, the map X -> alpha(X) Z.
template <class T>
VectorOperator<T> outer(const TangentVector<T>& z, const Covector<T>& alpha) {
  Matrix<T> m(z.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i)
    for (std::size_t j = 0; j < z.size(); ++j) m(i, j) = z[i] * alpha[j];
  return VectorOperator<T>(std::move(m));
}

template <class T>
VectorOperator<T> identity_of_vectors(std::size_t n) {
  return VectorOperator<T>(Matrix<T>::identity(n));
}
/// The i-th coordinate vector d/dz^i or coordinate covector dz^i.
template <class T, class Space>
Element<T, Space> coordinate_element(std::size_t n, std::size_t i) {
  Element<T, Space> e(n);
  e[i] = T(1);
  return e;
}

/// The values tensor(x_i, y_j) of a tensor of two arguments: of a metric on vectors, of an inverse metric on
/// covectors.
template <class T, class From, class Space>
Matrix<T> gram(const LinearMap<T, From, DualSpace<From>>& tensor, const std::vector<Element<T, Space>>& x,
               const std::vector<Element<T, Space>>& y) {
  Matrix<T> values(x.size(), y.size());
  for (std::size_t j = 0; j < y.size(); ++j) {
    const auto image = tensor * y[j];
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t k = 0; k < image.size(); ++k) values(i, j) = values(i, j) + x[i][k] * image[k];
  }
  return values;
}

/// One of them, tensor(x, y).
template <class T, class From, class Space>
T value_on(const LinearMap<T, From, DualSpace<From>>& tensor, const Element<T, Space>& x,
           const Element<T, Space>& y) {
  return gram(tensor, std::vector<Element<T, Space>>{x}, std::vector<Element<T, Space>>{y})(0, 0);
}

/// The rows of a K x n matrix as covectors.
template <class T>
std::vector<Covector<T>> covectors_in_rows(const Matrix<T>& a) {
  std::vector<Covector<T>> list;
  for (std::size_t i = 0; i < a.rows(); ++i) list.emplace_back(a.block(i, 0, 1, a.columns()).entries());
  return list;
}

}  // namespace pfaff
