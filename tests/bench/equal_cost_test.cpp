// The choice of steps at which methods cost the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pfaff/bench/experiment/equal_cost.hpp>

namespace {
using namespace pfaff;

// A method of order `order` whose run costs `unit` / h and errs by `error` h^order.
PricedRuns method(double unit, double error, int order) {
  PricedRuns runs;
  for (const double h : {0.4, 0.2, 0.1, 0.05}) runs.push_back({h, unit / h, error * std::pow(h, order)});
  return runs;
}

TEST(EqualCost, AStepIsFoundOnTheLineOfCosts) {
  const PricedRuns runs = method(1e4, 1, 4);  // 25 µs to 200 µs
  EXPECT_NEAR(size_at_cost(runs, 5e4), 0.2, 1e-15);
  EXPECT_NEAR(size_at_cost(runs, 7e4), 1e4 / 7e4, 1e-15);  // cost is 1/h, which is straight in logarithms
  EXPECT_EQ(size_at_cost(runs, 2.4e4), 0);
  EXPECT_EQ(size_at_cost(runs, 2.1e5), 0);
}

TEST(EqualCost, ADisturbedTimingOfACoarseRunIsLowered) {
  PricedRuns runs = method(1e4, 1, 4);
  std::swap(runs[0], runs[3]);  // in any order
  runs[2].cost = 9e5;           // of h = 0.1, above that of h = 0.05
  settle(runs);
  EXPECT_EQ(runs[0].size, 0.4);
  EXPECT_EQ(runs[2].cost, runs[3].cost);
  EXPECT_EQ(runs[1].cost, 5e4);
}

// Two methods span 25 to 200 and 50 to 400 µs; of 50, 100 and 200 µs, which both span, the level is the one
// next to what the error 1e-6 costs at least.
TEST(EqualCost, TheLevelIsWhereMostMethodsAreAndNearTheBest) {
  const PricedRuns quick = method(1e4, 1e-2, 4), slow = method(2e4, 1, 4);
  EXPECT_EQ(cost_level({quick, slow}), 1e5);                 // 1e-6 = 1e-2 h^4 at h = 0.1
  EXPECT_EQ(cost_level({method(1e4, 1e-3, 4), slow}), 5e4);  // at h = 0.178
  EXPECT_EQ(cost_level({method(1e4, 1, 4), slow}), 1e5);     // nobody reaches it: the middle of 25 to 400 µs
  EXPECT_EQ(cost_level({quick, slow, {}}), 1e5);
}

TEST(EqualCost, WhatCannotBeComparedHasNoLevel) {
  EXPECT_EQ(cost_level({}), 0);
  EXPECT_EQ(cost_level({method(1e4, 1, 4)}), 0);                     // alone
  EXPECT_EQ(cost_level({method(1e4, 1, 4), method(1e7, 1, 4)}), 0);  // nothing in common
  PricedRuns unknown = method(1.2e4, 1, 4);
  for (PricedRun& run : unknown) run.error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cost_level({unknown, unknown}), 1e5);  // the middle of 30 to 240 µs is 85
}
}  // namespace
