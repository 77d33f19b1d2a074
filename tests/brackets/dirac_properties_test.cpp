// Properties of Dirac brackets of random polynomial constraints at random points off the constraint surface,
// exact in rationals: what they inherit from the base bracket, Casimirs, Jacobi (nguyen-turski Proposition 6,
// (3.20), (3.21)).
#include <gtest/gtest.h>

#include <pfaff/brackets/conformance/bracket_function.hpp>
#include <pfaff/brackets/conformance/residuals.hpp>

#include "random_gram.hpp"
#include "sample_brackets.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Point = std::vector<Rational>;

Point random_point(RandomGram& random, std::size_t n) {
  Point z;
  for (std::size_t k = 0; k < n; ++k) z.push_back(random.number() / Rational(4));
  return z;
}
template <class B>
bool regular(const DenseDiracTensor<B>& dirac, const Point& z) {
  const auto p = bracket_matrix<Rational>(dirac.base, Rational(0), z);
  Matrix<Rational> a(dirac.constraints.count(), z.size());
  for (std::size_t k = 0; k < a.rows(); ++k) {
    const auto slope = dirac.constraints.functions[k].template gradient<Rational>(z);
    for (std::size_t i = 0; i < z.size(); ++i) a(k, i) = slope[i];
  }
  return determinant(a * p * a.transposed()) != Rational(0);
}

// Symmetry, Leibniz and bilinearity are inherited by every kind; constraints are Casimirs from both sides.
TEST(DiracBrackets, InheritTheAlgebraAndKillTheConstraints) {
  std::mt19937 random(20);
  RandomGram numbers(20);
  const Rational zero(0);
  for (const Symmetry symmetry : {Symmetry::skew, Symmetry::symmetric, Symmetry::none})
    for (const std::size_t count : {2U, 4U})
      for (int instance = 0; instance < 4; ++instance) {
        constexpr std::size_t n = 6;
        const DenseDiracTensor<PolynomialBracket> dirac{PolynomialBracket(symmetry, n, random),
                                                        PolynomialConstraints(count, n, random)};
        const Point z = random_point(numbers, n);
        if (!regular(dirac, z)) continue;
        const Polynomial f(n, random), g(n, random), h(n, random);
        const auto skew = antisymmetry_residual<Rational>(dirac, zero, z, f, g);
        const auto symmetric = symmetry_residual<Rational>(dirac, zero, z, f, g);
        EXPECT_EQ(skew.residual == zero, symmetry == Symmetry::skew);
        EXPECT_EQ(symmetric.residual == zero, symmetry == Symmetry::symmetric);
        EXPECT_EQ(leibniz_residual<Rational>(dirac, zero, z, f, g, h).residual, zero);
        for (const Polynomial& phi : dirac.constraints.functions) {
          const auto slope = phi.gradient<Rational>(z);
          EXPECT_EQ(casimir_residual<Rational>(dirac, zero, z, slope).residual, zero);
          EXPECT_NE(casimir_residual<Rational>(dirac.base, zero, z, slope).residual, zero);
        }
        // {a f + b g, h} = a {f, h} + b {g, h} and in the second argument, a and b numbers.
        const auto p = bracket_matrix<Rational>(dirac, zero, z);
        const auto df = f.gradient<Rational>(z), dg = g.gradient<Rational>(z), dh = h.gradient<Rational>(z);
        const Rational a = numbers.number(), b = numbers.number();
        Point sum(n);
        for (std::size_t i = 0; i < n; ++i) sum[i] = a * df[i] + b * dg[i];
        const auto image = [&](const Point& covector) {
          return sharp_at<Rational>(dirac, zero, z, covector);
        };
        const auto left = image(sum), one = image(df), other = image(dg);
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(left[i], a * one[i] + b * other[i]);
        EXPECT_EQ(paired(sum, p, dh), a * paired(df, p, dh) + b * paired(dg, p, dh));
      }
}

// Proposition 6: where the bracket obeys Jacobi's identity the Dirac bracket does, at any point; where it
// does not, nothing is gained.
TEST(DiracBrackets, ObeyJacobiOffTheSurfaceWhereTheBracketDoes) {
  std::mt19937 random(21);
  RandomGram numbers(21);
  int checked = 0;
  for (const auto& [n, count] : {std::pair<std::size_t, std::size_t>{5, 2}, {7, 2}, {7, 4}})
    for (int instance = 0; instance < 3; ++instance) {
      const DenseDiracTensor<NambuCanonicalBracket> dirac{{Polynomial(3, random)},
                                                          PolynomialConstraints(count, n, random)};
      const Point z = random_point(numbers, n);
      if (!regular(dirac, z)) continue;
      ASSERT_EQ(jacobi_residual<Rational>(dirac.base, Rational(0), z).residual, Rational(0));
      ASSERT_EQ(jacobi_residual<Rational>(dirac, Rational(0), z).residual, Rational(0));
      // Off the surface: no constraint vanishes here.
      for (const Polynomial& phi : dirac.constraints.functions)
        EXPECT_NE(phi.operator()<Rational>(z), Rational(0));
      ++checked;
    }
  EXPECT_GE(checked, 6);
  for (int instance = 0; instance < 3; ++instance) {
    constexpr std::size_t n = 5;
    const DenseDiracTensor<PolynomialBracket> dirac{PolynomialBracket(Symmetry::skew, n, random),
                                                    PolynomialConstraints(2, n, random)};
    const Point z = random_point(numbers, n);
    ASSERT_TRUE(regular(dirac, z));
    EXPECT_NE(jacobi_residual<Rational>(dirac.base, Rational(0), z).residual, Rational(0));
    EXPECT_NE(jacobi_residual<Rational>(dirac, Rational(0), z).residual, Rational(0));
  }
}

// In double and quad to round-off of the terms, times the condition of W, which is below 1e3 at these points.
template <class T>
void expect_jacobi_to_round_off() {
  std::mt19937 random(22);
  const std::size_t n = 7;
  const DenseDiracTensor<NambuCanonicalBracket> dirac{{Polynomial(3, random)},
                                                      PolynomialConstraints(4, n, random)};
  for (const auto& z : sample_points<T>(std::vector<T>(n, T(1)), random, 20)) {
    const auto r = jacobi_residual<T>(dirac, T(0), z);
    EXPECT_LE(r.relative(), 1e3 * 64 * static_cast<double>(unit_roundoff<T>()));
  }
}
TEST(DiracBrackets, ObeyJacobiToRoundOff) {
  expect_jacobi_to_round_off<double>();
  expect_jacobi_to_round_off<Quad>();
}

// (3.21) with the sums of (3.20) holds for any skew bracket, Jacobi or not; `twist` exchanges two of its
// terms, as a control.
template <class B>
Rational expansion_defect(const B& bracket, const Point& z, std::mt19937& random, bool twist,
                          Rational& jacobi) {
  const std::size_t n = z.size();
  const Polynomial f(n, random), g(n, random), h(n, random);
  const PolynomialConstraints phi(2, n, random);
  const Polynomial &p1 = phi.functions[0], &p2 = phi.functions[1];
  const auto function = [&](const auto& a, const auto& b) { return BracketFunction(bracket, a, b); };
  const auto at = [&](const auto& x) { return x.template operator()<Rational>(z); };
  const auto value = [&](const auto& a, const auto& b) { return at(function(a, b)); };
  const auto a1 = function(f, p1), a2 = function(f, p2), b1 = function(g, p1), b2 = function(g, p2),
             c1 = function(h, p1), c2 = function(h, p2), p12 = function(p1, p2);
  const auto fg = function(f, g), fh = function(f, h), hg = function(h, g), gh = function(g, h),
             hf = function(h, f);
  const Rational i1 = value(a1, g) + value(f, b1) + value(p1, fg),
                 i2 = value(a2, g) + value(f, b2) + value(p2, fg);
  const Rational j1 = value(a1, h) + value(f, c1) + value(p1, fh),
                 j2 = value(a2, h) + value(f, c2) + value(p2, fh);
  const Rational k1 = value(c1, g) + value(h, b1) + value(p1, hg),
                 k2 = value(c2, g) + value(h, b2) + value(p2, hg);
  const Rational d = value(p2, a1) + value(a2, p1) + value(f, p12);
  const Rational e = value(p2, b1) + value(b2, p1) + value(g, p12);
  const Rational last = value(p2, c1) + value(c2, p1) + value(h, p12);
  const Rational s = Rational(1) / at(p12);
  const Rational first_order = (at(a2) * k1 - at(a1) * k2) + (at(b2) * j1 - at(b1) * j2) +
                               (twist ? at(c2) * i1 - at(c1) * i2 : at(c1) * i2 - at(c2) * i1);
  const Rational second_order = (at(a1) * at(b2) - at(a2) * at(b1)) * last +
                                (at(c1) * at(a2) - at(c2) * at(a1)) * e +
                                (at(b1) * at(c2) - at(b2) * at(c1)) * d;
  const Rational expanded =
      value(f, gh) + value(g, hf) + value(h, fg) + first_order * s + second_order * s * s;

  const DenseDiracTensor<B> dirac{bracket, phi};
  const auto gh_d = BracketFunction(dirac, g, h), hf_d = BracketFunction(dirac, h, f),
             fg_d = BracketFunction(dirac, f, g);
  jacobi = at(BracketFunction(dirac, f, gh_d)) + at(BracketFunction(dirac, g, hf_d)) +
           at(BracketFunction(dirac, h, fg_d));
  return jacobi - expanded;
}
TEST(DiracBrackets, ExpansionOfJacobiIsAnIdentity) {
  RandomGram numbers(23);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    constexpr std::size_t n =
        5;  // in four dimensions the level sets of two constraints leave Jacobi no choice
    std::mt19937 random(seed);
    const PolynomialBracket skew(Symmetry::skew, n, random);
    const Point z = random_point(numbers, n);
    std::mt19937 again = random;
    Rational jacobi;
    EXPECT_EQ(expansion_defect(skew, z, random, false, jacobi), Rational(0));
    EXPECT_NE(jacobi, Rational(0));
    EXPECT_NE(expansion_defect(skew, z, again, true, jacobi), Rational(0));
  }
}
}  // namespace
