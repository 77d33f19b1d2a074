// Budgets end what they are in force on, and nothing else.
#include <gtest/gtest.h>

#include <thread>

#include <pfaff/core/errors/budget.hpp>

namespace {
using namespace pfaff;

// The number of steps that `spend` allows before it throws; `most` where it does not.
int taken(int most) {
  int k = 0;
  try {
    for (; k < most; ++k) spend(1, 2);
  } catch (const BudgetSpent&) {
  }
  return k;
}

TEST(Budget, NothingIsLimitedWithoutOne) { EXPECT_EQ(taken(1000), 1000); }

TEST(Budget, StepsAndEvaluationsAreLimitedEachForItself) {
  {
    const Budget steps({.steps = 10});
    EXPECT_EQ(taken(1000), 10);
  }
  const Budget evaluations({.evaluations = 10});
  EXPECT_EQ(taken(1000), 5);
}

TEST(Budget, OneWithinAnotherSpendsFromBoth) {
  Budget outer({.steps = 10});
  {
    const Budget inner({.steps = 4});
    EXPECT_EQ(taken(1000), 4);
  }
  EXPECT_EQ(outer.steps(), 4);  // the step that found the inner one empty was never taken
  {
    const Budget inner({.steps = 100});
    EXPECT_EQ(taken(1000), 6);
  }
}

TEST(Budget, IsOfItsThread) {
  const Budget here({.steps = 1});
  int elsewhere = 0;
  std::thread([&] { elsewhere = taken(100); }).join();
  EXPECT_EQ(elsewhere, 100);
}

TEST(Budget, EndsWhereItIsAskedTo) {
  std::atomic<bool> stop{false};
  const Budget outer({}, &stop);
  const Budget inner({});
  EXPECT_EQ(taken(100), 100);
  stop = true;
  try {
    spend(0, 0);
    FAIL() << "nothing was thrown";
  } catch (const BudgetSpent& end) {
    EXPECT_TRUE(end.stopped());
    EXPECT_STREQ(end.what(), "it was asked to stop");
  }
}

TEST(Budget, TakesAsManyStepsAsAreLeft) {
  Budget outer({.steps = 10});
  {
    Budget inner({.steps = 7});
    EXPECT_EQ(inner.take(5, 0), 5);
    EXPECT_EQ(inner.take(5, 0), 2);
    EXPECT_EQ(inner.take(5, 0), 0);
    EXPECT_THROW(spend(1, 0), BudgetSpent);
  }
  EXPECT_EQ(outer.steps(), 7);
  EXPECT_EQ(outer.take(100, 0), 3);
  EXPECT_EQ(outer.take(100, 0), 0);
  // Evaluations are taken in any case: they have been made.
  Budget evaluations({.evaluations = 4});
  EXPECT_EQ(evaluations.take(0, 3), 0);
  EXPECT_EQ(evaluations.evaluations(), 3);
}

TEST(Budget, TakesNothingWhereItIsAskedToStop) {
  std::atomic<bool> stop{false};
  Budget outer({}, &stop);
  Budget inner({});
  EXPECT_EQ(inner.stop(), &stop);
  EXPECT_EQ(inner.take(100, 1), 100);
  stop = true;
  EXPECT_EQ(inner.take(100, 1), 0);
  EXPECT_THROW(spend(1, 0), BudgetSpent);
}

}  // namespace
