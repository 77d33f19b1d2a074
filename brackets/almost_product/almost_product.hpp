// Almost-product structures at a point (pitanga-rodrigues section 2): complementary projectors P + Q = I of
// vectors that are made of one-forms w^1 ... w^m. P is onto the vectors that the one-forms annihilate, which
// are the velocities and virtual displacements that constraints w(v) = 0 admit, and Q is along P onto a
// complement. (The paper changes the roles of P and Q between its sections; here P is always that one.)
//
//   Q = sum Y_alpha (x) w^alpha,  w^alpha(Y_beta) = delta^alpha_beta
//
// - oblique (5)-(6): the complement is spanned by the last m coordinate vectors. With w^alpha = dz^alpha +
//   Gamma^alpha_a dz^a, Q = [[0, 0], [Gamma, I]];
// - orthogonal (8)-(9), (26): the complement is the metric's, spanned by xi^alpha = g^-1 w^alpha, and
//   Q = g^-1 A^T G^-1 A with the rows w^alpha of A and G = A g^-1 A^T. The G_{alpha beta} in (8) is the
//   inverse of that G; (7) uses the same letter for g(Y_alpha, Y_beta), which is another matrix unless both
//   agree.
//
// On momenta and forces the transposes act: P^T and Q^T, of another type.
#pragma once

#include <pfaff/brackets/almost_product/metric.hpp>

namespace pfaff {

template <class T>
class AlmostProduct {
 public:
  /// The structure of one-forms and of fields Y, as many, that span the complement. InputError where the
  /// one-forms depend on each other (which rows; `names` are theirs, or empty), or where a combination of the
  /// fields is annihilated by all of them.
  AlmostProduct(std::vector<Covector<T>> one_forms, const std::vector<TangentVector<T>>& complement,
                const std::vector<std::string>& names = {})
      : one_forms_(std::move(one_forms)),
        fields_(dual_fields(one_forms_, complement, names)),
        complement_(sum_of_products(fields_, one_forms_)) {}

  /// P, onto the vectors that the one-forms annihilate, and Q = I - P, onto the complement.
  [[nodiscard]] VectorOperator<T> admissible() const {
    return identity_of_vectors<T>(complement_.size()) - complement_;
  }
  [[nodiscard]] const VectorOperator<T>& complement() const { return complement_; }
  /// Gamma = P - Q, whose square is I.
  [[nodiscard]] VectorOperator<T> reflection() const { return admissible() - complement_; }
  /// w^alpha, as given.
  [[nodiscard]] const std::vector<Covector<T>>& one_forms() const { return one_forms_; }
  /// The basis of the complement with w^alpha(Y_beta) = delta^alpha_beta.
  [[nodiscard]] const std::vector<TangentVector<T>>& fields() const { return fields_; }

 private:
  static std::vector<TangentVector<T>> dual_fields(const std::vector<Covector<T>>& w,
                                                   const std::vector<TangentVector<T>>& y,
                                                   const std::vector<std::string>& names) {
    const std::size_t m = w.size(), n = m == 0 ? 0 : w.front().size();
    if (m == 0 || y.size() != m)
      throw InputError("almost-product structure: " + std::to_string(m) + " one-forms and " +
                       std::to_string(y.size()) + " fields; expected at least one, and as many of each");
    Matrix<T> rows(m, n), pairings(m, m);
    for (std::size_t a = 0; a < m; ++a) {
      for (std::size_t i = 0; i < n; ++i) rows(a, i) = w[a][i];
      for (std::size_t b = 0; b < m; ++b) pairings(a, b) = pairing(w[a], y[b]);
    }
    detail::expect_independent_rows(rows, "one-forms", "one-forms that are independent", names);
    detail::expect_independent_rows(pairings, "one-forms on the complement",
                                    "a complement that no combination of the one-forms annihilates", names);
    const Matrix<T> weights = inverse(pairings);
    std::vector<TangentVector<T>> dual;
    for (std::size_t b = 0; b < m; ++b) {
      TangentVector<T> field(n);
      for (std::size_t a = 0; a < m; ++a) field = field + weights(a, b) * y[a];
      dual.push_back(std::move(field));
    }
    return dual;
  }
  static VectorOperator<T> sum_of_products(const std::vector<TangentVector<T>>& fields,
                                           const std::vector<Covector<T>>& one_forms) {
    VectorOperator<T> sum = outer(fields[0], one_forms[0]);
    for (std::size_t a = 1; a < fields.size(); ++a) sum = sum + outer(fields[a], one_forms[a]);
    return sum;
  }

  std::vector<Covector<T>> one_forms_;
  std::vector<TangentVector<T>> fields_;
  VectorOperator<T> complement_;
};

/// w^alpha = dz^alpha + Gamma^alpha_a dz^a from Gamma (m x (n - m)), with the z^alpha last.
template <class T>
std::vector<Covector<T>> one_forms_of(const Matrix<T>& gamma) {
  const std::size_t m = gamma.rows(), free = gamma.columns();
  Matrix<T> a(m, free + m);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < free; ++k) a(i, k) = gamma(i, k);
    a(i, free + i) = T(1);
  }
  return covectors_in_rows(a);
}

/// (5)-(6). InputError where the one-forms depend on each other, or do not determine the last coordinates.
template <class T>
AlmostProduct<T> oblique(const std::vector<Covector<T>>& one_forms) {
  const std::size_t m = one_forms.size(), n = m == 0 ? 0 : one_forms.front().size();
  std::vector<TangentVector<T>> last;
  for (std::size_t a = 0; a < m; ++a) last.push_back(coordinate_element<T, Vectors>(n, n - m + a));
  return AlmostProduct<T>(one_forms, last);
}

/// xi^alpha = g^-1 w^alpha.
template <class T>
std::vector<TangentVector<T>> raised(const ContravariantTensor<T>& inverse_metric,
                                     const std::vector<Covector<T>>& one_forms) {
  std::vector<TangentVector<T>> fields;
  for (const Covector<T>& w : one_forms) fields.push_back(inverse_metric * w);
  return fields;
}
/// (8)-(9), (26), from the inverse of the metric, such as H_pp. InputError where the one-forms depend on each
/// other.
template <class T>
AlmostProduct<T> orthogonal(const ContravariantTensor<T>& inverse_metric,
                            const std::vector<Covector<T>>& one_forms,
                            const std::vector<std::string>& names = {}) {
  return AlmostProduct<T>(one_forms, raised(inverse_metric, one_forms), names);
}

/// U with Q = U q U^-1 (pitanga-rodrigues 4.2), where q = w^alpha (x) Y_alpha is the structure given and Q is
/// the orthogonal one of the same one-forms: U leaves admissible vectors as they are and takes Y_alpha to
/// xi^alpha, U = p + sum xi^alpha (x) w^alpha.
template <class T>
VectorOperator<T> conjugation(const AlmostProduct<T>& structure,
                              const ContravariantTensor<T>& inverse_metric) {
  VectorOperator<T> u = structure.admissible();
  for (const Covector<T>& w : structure.one_forms()) u = u + outer(inverse_metric * w, w);
  return u;
}

}  // namespace pfaff
