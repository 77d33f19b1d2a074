// Steps of an elimination: which pivots of a symmetric Gram matrix lose digits, and that these are not
// chosen.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/brackets/dirac/elimination.hpp>

namespace {
using namespace pfaff;

// [[e, 1, a], [1, f, b], [a, b, c]] with e and f about 2^-30. What is left of the last entry once the first
// two are eliminated is c - (f a^2 - 2 a b + e b^2)/(e f - 1), whose terms are about 1. A single pivot e
// would leave c - a^2/e first, and with it 30 bits fewer of c; the pair of both leaves them all.
TEST(Elimination, TinySinglePivotsOfSymmetricMatricesAreNotChosen) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> size(0.5, 1);
  for (int sample = 0; sample < 50; ++sample) {
    const double e = std::ldexp(size(random), -30), f = std::ldexp(size(random), -30), a = size(random),
                 b = size(random), c = std::ldexp(size(random), -28);
    Matrix<double> g(3, 3);
    g(0, 0) = e, g(1, 1) = f, g(2, 2) = c;
    g(0, 1) = g(1, 0) = 1, g(0, 2) = g(2, 0) = a, g(1, 2) = g(2, 1) = b;
    Elimination<double> elimination(g, Symmetry::symmetric, Matrix<double>(0, 0), {0, 1, 2});
    while (elimination.rows().size() > 1) elimination.eliminate(elimination.best());
    ASSERT_EQ(elimination.rows().size(), 1U);
    const std::size_t left = elimination.rows()[0];
    // The same in quad by Cramer's rule: det G over the determinant of the other two.
    const auto q = [&](std::size_t i, std::size_t j) { return Quad(g(i, j)); };
    const Quad whole = q(0, 0) * (q(1, 1) * q(2, 2) - q(1, 2) * q(2, 1)) -
                       q(0, 1) * (q(1, 0) * q(2, 2) - q(1, 2) * q(2, 0)) +
                       q(0, 2) * (q(1, 0) * q(2, 1) - q(1, 1) * q(2, 0));
    const std::size_t i = (left + 1) % 3, j = (left + 2) % 3;
    const Quad expected = whole / (q(i, i) * q(j, j) - q(i, j) * q(j, i));
    // Four roundings of terms of size 2.
    EXPECT_NEAR(elimination(left, left), static_cast<double>(expected), 1e-15) << sample;
  }
}

}  // namespace
