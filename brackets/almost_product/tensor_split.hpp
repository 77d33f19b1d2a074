// How a tensor of two arguments splits along an almost-product structure (pitanga-rodrigues (1)-(4), Remark
// 1):
//
//   pi = pi_P + pi_Q + mixed part,   pi_P(alpha, beta) = pi(P^T alpha, P^T beta),   pi_Q likewise
//
// for an inverse metric or a bivector, and with P instead of P^T for a metric or a two-form. The paper states
// (1)-(4) for any structure. They hold where the mixed part vanishes, and the tensor and the structure are
// then called compatible: for a metric that means that the projectors are orthogonal.
#pragma once

#include <pfaff/brackets/almost_product/almost_product.hpp>

namespace pfaff {

/// The parts of a tensor; their sum is the tensor.
template <class Tensor>
struct TensorSplit {
  Tensor admissible, complement, mixed;
  /// The mixed part is zero: exactly in exact scalars, in others to the rounding of the largest part.
  [[nodiscard]] bool compatible() const {
    const auto size = largest(admissible.matrix()) + largest(complement.matrix()) + largest(mixed.matrix());
    const auto left = largest(mixed.matrix());
    return static_cast<double>(left) <=
           static_cast<double>(size) * detail::rounding<std::remove_const_t<decltype(size)>>(mixed.size());
  }
};

namespace detail {
// The bilinear form (x, y) -> tensor(x', y') where x' and y' are what left and right make of x and y.
template <class Tensor, class Left, class Right>
Tensor pulled_back(const Tensor& tensor, const Left& left, const Right& right) {
  return left.transposed() * tensor * right;
}
template <class Tensor, class Map>
TensorSplit<Tensor> split_by(const Tensor& tensor, const Map& p, const Map& q) {
  return {pulled_back(tensor, p, p), pulled_back(tensor, q, q),
          pulled_back(tensor, p, q) + pulled_back(tensor, q, p)};
}
}  // namespace detail

template <class T>
TensorSplit<ContravariantTensor<T>> split(const ContravariantTensor<T>& tensor,
                                          const AlmostProduct<T>& structure) {
  return detail::split_by(tensor, structure.admissible().transposed(), structure.complement().transposed());
}
template <class T>
TensorSplit<CovariantTensor<T>> split(const CovariantTensor<T>& tensor, const AlmostProduct<T>& structure) {
  return detail::split_by(tensor, structure.admissible(), structure.complement());
}

}  // namespace pfaff
