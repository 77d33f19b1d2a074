// Base brackets and their combinations: each passes the claims made about it, and beside it one that must
// fail them does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/combinations.hpp>
#include <pfaff/brackets/conformance/matchers.hpp>
#include <pfaff/brackets/constant_poisson.hpp>
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/brackets/metriplectic.hpp>
#include <pfaff/brackets/symmetric.hpp>
#include <pfaff/brackets/tensor.hpp>

namespace {
using namespace pfaff;
using ::testing::Not;

BracketSamples samples_in(std::size_t n) {
  BracketSamples s;
  for (std::size_t k = 0; k < n; ++k) s.centre.emplace_back(static_cast<double>(k + 1) / 3);
  return s;
}

// Gradients of Casimirs.
void square_of_first_three(In<Quad> z, Out<Quad> slope) {
  for (std::size_t a = 0; a < 3; ++a) slope[a] = Quad(2) * z[a];
}
void killing_form(In<Quad> z, Out<Quad> slope) {
  slope[0] = Quad(2) * z[0];
  slope[1] = Quad(4) * z[2];
  slope[2] = Quad(4) * z[1];
}

TEST(LiePoisson, AlgebrasAndTheirCasimirs) {
  EXPECT_EQ(LiePoissonBracket::so3().algebra_residual(3), 0);
  EXPECT_EQ(LiePoissonBracket::se3().algebra_residual(6), 0);
  EXPECT_EQ(LiePoissonBracket::sl2().algebra_residual(3), 0);
  EXPECT_THAT(LiePoissonBracket::so3(), ObeysJacobi(samples_in(3)));
  EXPECT_THAT(LiePoissonBracket::se3(-1), ObeysJacobi(samples_in(6)));
  EXPECT_THAT(LiePoissonBracket::sl2(), ObeysJacobi(samples_in(3)));
  EXPECT_THAT(LiePoissonBracket::so3(), HasCasimir(samples_in(3), &square_of_first_three));
  EXPECT_THAT(LiePoissonBracket::sl2(), HasCasimir(samples_in(3), &killing_form));
  EXPECT_THAT(LiePoissonBracket::sl2(), Not(HasCasimir(samples_in(3), &square_of_first_three)));
}
TEST(LiePoisson, OtherConstantsAreNoAlgebra) {
  const LiePoissonBracket wrong{{{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 0, 1}}, 1};
  EXPECT_GT(wrong.algebra_residual(3), 0.5);
  EXPECT_THAT(wrong, IsSkew(samples_in(3)));
  EXPECT_THAT(wrong, Not(ObeysJacobi(samples_in(3))));
}

TEST(Combinations, AddSharpMaps) {
  const auto magnetic = tensor_bracket([](const auto&, auto z, auto entries) {  // B(x, y) dp_x ^ dp_y
    entries[2 * 4 + 3] = z[0] * z[1];
    entries[3 * 4 + 2] = -(z[0] * z[1]);
  });
  // Canonical plus magnetic is Poisson in the plane; twice it too; and skew minus symmetric is neither.
  EXPECT_THAT(sum(CanonicalBracket{}, magnetic), ObeysJacobi(samples_in(4)));
  EXPECT_THAT(scaled(2, sum(CanonicalBracket{}, magnetic)), ObeysJacobi(samples_in(4)));
  const auto friction = friction_bracket([](const auto&, auto z, auto lambda) {
    for (std::size_t k = 0; k < lambda.size(); ++k) lambda[k] = z[k] * z[k];
  });
  EXPECT_THAT(friction, IsSymmetric(samples_in(4)));
  EXPECT_THAT(friction, IsNonNegative(samples_in(4)));
  EXPECT_THAT(difference(CanonicalBracket{}, friction), Not(IsSkew(samples_in(4))));
  EXPECT_THAT(difference(CanonicalBracket{}, friction), Not(IsSymmetric(samples_in(4))));
  EXPECT_THAT(difference(CanonicalBracket{}, friction), ObeysLeibniz(samples_in(4)));
}
// Each obeys Jacobi, their sum does not: a.curl a = -2 for a = (y, -x, 1).
TEST(Combinations, SumsOfPoissonBracketsNeedNotBePoisson) {
  const auto turning = tensor_bracket([](const auto&, auto z, auto entries) {
    entries[5] = z[1];
    entries[7] = -z[1];
    entries[6] = -z[0];
    entries[2] = z[0];
  });
  const ConstantBracket upright{3, {0, 1, 0, -1, 0, 0, 0, 0, 0}};
  EXPECT_THAT(turning, ObeysJacobi(samples_in(3)));
  EXPECT_THAT(upright, ObeysJacobi(samples_in(3)));
  EXPECT_THAT(sum(turning, upright), Not(ObeysJacobi(samples_in(3))));
}

TEST(Symmetric, SquaresAreSemimetricAndOtherSignaturesAreNot) {
  const auto square = square_bracket(2, [](const auto&, auto z, auto c) {
    c[0] = z[0];
    c[1] = z[1] * z[2];
    c[2] = z[2];
    c[5] = z[0];
  });
  EXPECT_THAT(square, IsSymmetric(samples_in(3)));
  EXPECT_THAT(square, IsNonNegative(samples_in(3)));
  const ConstantBracket lorentz{3, {1, 0, 0, 0, 1, 0, 0, 0, -1}};
  EXPECT_THAT(lorentz, IsSymmetric(samples_in(3)));
  EXPECT_THAT(lorentz, Not(IsNonNegative(samples_in(3))));
}

// The relaxing rigid body: energy conserved, entropy |z|^2/2 rising; with another entropy the pair is not
// degenerate.
TEST(Metriplectic, EnergyAndEntropy) {
  const auto relaxation = tensor_bracket([](const auto&, auto z, auto g) {
    using T = std::decay_t<decltype(z[0] * z[0])>;
    const std::array<T, 3> w{z[0] / T(2), z[1], z[2] / T(3)};
    const T square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) g[3 * i + j] = (i == j ? square : T(0)) - w[i] * w[j];
  });
  const auto pair = metriplectic(LiePoissonBracket::rigid_body(), relaxation);
  const std::vector<double> z{0.3, -0.8, 0.5}, energy{0.15, -0.8, 0.5 / 3}, entropy = z, other{1, 0, 0};
  const auto [of_entropy, of_energy] = pair.degeneracy<double>(0.0, z, energy, entropy);
  EXPECT_LE(of_entropy, 1e-16);  // products of numbers below 1, two of them subtracted
  EXPECT_LE(of_energy, 1e-16);
  EXPECT_GT(pair.degeneracy<double>(0.0, z, energy, other).first, 0.1);
  std::vector<double> rate(3), falling(3);
  pair.entropy_field<double>(0.0, z, energy, entropy, rate);
  EXPECT_NEAR(rate[0] * energy[0] + rate[1] * energy[1] + rate[2] * energy[2], 0, 1e-16);
  EXPECT_GT(rate[0] * entropy[0] + rate[1] * entropy[1] + rate[2] * entropy[2], 1e-3);
  // With a free energy that is no null covector of G, it falls.
  pair.free_energy_field<double>(0.0, z, other, falling);
  EXPECT_LT(falling[0], -0.1);
}

}  // namespace
