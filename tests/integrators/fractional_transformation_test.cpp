// The fractional transformation on random structures, random transformations alpha and random maps,
// symplectic and not: what su-qin states about it, as identities between matrices.
#include <gtest/gtest.h>

#include "generating_samples.hpp"
#include "random_matrices.hpp"

namespace pfaff {
namespace {

using testing::asymmetry;
using testing::distance;
using testing::RandomMatrices;
using testing::size_of;

// Products of up to six matrices of size 8 with entries about 1 and condition numbers below a hundred.
template <class T>
constexpr double matrix_round_off = 1e5 * static_cast<double>(unit_roundoff<T>());

template <class T>
Matrix<T> darboux_structure(std::size_t n) {  // K_c = -J
  return -canonical_structure<T>(n / 2);
}

// K = Y^T K_c Y at both times, and an alpha for it: the standard one, or the standard one followed by a
// random linear map that keeps J.
template <class T>
struct Setting {
  RandomMatrices<T> random;
  std::size_t n;
  Matrix<T> y1, y0, k, k0;
  FractionalTransformation<T> alpha, inverse_alpha;

  Setting(unsigned seed, std::size_t size, bool standard)
      : random(seed),
        n(size),
        y1(random.regular(n)),
        y0(random.regular(n)),
        k(pulled_back(darboux_structure<T>(n), y1)),
        k0(pulled_back(darboux_structure<T>(n), y0)),
        alpha(normal(T(1) / T(2) * Matrix<T>::identity(n))),
        inverse_alpha(alpha) {
    if (!standard) alpha = FractionalTransformation<T>::of(random.symplectic(2 * n) * alpha.jacobian());
    inverse_alpha = alpha.inverse_blocks(k, k0);
  }
  // w^ = -K_c (Y z' - Y0 z), w = P Y z' + (I - P) Y0 z.
  FractionalTransformation<T> normal(const Matrix<T>& p) const {
    const Matrix<T> kc = darboux_structure<T>(n), q = Matrix<T>::identity(n) - p;
    return {-(kc * y1), kc * y0, p * y1, q * y0};
  }
  // M with M^T K M = K0.
  Matrix<T> k_symplectic() { return inverse(y1) * random.symplectic(n) * y0; }
};

template <class T>
double pair_residual(const Setting<T>& s, const FractionalTransformation<T>& alpha) {
  return distance(pulled_back(canonical_structure<T>(s.n), alpha.jacobian()), pair_structure(s.k, s.k0));
}

template <class T>
class FractionalTransformationTest : public ::testing::Test {};
using TestedScalars = ::testing::Types<double, Quad>;
TYPED_TEST_SUITE(FractionalTransformationTest, TestedScalars);

template <class T, class F>
void for_every_setting(F&& check) {
  for (unsigned seed = 1; seed <= 10; ++seed)
    for (const std::size_t n : {2U, 4U})
      for (const bool standard : {true, false}) {
        Setting<T> s(seed, n, standard);
        check(s);
      }
}

TYPED_TEST(FractionalTransformationTest, AlphaCarriesThePairStructureToJ) {
  for_every_setting<TypeParam>([](Setting<TypeParam>& s) {
    EXPECT_LE(pair_residual(s, s.alpha), matrix_round_off<TypeParam>);
    // The middle matrix as printed in (35), diag(J, -J), does not serve.
    const Matrix<TypeParam> j = canonical_structure<TypeParam>(s.n / 2);
    EXPECT_GT(distance(pulled_back(pair_structure(j, j), s.alpha.jacobian()), pair_structure(s.k, s.k0)),
              1e-3);
  });
}

TYPED_TEST(FractionalTransformationTest, InverseBlocksFollowFromTheStructure) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    const auto unit = Matrix<T>::identity(2 * s.n);
    EXPECT_LE(distance(s.alpha.jacobian() * s.inverse_alpha.jacobian(), unit), matrix_round_off<T>);
    // Control: the formulas rest on (34); an alpha without it has another inverse.
    auto other = s.alpha;
    other.c = other.c + T(1) / T(1000) * s.random.any(s.n);
    EXPECT_GT(distance(other.jacobian() * other.inverse_blocks(s.k, s.k0).jacobian(), unit), 1e-6);
  });
}

TYPED_TEST(FractionalTransformationTest, RoundTripsOfAnyMap) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    for (const bool symplectic : {true, false}) {
      const Matrix<T> m = symplectic ? s.k_symplectic() : s.random.regular(s.n);
      const Matrix<T> n = s.alpha(m);
      const double tolerance = matrix_round_off<T> * (1 + size_of(n) * size_of(n));
      EXPECT_LE(distance(s.inverse_alpha(n), m), tolerance);  // (43)
      EXPECT_LE(distance(s.alpha.solved_for(n), m), tolerance);
      // The two products behind the equivalence of (38).
      const auto unit = Matrix<T>::identity(s.n);
      EXPECT_LE(distance(s.inverse_alpha.denominator(n) * s.alpha.denominator(m), unit), tolerance);
      EXPECT_LE(distance((s.alpha.a - n * s.alpha.c) * (s.inverse_alpha.a - m * s.inverse_alpha.c), unit),
                tolerance);
    }
  });
}

// M^T K M - K0 = Y^T (N^T - N) Y, Y = C M + D, for every M: N is symmetric exactly where M is symplectic.
TYPED_TEST(FractionalTransformationTest, SymmetricExactlyForSymplecticMaps) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    const Matrix<T> symplectic = s.k_symplectic();
    const Matrix<T> n = s.alpha(symplectic);
    EXPECT_LE(asymmetry(n), matrix_round_off<T> * (1 + size_of(n) * size_of(n)));

    const Matrix<T> other = symplectic + T(1) / T(100) * s.random.any(s.n);
    const Matrix<T> defect = pulled_back(s.k, other) - s.k0;
    ASSERT_GT(size_of(defect), 1e-4);
    const Matrix<T> image = s.alpha(other), y = s.alpha.denominator(other);
    EXPECT_GT(asymmetry(image), 1e-6);
    EXPECT_LE(distance(y.transposed() * (image.transposed() - image) * y, defect),
              matrix_round_off<T> * (1 + size_of(image) * size_of(image)));

    // The other way: a symmetric N gives a K-symplectic M, one that is not symmetric does not.
    const Matrix<T> symmetric = T(1) / T(5) * s.random.symmetric(s.n);
    const Matrix<T> back = s.inverse_alpha(symmetric);
    EXPECT_LE(distance(pulled_back(s.k, back), s.k0),
              matrix_round_off<T> * (1 + size_of(back) * size_of(back)));
    Matrix<T> skewed = symmetric;
    skewed(0, 1) = skewed(0, 1) + T(1) / T(100);
    EXPECT_GT(distance(pulled_back(s.k, s.inverse_alpha(skewed)), s.k0), 1e-6);
  });
}

// The four determinants of (38) are one number: |C M + D| = |alpha_*| |M C' - A'|, and the other two are
// inverses of these. So one vanishes where another does, for any M, symplectic or not.
TYPED_TEST(FractionalTransformationTest, FourConditionsAreOne) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    for (const bool symplectic : {true, false}) {
      const Matrix<T> m = symplectic ? s.k_symplectic() : s.random.regular(s.n);
      const auto [first, second, third, fourth] = transversality(s.alpha, s.inverse_alpha, m, s.alpha(m));
      const T whole = determinant(s.alpha.jacobian());
      ASSERT_GT(static_cast<double>(abs(first)), 1e-6);
      const double tolerance = matrix_round_off<T> * (1 + 1 / static_cast<double>(abs(first)));
      EXPECT_LE(static_cast<double>(abs(first - whole * second)), tolerance);
      EXPECT_LE(static_cast<double>(abs(first * third - T(1))), tolerance);
      EXPECT_LE(static_cast<double>(abs(second * fourth - T(1))), tolerance);
    }
  });
}

TYPED_TEST(FractionalTransformationTest, AndVanishTogether) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    // M with (C M + D) x = 0 for a random x: a change of rank one.
    const auto annihilated = [&](const Matrix<T>& m, const FractionalTransformation<T>& alpha) {
      Matrix<T> x(s.n, 1);
      for (std::size_t i = 0; i < s.n; ++i) x(i, 0) = s.random.number() + T(2);
      const Matrix<T> image = -(inverse(alpha.c) * alpha.d * x);
      const T square = (x.transposed() * x)(0, 0);
      return m + T(1) / square * ((image - m * x) * x.transposed());
    };
    const Matrix<T> m = annihilated(s.random.regular(s.n), s.alpha);
    const double scale =
        1 + std::pow(size_of(m) * (1 + size_of(inverse(s.alpha.c))), static_cast<double>(s.n));
    EXPECT_LE(static_cast<double>(abs(determinant(s.alpha.denominator(m)))), matrix_round_off<T> * scale);
    EXPECT_LE(static_cast<double>(abs(determinant(m * s.inverse_alpha.c - s.inverse_alpha.a))),
              matrix_round_off<T> * scale);
    // From the other side, N with C' N + D' singular.
    const Matrix<T> n = annihilated(s.random.symmetric(s.n), s.inverse_alpha);
    const double n_scale =
        1 + std::pow(size_of(n) * (1 + size_of(inverse(s.inverse_alpha.c))), static_cast<double>(s.n));
    EXPECT_LE(static_cast<double>(abs(determinant(s.inverse_alpha.denominator(n)))),
              matrix_round_off<T> * n_scale);
    EXPECT_LE(static_cast<double>(abs(determinant(n * s.alpha.c - s.alpha.a))),
              matrix_round_off<T> * n_scale);
  });
}

// A symplectic map may fail the condition: -1 as an eigenvalue in the midpoint form. It is then the image of
// no symmetric matrix, and the transformation says so with not-a-number.
TYPED_TEST(FractionalTransformationTest, ASymplecticMapWithoutGeneratingFunction) {
  using T = TypeParam;
  Setting<T> s(3, 2, true);
  const Matrix<T> m = inverse(s.y1) * (-Matrix<T>::identity(2)) * s.y0;
  EXPECT_LE(distance(pulled_back(s.k, m), s.k0), matrix_round_off<T>);
  EXPECT_LE(static_cast<double>(abs(determinant(s.alpha.denominator(m)))), matrix_round_off<T>);
  EXPECT_LE(static_cast<double>(abs(determinant(m * s.inverse_alpha.c - s.inverse_alpha.a))),
            matrix_round_off<T>);
  const Matrix<T> other = T(2) * Matrix<T>::identity(2);  // control: a regular one is finite
  EXPECT_TRUE(isfinite(largest(s.alpha(inverse(s.y1) * other * s.y0))));
}

// Normal Darboux matrices: w = P y' + (I - P) y with P = (I + V)/2 serves exactly for V in sp(n).
TYPED_TEST(FractionalTransformationTest, GeneralNormalDarbouxMatrices) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    const auto unit = Matrix<T>::identity(s.n);
    const T half = T(1) / T(2);
    const Matrix<T> v = s.random.hamiltonian(s.n);
    const auto alpha = s.normal(half * (unit + v));
    EXPECT_LE(pair_residual(s, alpha), matrix_round_off<T>);
    const Matrix<T> n = alpha(s.k_symplectic());
    EXPECT_LE(asymmetry(n), matrix_round_off<T> * (1 + size_of(n) * size_of(n) * size_of(n)));

    // Control: V not in sp(n); already a small part out of it is seen.
    Matrix<T> outside = v;
    outside(0, 0) = outside(0, 0) + T(1) / T(100);
    EXPECT_GT(pair_residual(s, s.normal(half * (unit + outside))), 1e-4);
    EXPECT_GT(pair_residual(s, s.normal(unit)), 0.1);  // V = I: w the new state alone
  });
  // The mixed forms (new q, old p) and (old q, new p) are the two with V = diag(I, -I) and its negative.
  Setting<T> s(11, 4, true);
  for (const int sign : {1, -1}) {
    Matrix<T> p(4, 4);
    for (std::size_t i = 0; i < 4; ++i) p(i, i) = T((i < 2) == (sign > 0) ? 1 : 0);
    EXPECT_LE(pair_residual(s, s.normal(p)), matrix_round_off<T>);
  }
}

// (34) is sufficient, not necessary: with c diag(K, -K0), c constant, images are Lagrangian all the same.
TYPED_TEST(FractionalTransformationTest, AConstantFactorIsLagrangianToo) {
  using T = TypeParam;
  for_every_setting<T>([](Setting<T>& s) {
    auto scaled = s.alpha;
    scaled.a = T(3) * scaled.a;
    scaled.b = T(3) * scaled.b;
    EXPECT_GT(pair_residual(s, scaled), 1);
    const Matrix<T> n = scaled(s.k_symplectic());
    EXPECT_LE(asymmetry(n), matrix_round_off<T> * (1 + size_of(n) * size_of(n)));
  });
}

TYPED_TEST(FractionalTransformationTest, MatrixInverseAndDeterminant) {
  using T = TypeParam;
  const Matrix<T> a(3, std::vector<T>{T(2), T(0), T(1), T(1), T(3), T(2), T(1), T(1), T(2)});
  EXPECT_LE(static_cast<double>(abs(determinant(a) - T(6))), matrix_round_off<T>);
  EXPECT_LE(distance(a * inverse(a), Matrix<T>::identity(3)), matrix_round_off<T>);
  const Matrix<T> singular(2, std::vector<T>{T(1), T(2), T(2), T(4)});
  EXPECT_EQ(determinant(singular), T(0));
  EXPECT_TRUE(isnan(largest(inverse(singular))));
}

}  // namespace
}  // namespace pfaff
