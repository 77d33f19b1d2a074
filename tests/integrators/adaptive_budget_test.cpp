// Methods that choose their steps end between two of them where their budget does, in the state that they
// have reached.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

#include "adaptive_samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Growth;
using pfaff::testing::sample_of;

std::vector<std::unique_ptr<MethodInstance>> adaptive_methods() {
  std::vector<std::unique_ptr<MethodInstance>> methods;
  for (const MethodPlugin* plugin : integrators().all())
    if (auto method = plugin->make({}); method->adaptive()) methods.push_back(std::move(method));
  return methods;
}

TEST(AdaptiveBudget, EndsInTheStateReached) {
  std::size_t tried = 0;
  for (const auto& method : adaptive_methods())
    for (const double end : {100.0, -100.0}) {
      SCOPED_TRACE(method->called());
      const auto stepper = method->stepper(sample_of(Growth{}), double());
      std::vector<double> z{1};
      double t = 0;
      const Budget budget({.steps = 20});
      EXPECT_THROW((void)stepper->advance_to(t, end, 1e-6, z), BudgetSpent);
      EXPECT_EQ(stepper->counters().steps, 20);
      EXPECT_TRUE(t / end > 0 && t / end < 1) << t;
      // The state belongs to the time: z' = z, to twenty errors of the tolerance.
      EXPECT_NEAR(z[0], std::exp(t), 1e-4 * std::max(1.0, std::exp(t)));
      ++tried;
    }
  EXPECT_GE(tried, 6U);
}

TEST(AdaptiveBudget, CountsEvaluations) {
  for (const auto& method : adaptive_methods()) {
    SCOPED_TRACE(method->called());
    const auto stepper = method->stepper(sample_of(Growth{}), double());
    std::vector<double> z{1};
    double t = 0;
    Budget budget({.evaluations = 200});
    EXPECT_THROW((void)stepper->advance_to(t, 1e6, 1e-6, z), BudgetSpent);
    EXPECT_EQ(budget.evaluations(), stepper->counters().fields);
    EXPECT_GT(budget.evaluations(), 200);
    EXPECT_LT(budget.evaluations(), 400);  // by no more than the last step
  }
}

TEST(AdaptiveBudget, EndsBeforeTheFirstStepWhereItIsAskedToStop) {
  const std::atomic<bool> stop{true};
  for (const auto& method : adaptive_methods()) {
    SCOPED_TRACE(method->called());
    const auto stepper = method->stepper(sample_of(Growth{}), double());
    std::vector<double> z{1};
    double t = 0;
    const Budget budget({}, &stop);
    EXPECT_THROW((void)stepper->advance_to(t, 1, 1e-6, z), BudgetSpent);
    EXPECT_EQ(t, 0);
    EXPECT_EQ(z[0], 1);
    EXPECT_EQ(stepper->counters().steps, 0);
  }
}

}  // namespace
