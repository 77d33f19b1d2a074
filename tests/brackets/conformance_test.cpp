// The matchers with which authors test their brackets: registered brackets pass them, and each matcher fails
// a bracket that is made to fail it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/conformance/matchers.hpp>
#include <pfaff/brackets/constant_poisson.hpp>
#include <pfaff/brackets/lie_poisson.hpp>

#include "sample_brackets.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using ::testing::Not;

const BracketSamples in_three{.centre = {Quad(1), Quad(-2), Quad(0.5)}};
const BracketSamples in_four{.centre = {Quad(1), Quad(-2), Quad(0.5), Quad(3)}};

// The canonical bracket spoilt by one term in one entry.
struct Spoilt {
  std::function<Quad(Quad)> term;
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    CanonicalBracket{}.sharp(t, z, covector, vector);
    if constexpr (std::is_same_v<T, Quad>) vector[0] = vector[0] + term(covector[0]);
  }
};
const auto squared_radius = [](In<Quad> z, Out<Quad> slope) { std::copy(z.begin(), z.end(), slope.begin()); };
const auto first_coordinate = [](In<Quad>, Out<Quad> slope) { slope[0] = Quad(1); };

TEST(Matchers, PoissonBracketsPass) {
  const auto rigid = LiePoissonBracket::rigid_body();
  EXPECT_THAT(rigid, IsSkew(in_three));
  EXPECT_THAT(rigid, ObeysLeibniz(in_three));
  EXPECT_THAT(rigid, ObeysJacobi(in_three));
  EXPECT_THAT(rigid, HasCasimir(in_three, squared_radius));
  EXPECT_THAT(CanonicalBracket{}, IsSkew(in_four));
  EXPECT_THAT(CanonicalBracket{}, ObeysJacobi(in_four));
  std::mt19937 random(1);
  const NambuCanonicalBracket nambu{Polynomial(3, random)};
  const BracketSamples in_five{.centre = std::vector<Quad>(5, Quad(1))};
  EXPECT_THAT(nambu, IsSkew(in_five));
  EXPECT_THAT(nambu, ObeysJacobi(in_five));
}

TEST(Matchers, SkewFailsForSymmetricPartsOfOneInAMillionMillion) {
  EXPECT_THAT((Spoilt{[](Quad f) { return Quad(1e-20) * f; }}), Not(IsSkew(in_four)));
  EXPECT_THAT((Spoilt{[](Quad) { return Quad(0); }}), IsSkew(in_four));
}
TEST(Matchers, LeibnizFailsForMapsThatAreNotLinear) {
  EXPECT_THAT((Spoilt{[](Quad f) { return Quad(1e-6) * f * f; }}), Not(ObeysLeibniz(in_four)));
  EXPECT_THAT((Spoilt{[](Quad f) { return Quad(3) * f; }}), ObeysLeibniz(in_four));
}
TEST(Matchers, JacobiFailsForSkewBracketsThatAreNotPoisson) {
  std::mt19937 random(2);
  const PolynomialBracket skew(Symmetry::skew, 4, random);
  EXPECT_THAT(skew, IsSkew(in_four));
  EXPECT_THAT(skew, Not(ObeysJacobi(in_four)));
  // Structure constants that are no Lie algebra's: {z1, z2} = z3, {z2, z3} = z2.
  const LiePoissonBracket no_algebra{{{0, 1, 2, 1}, {1, 2, 1, 1}}, 1};
  EXPECT_THAT(no_algebra, Not(ObeysJacobi(in_three)));
}
TEST(Matchers, CasimirsFailForOtherFunctions) {
  EXPECT_THAT(LiePoissonBracket::rigid_body(), Not(HasCasimir(in_three, first_coordinate)));
  EXPECT_THAT(CanonicalBracket{}, Not(HasCasimir(in_four, first_coordinate)));
}
TEST(Matchers, SymmetricAndNonNegative) {
  std::mt19937 random(3);
  const SquaresBracket squares(4, 2, random);
  EXPECT_THAT(squares, IsSymmetric(in_four));
  EXPECT_THAT(squares, IsNonNegative(in_four));
  const PolynomialBracket general(Symmetry::none, 4, random), indefinite(Symmetry::symmetric, 4, random);
  EXPECT_THAT(general, Not(IsSymmetric(in_four)));
  EXPECT_THAT(indefinite, IsSymmetric(in_four));
  EXPECT_THAT(indefinite, Not(IsNonNegative(in_four)));
  EXPECT_THAT(CanonicalBracket{}, Not(IsSymmetric(in_four)));
}
TEST(Matchers, AFailureSaysWhereAndByHowMuch) {
  ::testing::StringMatchResultListener listener;
  std::mt19937 random(2);
  const PolynomialBracket skew(Symmetry::skew, 4, random);
  EXPECT_FALSE(::testing::ExplainMatchResult(ObeysJacobi(in_four), skew, &listener));
  EXPECT_THAT(listener.str(), ::testing::HasSubstr("{f, {g, h}} + cyclic: residual "));
  EXPECT_THAT(listener.str(), ::testing::HasSubstr(" of its terms at ("));
}
TEST(Matchers, NumbersThatAreNotFiniteFail) {
  EXPECT_THAT((Spoilt{[](Quad) { return std::numeric_limits<Quad>::quiet_NaN(); }}), Not(IsSkew(in_four)));
}
}  // namespace
