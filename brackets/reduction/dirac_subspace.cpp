#include <pfaff/brackets/reduction/dirac_subspace.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/linear/singular_values.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {

namespace {

template <class T>
double tolerance(const Matrix<T>& m) {
  return 64 * static_cast<double>(std::max(m.rows(), m.columns())) * static_cast<double>(unit_roundoff<T>());
}
template <class T>
IndependentRows<T> rows_of(const Matrix<T>& m) {
  return independent_rows(m, tolerance(m));
}

Matrix<Quad> orthonormal(const Matrix<Quad>& rows, const std::vector<std::size_t>& independent) {
  Matrix<Quad> q(independent.size(), rows.columns());
  const std::size_t n = rows.columns();
  for (std::size_t k = 0; k < independent.size(); ++k) {
    for (std::size_t i = 0; i < n; ++i) q(k, i) = rows(independent[k], i);
    const auto product = [&](std::size_t a, std::size_t b) {
      Quad sum(0);
      for (std::size_t i = 0; i < n; ++i) sum += q(a, i) * q(b, i);
      return sum;
    };
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t b = 0; b < k; ++b) {
        const Quad share = product(k, b);
        for (std::size_t i = 0; i < n; ++i) q(k, i) -= share * q(b, i);
      }
    const Quad length = sqrt(product(k, k));
    for (std::size_t i = 0; i < n; ++i) q(k, i) /= length;
  }
  return q;
}

template <class T>
Matrix<Quad> in_quad(const Matrix<T>& m) {
  Matrix<Quad> q(m.rows(), m.columns());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) q(i, j) = static_cast<Quad>(m(i, j));
  return q;
}

}  // namespace

template <class T>
DiracSubspace dirac_subspace(const Matrix<T>& p, const Matrix<T>& a) {
  if (p.rows() != p.columns() || a.columns() != p.rows())
    throw InputError("dirac subspace: a tensor of " + std::to_string(p.rows()) + " x " +
                     std::to_string(p.columns()) + " and covectors of " + std::to_string(a.columns()) +
                     " components");
  DiracSubspace result;
  const auto normals = rows_of(a);
  Matrix<T> annihilator(normals.independent.size(), a.columns());
  for (std::size_t i = 0; i < annihilator.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j) annihilator(i, j) = a(normals.independent[i], j);
  result.annihilator = annihilator.rows();
  const Matrix<T> images = annihilator * p.transposed();  // rows P a
  const auto image = rows_of(images);
  result.image = image.independent.size();
  result.angle = std::numbers::pi / 2;
  const std::size_t m = result.image, k = result.annihilator;
  // Sines of the angles between P(F^0) and F are the singular values of N Q^T, N and Q orthonormal bases of
  // the normals of F and of P(F^0); the rank of W = A P A^T is the number of those that are not zero.
  if constexpr (std::numeric_limits<T>::is_exact) {
    result.brackets = rows_of(annihilator * images.transposed()).independent.size();
  }
  if (m == 0 || k == p.rows()) {
    if (!std::numeric_limits<T>::is_exact) result.brackets = m;
    return result;
  }
  std::vector<std::size_t> all(k);
  for (std::size_t i = 0; i < k; ++i) all[i] = i;
  const Matrix<Quad> products =
      orthonormal(in_quad(annihilator), all) * orthonormal(in_quad(images), image.independent).transposed();
  Matrix<Quad> square(k, k);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < m; ++j) square(i, j) = products(i, j);
  auto sines = singular_values(square).values;
  std::sort(sines.begin(), sines.end(), [](Quad x, Quad y) { return x > y; });
  const auto smallest = static_cast<double>(sines[m - 1]);
  result.angle = std::asin(std::min(1.0, smallest));
  if (!std::numeric_limits<T>::is_exact)
    for (const Quad s : sines) result.brackets += static_cast<double>(s) > tolerance(p);
  return result;
}

std::string describe(const DiracSubspace& s) {
  std::string text =
      s.meets_in_zero() ? "TN and P(TN^0) meet in 0" : "TN and P(TN^0) have a vector in common";
  text += ": angle " + to_string(Quad(s.angle), 3) + " (brackets of the constraints have rank " +
          std::to_string(s.brackets) + " of " + std::to_string(s.annihilator) + ")";
  if (!s.transversal()) text += "; a combination of the constraints is a Casimir to first order";
  return text;
}

template DiracSubspace dirac_subspace(const Matrix<double>&, const Matrix<double>&);
template DiracSubspace dirac_subspace(const Matrix<Quad>&, const Matrix<Quad>&);
template DiracSubspace dirac_subspace(const Matrix<Rational>&, const Matrix<Rational>&);

}  // namespace pfaff
