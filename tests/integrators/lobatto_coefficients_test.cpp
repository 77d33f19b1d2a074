// Coefficients of the Lobatto IIIA-IIIB pairs against closed forms and the conditions that define them.
#include <gtest/gtest.h>

#include <string>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/integrators/constrained/lobatto_coefficients.hpp>
#include <pfaff/integrators/constrained/lobatto_stages.hpp>

namespace pfaff {
namespace {

constexpr double lobatto_round_off =
    1e-32;  // some hundred units of quad's, for the inner products of Lagrange's polynomials

double gap(Quad a, Quad b) { return static_cast<double>(abs(a - b)); }
Quad power(Quad x, int n) {
  Quad product(1);
  for (int k = 0; k < n; ++k) product *= x;
  return product;
}

TEST(LobattoCoefficients, OfTwoAndThreeStagesAreTheClosedForms) {
  const auto fraction = [](int a, int b) { return Quad(a) / Quad(b); };
  const LobattoCoefficients two = lobatto_coefficients(2), three = lobatto_coefficients(3);
  // hairer-lubich-wanner2006 tables II.1.1 and IV.2.1
  const std::vector<Quad> a2{0, 0, fraction(1, 2), fraction(1, 2)}, b2{fraction(1, 2), 0, fraction(1, 2), 0};
  const std::vector<Quad> a3{0,
                             0,
                             0,
                             fraction(5, 24),
                             fraction(1, 3),
                             fraction(-1, 24),
                             fraction(1, 6),
                             fraction(2, 3),
                             fraction(1, 6)};
  const std::vector<Quad> b3{fraction(1, 6), fraction(-1, 6), 0, fraction(1, 6), fraction(1, 3), 0,
                             fraction(1, 6), fraction(5, 6),  0};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LE(gap(two.positions[k], a2[k]), lobatto_round_off) << k;
    EXPECT_LE(gap(two.momenta[k], b2[k]), lobatto_round_off) << k;
  }
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_LE(gap(three.positions[k], a3[k]), lobatto_round_off) << k;
    EXPECT_LE(gap(three.momenta[k], b3[k]), lobatto_round_off) << k;
  }
  const LobattoCoefficients four = lobatto_coefficients(4);
  EXPECT_LE(gap(four.nodes[1], (Quad(1) - sqrt(fraction(1, 5))) / Quad(2)), lobatto_round_off);
}

TEST(LobattoCoefficients, FulfilTheirConditions) {
  for (int stages = 2; stages <= 16; ++stages) {
    const LobattoCoefficients l = lobatto_coefficients(stages);
    const auto s = static_cast<std::size_t>(stages);
    // The quadrature is exact up to degree 2 s - 3, and no further.
    for (int degree = 0; degree <= 2 * stages - 2; ++degree) {
      Quad sum(0);
      for (std::size_t i = 0; i < s; ++i) sum += l.weights[i] * power(l.nodes[i], degree);
      if (degree <= 2 * stages - 3) {
        EXPECT_LE(gap(sum, Quad(1) / Quad(degree + 1)), lobatto_round_off) << stages << ' ' << degree;
      } else if (stages <= 8) {
        EXPECT_GT(gap(sum, Quad(1) / Quad(degree + 1)), 1e-12) << stages;
      }
    }
    for (std::size_t i = 0; i < s; ++i) {
      for (std::size_t j = 0; j < s; ++j)
        EXPECT_LE(gap(l.weights[i] * l.momenta[i * s + j] + l.weights[j] * l.positions[j * s + i],
                      l.weights[i] * l.weights[j]),
                  lobatto_round_off);
      for (int degree = 0; degree < stages; ++degree) {  // IIIA collocates, IIIB to degree s - 3
        Quad a(0), b(0);
        for (std::size_t j = 0; j < s; ++j) {
          a += l.positions[i * s + j] * power(l.nodes[j], degree);
          b += l.momenta[i * s + j] * power(l.nodes[j], degree);
        }
        const Quad exact = power(l.nodes[i], degree + 1) / Quad(degree + 1);
        EXPECT_LE(gap(a, exact), lobatto_round_off) << stages;
        if (degree <= stages - 3) {
          EXPECT_LE(gap(b, exact), 10 * lobatto_round_off) << stages << ' ' << degree;
        }
      }
      EXPECT_EQ(l.positions[i], Quad(0));
      EXPECT_LE(gap(l.positions[(s - 1) * s + i], l.weights[i]), lobatto_round_off);
      EXPECT_EQ(l.momenta[i * s + s - 1], Quad(0));
    }
  }
}

TEST(LobattoCoefficients, MultipliersInvertTheProduct) {
  for (int stages = 2; stages <= 16; ++stages) {
    const LobattoCoefficients l = lobatto_coefficients(stages);
    const auto s = static_cast<std::size_t>(stages);
    Quad largest(0);
    for (const Quad& x : l.multipliers) largest = std::max(largest, abs(x));
    for (std::size_t i = 1; i < s; ++i)
      for (std::size_t m = 1; m < s; ++m) {
        Quad sum(0);
        for (std::size_t j = 0; j < s; ++j)
          for (std::size_t k = 0; k + 1 < s; ++k)
            sum += l.positions[i * s + j] * l.momenta[j * s + k] * l.multipliers[k * (s - 1) + m - 1];
        EXPECT_LE(gap(sum, Quad(i == m ? 1 : 0)), lobatto_round_off * static_cast<double>(largest)) << stages;
      }
  }
}

// G A^ = 1; the rows of G are those of W combined, weights times polynomials of degree s - 2; and W A^ has
// its closed form.
TEST(LobattoCoefficients, MultipliersOfVelocityConstraintsFulfilTheirConditions) {
  for (int stages = 2; stages <= 4; ++stages) {
    const LobattoCoefficients l = lobatto_coefficients(stages);
    const auto s = static_cast<std::size_t>(stages);
    const std::vector<Quad> g = velocity_multipliers(l);
    Quad largest(0);
    for (const Quad& x : g) largest = std::max(largest, Quad(abs(x)));
    const double bound = lobatto_round_off * static_cast<double>(largest);
    for (std::size_t j = 0; j + 1 < s; ++j) {
      for (std::size_t m = 0; m + 1 < s; ++m) {
        Quad sum(0);
        for (std::size_t i = 0; i < s; ++i) sum += g[j * s + i] * l.momenta[i * s + m];
        EXPECT_LE(gap(sum, Quad(j == m ? 1 : 0)), bound) << stages;
      }
      // The divided difference of order s - 1 of g_ji/b_i over all nodes.
      Quad difference(0), size(0);
      for (std::size_t i = 0; i < s; ++i) {
        Quad product(1);
        for (std::size_t k = 0; k < s; ++k)
          if (k != i) product *= l.nodes[i] - l.nodes[k];
        const Quad term = g[j * s + i] / (l.weights[i] * product);
        difference += term;
        size = std::max(size, Quad(abs(term)));
      }
      EXPECT_LE(gap(difference, Quad(0)), lobatto_round_off * static_cast<double>(size)) << stages;
    }
    for (int k = 1; k < stages; ++k)
      for (std::size_t j = 0; j + 1 < s; ++j) {
        Quad sum(0);
        for (std::size_t i = 0; i < s; ++i)
          sum += l.weights[i] * power(l.nodes[i], k - 1) * l.momenta[i * s + j];
        EXPECT_LE(gap(sum, l.weights[j] * (Quad(1) - power(l.nodes[j], k)) / Quad(k)), lobatto_round_off)
            << stages;
      }
  }
  EXPECT_LE(gap(velocity_multipliers(lobatto_coefficients(2))[1], Quad(1)), lobatto_round_off);  // (1, 1)
}

// mu^_ij + mu_ji = 1 in the numbers that steps are made of, which are no further from those of the pair than
// one spacing at 2 and one rounding. The control: numbers that are rounded one by one miss it.
template <class T>
void expect_exactly_symplectic(int stages, double spacing) {
  const LobattoCoefficients pair = lobatto_coefficients(stages);
  const LobattoStages<T> rounded(pair, 1, 1);
  const auto s = static_cast<std::size_t>(stages);
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < s; ++j) {
      SCOPED_TRACE(std::to_string(stages) + " stages, " + std::to_string(i) + ", " + std::to_string(j));
      const T mu = rounded.mu[i * s + j];
      EXPECT_TRUE(rounded.mu_hat[j * s + i] + mu == T(1));
      EXPECT_TRUE(T(1) - rounded.mu_hat[j * s + i] == mu) << "the difference is not rounded";
      EXPECT_TRUE(T(2) * mu > T(-1) && T(2) * mu < T(3)) << "where 5/2 + mu lies between 2 and 4";
      EXPECT_LE(gap(Quad(mu), pair.positions[i * s + j] / pair.weights[j]), spacing);
    }
}
TEST(LobattoStages, ArePreciselySymplectic) {
  int missed = 0;
  for (int stages = 2; stages <= 16; ++stages) {
    expect_exactly_symplectic<double>(stages, 0x1p-51);
    expect_exactly_symplectic<Quad>(stages, 0x1p-100);
    const LobattoCoefficients pair = lobatto_coefficients(stages);
    const auto s = static_cast<std::size_t>(stages);
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t j = 0; j < s; ++j)
        missed += static_cast<double>(pair.positions[i * s + j] / pair.weights[j]) +
                              static_cast<double>(pair.momenta[j * s + i] / pair.weights[i]) !=
                          1
                      ? 1
                      : 0;
  }
  EXPECT_GT(missed, 100);
}

}  // namespace
}  // namespace pfaff
