// Nguyen & Turski, (4.6) and appendix C: inverses of symmetric tridiagonal matrices, exactly over fractions
// and, where roots are taken, in quad.
#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/core/linear/tridiagonal_inverse.hpp>

namespace pfaff::nguyen_turski {

namespace {
constexpr std::size_t rows_of_s = 6;

// Positive definite: diagonally dominant.
Tridiagonal<Rational> sample() {
  Tridiagonal<Rational> s;
  for (int k = 0; k < static_cast<int>(rows_of_s); ++k) {
    s.diagonal.push_back(Rational(7 + 3 * k) / Rational(2));
    if (k + 1 < static_cast<int>(rows_of_s))
      s.couplings.push_back(Rational(k % 2 == 0 ? 5 : -4) / Rational(3 + k));
  }
  return s;
}
Tridiagonal<Quad> in_quad(const Tridiagonal<Rational>& s) { return {quads(s.diagonal), quads(s.couplings)}; }

// (C.5) with any determinant d_0 of the empty block, and (C.6).
ExactMatrix inverse_with_empty_block(const Tridiagonal<Rational>& s, const Rational& empty) {
  const std::size_t n = s.rows();
  const auto minor = [&](std::size_t first, std::size_t end) {  // of rows first .. end - 1
    Rational before(1), last = empty;
    for (std::size_t k = first; k < end; ++k) {
      const Rational next =
          k == first ? s.diagonal[k]
                     : Rational(s.diagonal[k] * last - s.couplings[k - 1] * s.couplings[k - 1] * before);
      before = k == first ? empty : last;
      last = next;
    }
    return last;
  };
  ExactMatrix m(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      Rational entry = minor(0, i) * minor(j + 1, n) / minor(0, n);
      for (std::size_t k = i; k < j; ++k) entry = entry * (-s.couplings[k]);
      m(i, j) = m(j, i) = entry;
    }
  return m;
}

// (C.16) with the sum up to `last`.
Matrix<Quad> inverse_by_sums(const InverseFactor<Quad>& u, std::size_t last) {
  const std::size_t n = u.x.size();
  Matrix<Quad> m(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      Quad sum(0);
      for (std::size_t k = j; k < last; ++k) {
        Quad term = u.x[k] * u.x[k];
        for (std::size_t l = i; l < k; ++l) term *= u.y[l];
        for (std::size_t l = j; l < k; ++l) term *= u.y[l];
        sum += term;
      }
      m(i, j) = m(j, i) = u.z[i] * u.z[j] * sum;
    }
  return m;
}
}  // namespace

void tridiagonal_rows(Rows& rows) {
  const Tridiagonal<Rational> s = sample();
  const ExactMatrix dense = s.dense(), inverted = inverse(dense);
  std::vector<Rational> minors;
  for (std::size_t k = 1; k <= rows_of_s; ++k) {
    ExactMatrix block(k, k);
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) block(i, j) = dense(i, j);
    minors.push_back(determinant(block));
  }
  std::vector<Rational> leading = leading_minors(s);
  leading.erase(leading.begin());
  rows.reproduced("(C.3)", "leading minors by recursion", quads(leading), quads(minors));
  rows.reproduced("(4.6), (C.4), (C.6)", "inverse by minors", quads(inverse_by_minors(s)), quads(inverted));
  rows.erratum("(C.5)", "minor of the empty block", quads(inverse_with_empty_block(s, Rational(0))),
               quads(inverse_with_empty_block(s, Rational(1))), quads(inverted),
               "(C.5): d_0 = 0 for the empty block; it is 1");
  rows.reproduced("(C.7)-(C.9)", "inverse as a one-pair matrix", quads(one_pair_inverse(s).dense()),
                  quads(inverted));

  const Tridiagonal<Quad> q = in_quad(s);
  const InverseFactor<Quad> u = inverse_factor(q);
  const Matrix<Quad> factor = u.dense(), quad_dense = q.dense();
  Matrix<Quad> one(rows_of_s, rows_of_s);
  for (std::size_t i = 0; i < rows_of_s; ++i) one(i, i) = Quad(1);
  const Matrix<Quad> unit = factor.transposed() * quad_dense * factor;
  rows.reproduced("(C.12)-(C.15)", "factor: U^T S U = 1", one.entries(), unit.entries());
  // x_K is not said: with the rule of the others, from a_K = 1 and the last row, it is 1.
  InverseFactor<Quad> other = u;
  other.x.back() = Quad(0);
  const Matrix<Quad> without = other.dense();
  rows.erratum("(C.12)", "last number x_K of the factor",
               (without.transposed() * quad_dense * without).entries(), unit.entries(), one.entries(),
               "(C.12): x_K is undefined (read as 0 here); it is 1");
  rows.erratum("(C.16)", "inverse by sums over the factor", inverse_by_sums(u, rows_of_s - 1).entries(),
               inverse_by_sums(u, rows_of_s).entries(), quads(inverted),
               "(C.16): sums end at K - 1; they end at K");
  rows.reproduced("(C.17)", "normalised couplings beta by themselves", normalised_couplings(q), u.beta);
  // The step from beta_k to beta_{k+1} needs the entry (k + 1, k + 1) of the layout to be 1.
  const Quad second = q.couplings[1] * u.z[1];
  rows.qualitative("(C.11)", "place of beta_{k+1}", "-", to_string(second, 6),
                   static_cast<double>(abs(second - u.beta[1])), at_round_off,
                   abs(second - u.beta[1]) < Quad(at_round_off),
                   "(C.11): at (k+1, k+2), (k+2, k+1); (C.13) tested");
}

}  // namespace pfaff::nguyen_turski
