// The tensor of a nonholonomic bracket (pitanga-rodrigues (39)-(41), signs and transposes as they must be). A
// projection of momenta, pbar_j = P^k_j p_k + s_j, is made of a projector field P(z) of velocities; the
// bracket of functions of z and pbar is the canonical one of phase space:
//
//   {z^i, z^j} = 0,  {z^i, pbar_j} = P^i_j,  D_ij = {pbar_i, pbar_j} = P^k_j d_k pbar_i - P^k_i d_k pbar_j,
//   Pibar = [[0, P], [-P^T, D]],
//
// at constrained momenta, p = pbar. It is skew and obeys Leibniz' rule, and obeys Jacobi's identity only
// where the distribution that P projects onto is integrable. For the orthogonal P of the kinetic energy its
// flow Pibar grad H is nonholonomic motion; for another P the rate of the momenta is wrong.
#pragma once

#include <pfaff/brackets/almost_product/vectors_and_covectors.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// A projection of momenta at one place: pbar = P^T p + shift. The shift is zero where the constraints are
/// linear in the momenta.
template <class T>
struct MomentumProjector {
  VectorOperator<T> admissible;
  Covector<T> shift;

  [[nodiscard]] Covector<T> operator()(const Covector<T>& p) const {
    return admissible.transposed() * p + shift;
  }
};

/// Pibar (2n x 2n) at positions z and constrained momenta p. The projection F has
///   template <class S> MomentumProjector<S> at(const std::vector<S>& z) const,
/// which is differentiated by dual numbers.
template <class T, class F>
Matrix<T> pseudo_poisson_tensor(const F& projection, const std::vector<T>& z, const Covector<T>& p) {
  using D = Dual<T, 1>;
  const std::size_t n = z.size();
  const Matrix<T> onto = projection.template at<T>(z).admissible.matrix();
  Matrix<T> slopes(n, n);  // d_k pbar_i in row k
  std::vector<D> moved(z.begin(), z.end());
  const Covector<D> fixed(std::vector<D>(p.components().begin(), p.components().end()));
  for (std::size_t k = 0; k < n; ++k) {
    moved[k].derivative[0] = T(1);
    const Covector<D> projected = projection.template at<D>(moved)(fixed);
    moved[k].derivative[0] = T(0);
    for (std::size_t i = 0; i < n; ++i) slopes(k, i) = projected[i].derivative[0];
  }
  const Matrix<T> along = onto.transposed() * slopes;  // P^k_j d_k pbar_i at (j, i)
  Matrix<T> tensor(2 * n, 2 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      tensor(i, n + j) = onto(i, j);
      tensor(n + i, j) = -onto(j, i);
      tensor(n + i, n + j) = along(j, i) - along(i, j);
    }
  return tensor;
}

}  // namespace pfaff
