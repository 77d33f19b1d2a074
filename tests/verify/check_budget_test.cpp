// A check that has used up its budget is not judged: it is neither a pass nor a failure.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/verify/check_budget.hpp>

#include "judged.hpp"

namespace pfaff {
namespace {
using testing::bad;
using testing::Classical;

Check named_check() {
  Check check;
  check.plugin = "some-method";
  check.claim = "symmetric";
  return check;
}
Check with(CheckResult result) {
  Check check = named_check();
  check.result = result;
  return check;
}
[[noreturn]] Check endless() {
  for (;;) spend(1, 1);
}

TEST(CheckBudget, WhatRunsOutIsNotJudged) {
  const Check check = within_budget(named_check(), endless, {.steps = 10});
  EXPECT_EQ(check.result, CheckResult::skipped);
  EXPECT_EQ(check.plugin, "some-method");
  EXPECT_EQ(check.reason, "not judged: the budget of 10 steps has run out");
  EXPECT_TRUE(good(check));
  // A control is good only where it is rejected.
  Check control = named_check();
  control.control = true;
  EXPECT_FALSE(good(within_budget(control, endless, {.steps = 10})));
}

// Negative control: what is judged within the budget keeps its result.
TEST(CheckBudget, WhatDoesNotRunOutIsJudged) {
  for (const CheckResult result : {CheckResult::pass, CheckResult::fail}) {
    const Check check = within_budget(named_check(), [&] { return with(result); }, {.steps = 10});
    EXPECT_EQ(check.result, result);
    EXPECT_EQ(check.reason, "");
  }
}

TEST(CheckBudget, SomebodyWhoAsksForTheEndGetsNoCheck) {
  const std::atomic<bool> stop{true};
  const Budget budget({}, &stop);
  EXPECT_THROW((void)within_budget(named_check(), endless), BudgetSpent);
}

// The classical method, which is right, and the same with a step that goes on for ever in double.
struct Endless : Classical<false> {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if constexpr (std::is_same_v<Scalar<P>, double>)
      if (Budget::current() != nullptr)
        for (;;) spend(0, 1000);
    return Classical<false>::step(p, t, h, z, w);
  }
};
MethodDescriptor described_as(const std::string& name) {
  return {.name = name, .title = "t", .reference = "r", .order = 4, .preserves = {Claim::none}};
}

std::vector<Check> checks_of(const MethodPlugin& plugin) {
  const auto model = systems().get("pendulum", "system").make({});
  return check_method(*plugin.make({}), {}, "pendulum", model);
}

TEST(CheckBudget, AMethodThatNeverEndsIsNeverJudged) {
  static const Method<Classical<false>> right{described_as("ends")};
  static const Method<Endless> endless_one{described_as("never-ends")};
  const std::vector<Check> sound = checks_of(right);
  EXPECT_GT(std::count_if(sound.begin(), sound.end(),
                          [](const Check& check) { return check.result == CheckResult::pass; }),
            2);
  EXPECT_EQ(bad(sound), testing::Names{});
  const std::vector<Check> checks = checks_of(endless_one);
  ASSERT_FALSE(checks.empty());
  for (const Check& check : checks) {
    EXPECT_EQ(check.result, CheckResult::skipped) << check.claim;
    EXPECT_TRUE(check.reason.starts_with("not judged: the budget of ")) << check.reason;
  }
}

}  // namespace
}  // namespace pfaff
