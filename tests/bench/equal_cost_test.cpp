// The choice of steps at which methods cost the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include <pfaff/bench/experiment/equal_cost.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

// A method of order `order` whose run costs `unit` / h and errs by `error` h^order.
PricedRuns priced(double unit, double error, int order) {
  PricedRuns runs;
  for (const double h : {0.4, 0.2, 0.1, 0.05}) runs.push_back({h, unit / h, error * std::pow(h, order)});
  return runs;
}

TEST(EqualCost, AStepIsFoundOnTheLineOfCosts) {
  const PricedRuns runs = priced(1e4, 1, 4);  // 25 µs to 200 µs
  EXPECT_NEAR(size_at_cost(runs, 5e4), 0.2, 1e-15);
  EXPECT_NEAR(size_at_cost(runs, 7e4), 1e4 / 7e4, 1e-15);  // cost is 1/h, which is straight in logarithms
  EXPECT_EQ(size_at_cost(runs, 2.4e4), 0);
  EXPECT_EQ(size_at_cost(runs, 2.1e5), 0);
}

TEST(EqualCost, ADisturbedTimingOfACoarseRunIsLowered) {
  PricedRuns runs = priced(1e4, 1, 4);
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
  const PricedRuns quick = priced(1e4, 1e-2, 4), slow = priced(2e4, 1, 4);
  EXPECT_EQ(cost_level({quick, slow}), 1e5);                 // 1e-6 = 1e-2 h^4 at h = 0.1
  EXPECT_EQ(cost_level({priced(1e4, 1e-3, 4), slow}), 5e4);  // at h = 0.178
  EXPECT_EQ(cost_level({priced(1e4, 1, 4), slow}), 1e5);     // nobody reaches it: the middle of 25 to 400 µs
  EXPECT_EQ(cost_level({quick, slow, {}}), 1e5);
}

TEST(EqualCost, WhatCannotBeComparedHasNoLevel) {
  EXPECT_EQ(cost_level({}), 0);
  EXPECT_EQ(cost_level({priced(1e4, 1, 4)}), 0);                     // alone
  EXPECT_EQ(cost_level({priced(1e4, 1, 4), priced(1e7, 1, 4)}), 0);  // nothing in common
  PricedRuns unknown = priced(1.2e4, 1, 4);
  for (PricedRun& run : unknown) run.error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cost_level({unknown, unknown}), 1e5);  // the middle of 30 to 240 µs is 85
}

// Two labels that differ in a sign alone, two names that end and begin elsewhere, and a case that stands
// there twice with other steps.
const char* const alike = R"(schema = 1
title = "A test"
[[method]]
label = "Gauss+"
integrator = "gauss"
[[method]]
label = "Gauss*"
integrator = "gauss"
set = { stages = 3 }
[[method]]
label = "b Gauss*"
integrator = "gauss"
[[case]]
name = "a b"
system = "damped-oscillator"
time = 2
steps = [0.5, 0.25]
methods = ["Gauss+", "Gauss*"]
[[case]]
name = "a"
system = "damped-oscillator"
time = 2
steps = [0.4, 0.2]
methods = ["b Gauss*", "Gauss+"]
[[case]]
name = "a"
system = "damped-oscillator"
time = 2
steps = [0.1, 0.05]
methods = ["Gauss+"]
)";

TEST(EqualCost, RunsHaveDirectoriesOfTheirOwn) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "alike.toml", alike);
  const Experiment experiment = read_experiment(files / "alike.toml", false);
  const auto at = [&](std::size_t of_case, std::size_t of_method) {
    ExperimentRun like;
    like.which = &experiment.cases.at(of_case);
    like.method = &experiment.methods.at(of_method);
    return at_size(experiment, like, "0.125");
  };
  const auto names = [](const std::vector<ExperimentRun>& runs) {
    std::vector<std::string> slugs;
    for (const ExperimentRun& run : runs) slugs.push_back(run.slug);
    return slugs;
  };
  std::vector<ExperimentRun> runs{at(0, 0), at(0, 1), at(1, 2), at(1, 0), at(2, 0)};
  const auto before = names(runs);
  EXPECT_EQ(before[0], before[1]);  // what is to be told apart
  EXPECT_EQ(before[0], before[2]);
  tell_apart(runs);
  const auto after = names(runs);
  EXPECT_EQ(std::set<std::string>(after.begin(), after.begin() + 3).size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(after[k].starts_with(before[k] + "-")) << after[k];
  EXPECT_EQ(after[3], before[3]);  // alone with its name
  EXPECT_EQ(after[4], after[3]);   // the same run
  // The name is that of the run, whatever stands beside it.
  std::vector<ExperimentRun> fewer{at(0, 1), at(1, 2)};
  tell_apart(fewer);
  EXPECT_EQ(names(fewer), (std::vector<std::string>{after[1], after[2]}));
}
}  // namespace
