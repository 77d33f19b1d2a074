// Poincare's integral invariant along methods: a loop of states that they carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pfaff/bench/experiment/loop_invariant.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

ResolvedRun looped(const std::string& system, const std::string& integrator, const Assignments& set = {},
                   const std::string& step = "0.1") {
  RunSettings settings;
  settings.system = system;
  settings.integrator = integrator;
  settings.set = set;
  settings.step = step;
  settings.time = "20";
  return resolve(settings);
}

// While the loop is resolved, as reports draw it.
double largest_change(const std::vector<CarriedLoop>& loops) {
  double worst = 0;
  std::size_t resolved = 0;
  while (resolved < loops.size() && loops[resolved].uncertainty <= 1e-6)
    worst = std::max(worst, std::abs(loops[resolved++].integral - 1));
  EXPECT_GE(resolved, 10U);
  return worst;
}

TEST(LoopInvariant, OfCanonicalAndBirkhoffianSystemsWithoutConstraints) {
  EXPECT_TRUE(has_loop_invariant(looped("kepler", "rk4")));
  EXPECT_TRUE(has_loop_invariant(looped("damped-pendulum", "rk4")));
  EXPECT_TRUE(has_loop_invariant(looped("lotka-volterra", "rk4")));
  EXPECT_FALSE(has_loop_invariant(looped("spherical-pendulum", "rattle")));
  EXPECT_FALSE(has_loop_invariant(looped("relaxing-rigid-body", "rk4")));
}

// A loop of 64 points and of size 1/1000 is known to 1e-16 * 1000 * 64, a few times over; kept where steps
// are symplectic, or keep K(z, t) of the damped pendulum, and lost by the same orders of magnitude as
// structure otherwise.
TEST(LoopInvariant, StaysWhereStepsKeepTheStructure) {
  // Three times round an ellipse the loop is a hundred times as long, and so are the errors.
  for (const char* method : {"verlet", "gauss", "implicit-midpoint"})
    EXPECT_LT(largest_change(carry_loop(looped("kepler", method, {}, "0.05"), 40)), 1e-9) << method;
  EXPECT_GT(largest_change(carry_loop(looped("kepler", "rk4", {}, "0.05"), 40)), 1e-7);

  EXPECT_LT(largest_change(carry_loop(looped("damped-pendulum", "generating-function"), 40)), 3e-11);
  EXPECT_LT(largest_change(carry_loop(looped("damped-pendulum", "gauss-darboux"), 40)), 3e-11);
  EXPECT_GT(largest_change(carry_loop(looped("damped-pendulum", "implicit-midpoint"), 40)), 1e-5);

  EXPECT_LT(largest_change(carry_loop(looped("lotka-volterra", "generating-function"), 40)), 3e-11);
  EXPECT_GT(largest_change(carry_loop(looped("lotka-volterra", "implicit-midpoint"), 40)), 1e-7);
}

// Of the oscillator the integral is an area: it changes by the determinant of a step of RK4, step by step.
TEST(LoopInvariant, OfALinearSystemIsTheDeterminantOfTheSteps) {
  const auto loops = carry_loop(looped("harmonic-oscillator", "rk4"), 20);
  ASSERT_EQ(loops.size(), 21U);
  const double h = 0.1, even = 1 - h * h / 2 + std::pow(h, 4) / 24, odd = h - h * h * h / 6;
  const double determinant = even * even + odd * odd;
  for (const CarriedLoop& loop : loops)
    EXPECT_NEAR(loop.integral, std::pow(determinant, loop.t / h), 3e-11) << loop.t;
  EXPECT_GT(std::abs(loops.back().integral - 1), 1e-6);
}

// Half of the points say as much while the loop is smooth, and no longer once it is wound up.
TEST(LoopInvariant, TellsWhenALoopIsNoLongerResolved) {
  RunSettings settings;
  settings.system = "kepler";
  settings.integrator = "verlet";
  settings.step = "0.2";
  settings.time = "200";
  const auto loops = carry_loop(resolve(settings), 40);
  ASSERT_EQ(loops.size(), 41U);
  EXPECT_LT(loops[1].uncertainty, 1e-9);
  EXPECT_GT(loops.back().uncertainty, 1e-3);
}

TEST(LoopInvariant, IsThatOfTheLargestStepThatEndsWell) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "test.toml", R"(schema = 1
title = "A test"
[[method]]
label = "RK4, one"
integrator = "rk4"
[[case]]
name = "swing"
system = "pendulum"
time = 4
steps = [0.1, 0.4, 0.2]
)");
  const Experiment of = read_experiment(files / "test.toml", false);
  const auto runs = expand(of);
  std::vector<nlohmann::json> summaries(runs.size(), {{"status", "converged"}});
  const auto rows_with = [&](const std::string& begin) {
    std::istringstream lines(loops_csv(runs, summaries));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(begin) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(rows_with("case,method,step,t,integral,uncertainty"), 1U);
  EXPECT_EQ(rows_with("swing,\"RK4, one\",0.4,"), 11U);  // the start and ten steps
  EXPECT_EQ(rows_with(""), 12U);
  for (nlohmann::json& summary : summaries) summary["status"] = "non_finite";
  EXPECT_EQ(loops_csv(runs, summaries), "");
}

}  // namespace
