// A method whose steps are exact on a motion has no error there from which an order could be measured: the
// check of its order is out of its scope on that motion, and neither passes nor fails.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/verify/check.hpp>

namespace {
using namespace pfaff;

// Two bodies have one Kepler orbit and an interaction of nothing, so that splittings into the two are exact.
std::shared_ptr<const Model> two_bodies() {
  return systems().get("n-body", "system").make({{"bodies", "2"}});
}
Check exact_order_check(const char* name) {
  const auto method = integrators().get(name, "integrator").make({});
  const auto checks = check_method(*method, {}, "n-body", two_bodies());
  const auto order =
      std::find_if(checks.begin(), checks.end(), [](const Check& c) { return c.claim == "order"; });
  return order == checks.end() ? Check{} : *order;
}

TEST(OrderOfExactSteps, IsNotJudged) {
  const Check order = exact_order_check("exact-flow-splitting");
  ASSERT_EQ(order.claim, "order");
  EXPECT_FALSE(order.in_scope);
  EXPECT_NE(order.result, CheckResult::fail);
  EXPECT_NE(order.reason.find("exact on this motion"), std::string::npos) << order.reason;
}

// The control: a method that is not exact on the same motion is judged.
TEST(OrderOfExactSteps, StepsWithErrorsAreJudged) {
  const Check order = exact_order_check("verlet");
  EXPECT_TRUE(order.in_scope);
  EXPECT_EQ(order.result, CheckResult::pass);
  EXPECT_NEAR(order.measured, 2, 0.1);
}
}  // namespace
