// Reduction: almost Dirac reductions of tensors and fields, Dirac subspaces, the transverse structure.
#include <gtest/gtest.h>

#include <numbers>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>
#include <pfaff/brackets/reduction/dirac_subspace.hpp>
#include <pfaff/brackets/reduction/splitting.hpp>
#include <pfaff/brackets/reduction/transverse.hpp>

#include "golden_brackets.hpp"
#include "random_gram.hpp"
#include "sample_brackets.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

Exact dirac_tensor(const Exact& p, const Exact& a) {
  return p - p * a.transposed() * inverse(a * p * a.transposed()) * a * p;
}
// Columns that span ker A, A of full rank.
Exact kernel(const Exact& a) {
  const std::size_t n = a.columns(), k = a.rows();
  const Exact lead = inverse(a.block(0, 0, k, k)) * a.block(0, k, k, n - k);
  Exact basis(n, n - k);
  for (std::size_t j = 0; j < n - k; ++j) {
    for (std::size_t i = 0; i < k; ++i) basis(i, j) = -lead(i, j);
    basis(k + j, j) = 1;
  }
  return basis;
}

TEST(Splitting, ProjectsOntoFAlongV) {
  RandomGram random(30);
  for (int instance = 0; instance < 30; ++instance) {
    const std::size_t n = random.size(2, 6), r = random.size(1, n - 1);
    const Exact all = random.regular(Symmetry::none, n), f = all.block(0, 0, n, r),
                v = all.block(0, r, n, n - r);
    const Splitting<Rational> splitting(f, v);
    const Exact& p = splitting.projection();
    EXPECT_TRUE(zero(p * p - p));
    EXPECT_TRUE(zero(p * f - f));
    EXPECT_TRUE(zero(p * v));
    EXPECT_TRUE(zero(splitting.annihilator() * f));
    // K_F of a vector and a tensor: (2.1) with covectors.
    const auto k = random.any(n, n);
    const auto alpha = random.any(1, n), beta = random.any(1, n);
    EXPECT_TRUE(
        zero(alpha * splitting.reduced(k) * beta.transposed() - (alpha * p) * k * (beta * p).transposed()));
    const auto vector = random.any(n, 1);
    const auto reduced = splitting.reduced(vector.entries());
    EXPECT_TRUE(zero(alpha * Exact(n, reduced) - (alpha * p) * vector));
    // Symmetry and sign are inherited.
    const Exact skew = splitting.reduced(k - k.transposed()), square = splitting.reduced(k * k.transposed());
    EXPECT_TRUE(zero(skew + skew.transposed()));
    EXPECT_TRUE(zero(square - square.transposed()));
    EXPECT_GE((alpha * square * alpha.transposed())(0, 0), Rational(0));
  }
  EXPECT_THROW((Splitting<Rational>(Exact(3, 1), Exact(3, 1))), InputError);
  EXPECT_THROW(
      (Splitting<Rational>(Exact::identity(2).block(0, 0, 2, 1), Exact::identity(2).block(0, 0, 2, 1))),
      InputError);
}

// nguyen-turski Proposition 1: with V = P(F^0) the projection is Dirac's, P = P_F + P_V, and P_F is (1.2).
// That F and P(F^0) meet in 0 does not make V that: another complement leaves p(P F^0) different from 0.
TEST(Splitting, DiracProjectionsNeedTheirComplement) {
  RandomGram random(31);
  for (const Symmetry symmetry : {Symmetry::skew, Symmetry::symmetric, Symmetry::none})
    for (int instance = 0; instance < 20; ++instance) {
      const std::size_t n = 6, k = 2;
      const Exact p = random.regular(symmetry, n), a = random.any(k, n);
      if (determinant(a.block(0, 0, k, k)) == Rational(0) ||
          determinant(a * p * a.transposed()) == Rational(0))
        continue;
      const Exact f = kernel(a);
      ASSERT_TRUE(dirac_subspace(p, a).splits());
      const Exact left = (a * p).transposed();  // P^T F^0: the complement for the other argument
      const Splitting<Rational> chosen(f, p * a.transposed()), other(f, a.transposed());
      EXPECT_TRUE(zero(chosen.dirac_projection_defect(p)));
      EXPECT_FALSE(zero(other.dirac_projection_defect(p)));
      const Exact reduced = chosen.reduced(p);
      EXPECT_FALSE(zero(reduced - other.reduced(p)));
      if (symmetry == Symmetry::none) {
        EXPECT_TRUE(zero(chosen.projection() * p * Splitting<Rational>(f, left).projection().transposed() -
                         dirac_tensor(p, a)));
        continue;
      }
      EXPECT_TRUE(zero(reduced - dirac_tensor(p, a)));
      const Exact along = Exact::identity(n) - chosen.projection();
      EXPECT_TRUE(zero(reduced + along * p * along.transposed() - p));
    }
}

template <class T>
void expect_transverse(double bound) {
  RandomGram random(32);
  for (int instance = 0; instance < 20; ++instance) {
    const std::size_t n = 6, k = 4;
    const Exact exact_p = random.of_rank(Symmetry::skew, n, 4), exact_dx = random.any(k, n);
    const Exact w = exact_dx * exact_p * exact_dx.transposed();
    if (determinant(w) == Rational(0)) continue;
    const auto p = as<T>(exact_p), dx = as<T>(exact_dx);
    const TransverseStructure<T> structure(p, dx);
    // Round-off of products of these matrices, relative to the largest of them.
    const T scale = (T(1) + largest(structure.lambda_inverse()) * largest(structure.fields())) *
                    (T(1) + largest(structure.fields())) *
                    (T(1) + largest(structure.lambda_inverse()) * largest(structure.lambda()));
    const auto small = [&](const Matrix<T>& m) { return static_cast<double>(largest(m) / scale) <= bound; };
    const auto onto = structure.leaf_projection(), x = structure.fields();
    EXPECT_TRUE(small(onto * onto - onto));
    EXPECT_TRUE(small(onto * dx.transposed() - dx.transposed()));             // p*(dx^b) = dx^b
    EXPECT_TRUE(small(onto.transposed() * x.transposed() - x.transposed()));  // p(X^c) = X^c
    EXPECT_TRUE(small(onto.transposed() * p * onto - structure.leaf()));      // Pi_S from Pi_W by projection
    EXPECT_TRUE(small(structure.composed() - structure.transverse()));        // (13)
    EXPECT_TRUE(small(structure.transverse() -
                      (p - p * dx.transposed() * structure.lambda_inverse() * dx * p)));  // (17)
    EXPECT_TRUE(small(structure.transverse() * dx.transposed()));
    // The sign printed for Pi_S makes the constraints no Casimirs.
    EXPECT_FALSE(small((p + structure.leaf()) * dx.transposed()));
    // After (17): w_S of projected fields of f and g, X_f = {f, .}, w_S(X^d, X^b) = lambda^{db}.
    const auto f = as<T>(random.any(1, n)), g = as<T>(random.any(1, n));
    const auto xf = f * p, xg = g * p;
    const auto projected = (xf * dx.transposed()) * structure.lambda_inverse() * structure.lambda() *
                           ((xg * dx.transposed()) * structure.lambda_inverse()).transposed();
    EXPECT_TRUE(small(projected - f * structure.leaf() * g.transposed()));
  }
}
TEST(Transverse, IdentitiesOfTheSplitting) {
  expect_transverse<Rational>(0);
  expect_transverse<double>(1e3 * unit_roundoff<double>());
  expect_transverse<Quad>(1e3 * static_cast<double>(unit_roundoff<Quad>()));
}
TEST(Transverse, SingularConstraintsAreRefused) {
  Exact p(4, 4), dx(2, 4);
  p(0, 2) = p(1, 3) = 1;
  p(2, 0) = p(3, 1) = -1;
  dx(0, 0) = dx(1, 1) = 1;
  EXPECT_THROW((TransverseStructure<Rational>(p, dx)), InputError);
}

TEST(DiracSubspaces, AngleAndConditions) {
  constexpr double right_angle = std::numbers::pi / 2;
  Matrix<double> j(4, 4);
  j(0, 2) = j(1, 3) = 1;
  j(2, 0) = j(3, 1) = -1;
  // q1 = 0 and cos a p1 + sin a q2 = 0: the angle is pi/2 - a, and at a = pi/2 the two commute.
  for (const double a : {0.0, 0.4, 1.2, 1.57}) {
    Matrix<double> rows(2, 4);
    rows(0, 0) = 1;
    rows(1, 2) = std::cos(a);
    rows(1, 1) = std::sin(a);
    const auto s = dirac_subspace(j, rows);
    EXPECT_TRUE(s.splits());
    EXPECT_NEAR(s.angle, right_angle - a, 4 * unit_roundoff<double>());
  }
  Matrix<double> commuting(2, 4);
  commuting(0, 0) = commuting(1, 1) = 1;
  const auto lagrangian = dirac_subspace(j, commuting);
  EXPECT_FALSE(lagrangian.meets_in_zero());
  EXPECT_TRUE(lagrangian.transversal());
  EXPECT_EQ(lagrangian.angle, 0);
  EXPECT_NE(describe(lagrangian).find("have a vector in common"), std::string::npos);
  // A Casimir's level set: nothing to meet, and not transversal to the leaves.
  const std::vector<Rational> z{1, 2, 3};
  const auto p = bracket_matrix<Rational>(LiePoissonBracket::rigid_body(), Rational(0), z);
  const auto casimir = dirac_subspace(p, Exact(1, z));
  EXPECT_TRUE(casimir.meets_in_zero());
  EXPECT_FALSE(casimir.transversal());
  EXPECT_FALSE(casimir.splits());
}

// (a) and (b) together are the splitting of the whole space, which is that W is regular.
TEST(DiracSubspaces, ConditionsAgreeWithTheRankOfTheBrackets) {
  RandomGram random(33);
  int split = 0, not_split = 0;
  for (int instance = 0; instance < 120; ++instance) {
    const std::size_t n = 5, k = random.size(1, 3);
    const Exact p = random.of_rank(Symmetry::skew, n, 2), a = random.any(k, n);
    const bool regular = determinant(a * p * a.transposed()) != Rational(0);
    EXPECT_EQ(dirac_subspace(p, a).splits(), regular);
    EXPECT_EQ(dirac_subspace(as<double>(p), as<double>(a)).splits(), regular);
    ++(regular ? split : not_split);
  }
  EXPECT_GT(split, 10);
  EXPECT_GT(not_split, 10);
}

// The reduction along P(TN^0) is the Dirac bracket; along the normals it is skew, its constraints are
// Casimirs, and it is almost Poisson only: Jacobi fails on four-dimensional level sets.
TEST(AlmostDirac, OnlyTheDiracComplementKeepsJacobi) {
  std::mt19937 random(34);
  RandomGram numbers(34);
  constexpr std::size_t n = 6;
  const Rational time(0);
  for (int instance = 0; instance < 3; ++instance) {
    const PolynomialConstraints constraints(2, n, random);
    const AlmostDiracReduction<CanonicalBracket, PolynomialConstraints, DiracComplement<CanonicalBracket>>
        poisson{{}, constraints, {}};
    const AlmostDiracReduction<CanonicalBracket, PolynomialConstraints, NormalComplement> almost{
        {}, constraints, {}};
    const DenseDiracTensor<CanonicalBracket> dirac{{}, constraints};
    std::vector<Rational> z;
    for (std::size_t k = 0; k < n; ++k) z.push_back(numbers.number() / Rational(4));
    EXPECT_TRUE(zero(bracket_matrix<Rational>(poisson, time, z) - bracket_matrix<Rational>(dirac, time, z)));
    EXPECT_EQ(jacobi_residual<Rational>(poisson, time, z).residual, Rational(0));
    const Exact p = bracket_matrix<Rational>(almost, time, z);
    EXPECT_TRUE(zero(p + p.transposed()));
    for (const Polynomial& phi : constraints.functions)
      EXPECT_EQ(casimir_residual<Rational>(almost, time, z, phi.gradient<Rational>(z)).residual, Rational(0));
    EXPECT_NE(jacobi_residual<Rational>(almost, time, z).residual, Rational(0));
  }
}
// Vectors that have nothing to do with the bracket or the constraints, so that A V is neither symmetric nor
// skew: covectors are projected with the transpose of what projects vectors.
struct ConstantComplement {
  std::vector<Rational> vectors;
  template <class T>
  void columns(const T& /*t*/, In<T> /*z*/, In<T> /*rows*/, Out<T> columns) const {
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = T(vectors[k]);
  }
};

TEST(AlmostDirac, AnyComplementMakesCasimirsOfTheConstraints) {
  std::mt19937 random(36);
  RandomGram numbers(36);
  constexpr std::size_t n = 6, count = 2;
  for (int instance = 0; instance < 3; ++instance) {
    const PolynomialConstraints constraints(count, n, random);
    ConstantComplement complement;
    for (std::size_t k = 0; k < count * n; ++k) complement.vectors.push_back(numbers.number());
    const AlmostDiracReduction<CanonicalBracket, PolynomialConstraints, ConstantComplement> reduced{
        {}, constraints, complement};
    std::vector<Rational> z;
    for (std::size_t k = 0; k < n; ++k) z.push_back(numbers.number() / Rational(4));
    const Exact p = bracket_matrix<Rational>(reduced, Rational(0), z);
    EXPECT_TRUE(zero(p + p.transposed()));
    EXPECT_FALSE(zero(p));
    for (const Polynomial& phi : constraints.functions)
      EXPECT_EQ(casimir_residual<Rational>(reduced, Rational(0), z, phi.gradient<Rational>(z)).residual,
                Rational(0));
  }
}

// Semimetric brackets stay semimetric along any complement.
TEST(AlmostDirac, KeepsTheSignOfSquares) {
  std::mt19937 random(35);
  constexpr std::size_t n = 5;
  const AlmostDiracReduction<SquaresBracket, PolynomialConstraints, NormalComplement> reduced{
      SquaresBracket(n, 3, random), PolynomialConstraints(2, n, random), {}};
  for (const auto& z : sample_points<Rational>(std::vector<Rational>(n, Rational(1)), random, 5)) {
    std::vector<std::vector<Rational>> slopes;
    for (int k = 0; k < 5; ++k) slopes.push_back(Polynomial(n, random).gradient<Rational>(z));
    EXPECT_GE(least_square<Rational>(reduced, Rational(0), z, slopes), 0);
  }
}
}  // namespace
