// The checks of order conditions that verification makes of a method's own coefficients.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/order_conditions/rooted_trees.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/verify/check.hpp>

namespace {
using namespace pfaff;

TEST(CoefficientChecks, EveryFamilyWhoseTheoryIsKnownPassesAndItsControlsAreRejected) {
  const std::vector<std::pair<std::string, int>> known{
      {"rk4", 10},        {"gauss", 6},    {"implicit-midpoint", 2}, {"verlet", 3}, {"symplectic-euler", 2},
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

// The weights of yoshida's composition of order 4, with their conditions up to `order` only.
Check control_with_conditions_up_to(const char* method, int order) {
  const KnownOrderTheory known{method, [order](const Assignments& /*parameters*/) {
                                 return OrderTheory{"words", 4, yoshida_weights(4),
                                                    [order](const std::vector<Quad>& weights) {
                                                      return composition_conditions(weights, order);
                                                    }};
                               }};
  return check_coefficients(integrators().get(method, ""), {}).at(1);
}

TEST(CoefficientChecks, ControlsFindConditionsAboveOrder1ThatAreNotEvaluated) {
  const Check complete = control_with_conditions_up_to("gni", 4);
  EXPECT_EQ(complete.claim, "conditions with coefficient 0 changed by 1e-9 and coefficient 1 by -1e-9");
  EXPECT_EQ(complete.result, CheckResult::rejected);
  EXPECT_TRUE(good(complete));
  const Check missing = control_with_conditions_up_to("dla", 1);
  EXPECT_EQ(missing.result, CheckResult::pass);
  EXPECT_FALSE(good(missing));
}

// The conditions of order 1 alone, whatever order is asked for.
TEST(CoefficientChecks, EntriesOfAAreFoundByConditionsAboveOrder1Only) {
  const KnownOrderTheory blind{
      "nonholonomic-lobatto", [](const Assignments& /*parameters*/) {
        OrderTheory theory =
            tree_theory({{Quad(0), Quad(0), Quad(0.5), Quad(0)}, {Quad(0), Quad(1)}}, 2, true);
        theory.conditions = [all = theory.conditions](const std::vector<Quad>& numbers) {
          std::vector<OrderCondition> list = all(numbers);
          std::erase_if(list, [](const OrderCondition& c) { return c.order > 1; });
          return list;
        };
        return theory;
      }};
  const std::vector<Check> checks = check_coefficients(integrators().get("nonholonomic-lobatto", ""), {});
  ASSERT_EQ(checks.size(), 4U);  // b and the one entry of a
  EXPECT_TRUE(good(checks.front()));
  for (std::size_t k = 1; k < checks.size(); ++k) EXPECT_FALSE(good(checks[k])) << checks[k].claim;
}

// In Merson's method the stage that reads a_21 has no weight, and those that read it cancel up to order 4.
TEST(CoefficientChecks, EntriesOfAThatNoConditionReadsAreLeftOut) {
  const Quad zero(0), one(1), three(3), six(6), eight(8);
  const RungeKuttaTableau<Quad> merson{{zero,
                                        zero,
                                        zero,
                                        zero,
                                        zero,
                                        one / three,
                                        zero,
                                        zero,
                                        zero,
                                        zero,
                                        one / six,
                                        one / six,
                                        zero,
                                        zero,
                                        zero,
                                        one / eight,
                                        zero,
                                        three / eight,
                                        zero,
                                        zero,
                                        one / Quad(2),
                                        zero,
                                        -three / Quad(2),
                                        Quad(2),
                                        zero},
                                       {one / six, zero, zero, Quad(2) / three, one / six}};
  const OrderTheory theory = tree_theory(merson, 4, true);
  EXPECT_EQ(theory.coefficients.size(), 5U + 9U);
  EXPECT_EQ(first_violated(theory.conditions(theory.coefficients), 4, theory.precision), nullptr);
  EXPECT_TRUE(tree_theory(merson, 1, true).sums == std::vector<int>(5, 0));
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
