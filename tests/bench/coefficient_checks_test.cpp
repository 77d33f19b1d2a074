// The checks of order conditions that verification makes of a method's own coefficients.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace {
using namespace pfaff;

TEST(CoefficientChecks, EveryFamilyWhoseTheoryIsKnownPassesAndItsControlsAreRejected) {
  const std::vector<std::pair<std::string, int>> known{
      {"rk4", 10},        {"gauss", 2},    {"implicit-midpoint", 1}, {"verlet", 3}, {"symplectic-euler", 2},
      {"composition", 3}, {"leap-frog", 2}};
  for (const auto& [name, coefficients] : known) {
    const MethodPlugin& plugin = integrators().get(name, "integrator");
    const std::vector<Check> checks = check_coefficients(plugin, {});
    ASSERT_EQ(checks.size(), static_cast<std::size_t>(coefficients) + 1) << name;
    EXPECT_EQ(checks.front().result, CheckResult::pass) << name << ": " << checks.front().reason;
    for (const Check& check : checks) {
      EXPECT_TRUE(good(check)) << name << ": " << check.claim;
      EXPECT_EQ(check.control, &check != &checks.front());
    }
  }
}

TEST(CoefficientChecks, EveryVerifiedInstanceOfThemPasses) {
  for (const char* name : {"gauss", "composition"}) {
    const MethodPlugin& plugin = integrators().get(name, "integrator");
    for (const Assignments& parameters : plugin.instances(true)) {
      // The weights of compositions are the same over all bases.
      if (std::find(parameters.begin(), parameters.end(),
                    std::pair<std::string, std::string>("base", "rattle")) == parameters.end() &&
          plugin.name() == "composition")
        continue;
      for (const Check& check : check_coefficients(plugin, parameters))
        EXPECT_TRUE(good(check)) << name << ": " << check.claim << " " << check.measured << " "
                                 << check.reason;
    }
  }
}

TEST(CoefficientChecks, ACoefficientThatIsWrongBy1e9Fails) {
  const KnownOrderTheory wrong{
      "rattle", [](const Assignments& /*parameters*/) {
        return OrderTheory{
            "words", 4, {Quad(0.25), Quad(0.5 + 1e-9), Quad(0.25)}, [](const std::vector<Quad>& weights) {
              return composition_conditions(weights, 2);
            }};
      }};
  const std::vector<Check> checks = check_coefficients(integrators().get("rattle", ""), {});
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_EQ(checks.front().result, CheckResult::fail);
  EXPECT_NE(checks.front().reason.find("the Lie word Y1 = 1, a condition of order 1, is off by 1.00e-09"),
            std::string::npos)
      << checks.front().reason;
  EXPECT_TRUE(check_coefficients(integrators().get("shake", ""), {}).empty());
}

TEST(CoefficientChecks, AResidualThatIsNoNumberFailsWhateverFollowsIt) {
  const KnownOrderTheory broken{"lincs", [](const Assignments& /*parameters*/) {
                                  return OrderTheory{
                                      "words", 1, {Quad(1)}, [](const std::vector<Quad>& /*weights*/) {
                                        return std::vector<OrderCondition>{
                                            {"the first", 1, Quad(0)},
                                            {"the second", 1, Quad(std::numeric_limits<double>::quiet_NaN())},
                                            {"the third", 1, Quad(0)}};
                                      }};
                                }};
  const Check check = check_coefficients(integrators().get("lincs", ""), {}).at(0);
  EXPECT_EQ(check.result, CheckResult::fail);
  EXPECT_TRUE(std::isnan(check.measured));
  EXPECT_EQ(check.reason.find("the second"), 0U) << check.reason;
}

}  // namespace
