// Derived equations in exact rationals: every method gives what the definition of the Dirac bracket, (1.2) of
// nguyen-turski, gives with dense algebra and gradients by hand, to the last digit, off the constraints too.
#include <gtest/gtest.h>

#include <pfaff/papers/exact.hpp>

#include "derived.hpp"

namespace {

using namespace pfaff;
using namespace pfaff::testing;

struct Case {
  std::string name, system;
  Assignments settings;
  bool chain, friction;
};
const Assignments chain_settings(const std::string& beads) {
  return {{"beads", beads}, {"epsilon", "0"}, {"charge", "0"}, {"gravity", "9.81"}, {"seed", "0"}};
}
const std::vector<Case>& cases() {
  static const std::vector<Case> list{{"chain_3", "chain-molecule", chain_settings("4"), true, false}};
  return list;
}

class DerivedExactly : public ::testing::TestWithParam<Case> {};

TEST_P(DerivedExactly, EqualsTheDefinition) {
  const auto model = model_of(GetParam().system, GetParam().settings);
  const BeadRodDescription description = description_of(*model);
  ExactSamples samples(7);
  const std::vector<Rational> z = samples.point(static_cast<std::size_t>(model->dimension()));
  const DenseRods<Rational> rods(description, z);
  for (const bool friction : {false, true}) {
    if (friction && !GetParam().friction) continue;
    const auto form = [&](FrictionForm with) { return friction ? with : FrictionForm::none; };
    const std::vector<Rational> dirac = rods.dirac(friction), multipliers = rods.multipliers(friction);
    for (const char* method : {"ldl", "recursion", "recursion-literal", "bivector", "minors"}) {
      if (method == std::string("minors") && !GetParam().chain) continue;
      // Its fractions grow long; three rods are enough to see what it does.
      if (method == std::string("bivector") && model->dimension() > 24) continue;
      const Equations equations = derive(*model, method, form(FrictionForm::metriplectic));
      EXPECT_TRUE(rates_of(equations, Rational(0), z) == dirac)
          << method << (friction ? " with friction" : "");
    }
    const Equations lagrange = derive(*model, "lmm", form(FrictionForm::stokes));
    EXPECT_TRUE(rates_of(lagrange, Rational(0), z) == multipliers);
    EXPECT_FALSE(multipliers == dirac);  // off the constraints they differ
  }
  const Equations simplified = derive(*model, "simplified", FrictionForm::none);
  EXPECT_TRUE(rates_of(simplified, Rational(0), z) == rods.multipliers(false));
}

// One sum that is made a difference must be seen, wherever it stands.
TEST_P(DerivedExactly, AChangedSignIsSeen) {
  const auto model = model_of(GetParam().system, GetParam().settings);
  const BeadRodDescription description = description_of(*model);
  ExactSamples samples(8);
  const std::vector<Rational> z = samples.point(static_cast<std::size_t>(model->dimension()));
  const std::vector<Rational> expected = DenseRods<Rational>(description, z).dirac(false);
  Equations equations = derive(*model, "ldl", FrictionForm::none);
  ASSERT_TRUE(rates_of(equations, Rational(0), z) == expected);
  std::vector<std::size_t> sums;
  for (std::size_t k = 0; k < equations.tape.code.size(); ++k)
    if (equations.tape.code[k].operation == Operation::add) sums.push_back(k);
  ASSERT_GT(sums.size(), 20U);
  for (std::size_t part = 0; part < 4; ++part) {
    Operation& operation = equations.tape.code[sums[part * sums.size() / 4]].operation;
    operation = Operation::subtract;
    EXPECT_FALSE(rates_of(equations, Rational(0), z) == expected) << part;
    operation = Operation::add;
  }
}

INSTANTIATE_TEST_SUITE_P(Rods, DerivedExactly, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
