// A disc of states carried along by methods: its area against the law of the system.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include <pfaff/bench/experiment/contraction.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;

ResolvedRun run_of(const std::string& system, const std::string& integrator, const Assignments& set = {}) {
  RunSettings settings;
  settings.system = system;
  settings.integrator = integrator;
  settings.set = set;
  settings.step = "0.4";
  settings.time = "40";
  return resolve(settings);
}
const Assignments damped{{"nu", "0.2"}};

TEST(Contraction, OfSystemsThatStateIt) {
  EXPECT_TRUE(contracts(run_of("damped-oscillator", "rk4")));
  EXPECT_TRUE(contracts(run_of("damped-pendulum", "rk4")));
  EXPECT_FALSE(contracts(run_of("damped-oscillator", "rk4", {{"nu", "0"}})));  // nothing to see
  EXPECT_FALSE(contracts(run_of("harmonic-oscillator", "rk4")));
  EXPECT_FALSE(contracts(run_of("lotka-volterra", "rk4")));
  EXPECT_FALSE(contracts(run_of("kepler", "rk4")));
}

// Every area shrinks by e^{-nu t}: to the last digit by a scheme that keeps the structure e^{nu t} dr ^ dp of
// a linear system, and by another one only as far as it is accurate.
TEST(Contraction, OfALinearSystemIsKeptByWhoKeepsTheStructure) {
  const auto kept = carry_disc(run_of("damped-oscillator", "generating-function", damped), 60);
  const auto lost = carry_disc(run_of("damped-oscillator", "rk4", damped), 60);
  ASSERT_EQ(kept.size(), lost.size());
  EXPECT_EQ(kept.front().area, 1);
  EXPECT_EQ(kept.front().law, 1);
  EXPECT_NEAR(kept.back().t, 15 - 0.2, 0.3);  // e^{-0.2 t} has come to e^{-3}
  for (const CarriedDisc& disc : kept) {
    EXPECT_DOUBLE_EQ(disc.law, std::exp(-0.2 * disc.t));
    EXPECT_NEAR(disc.area / disc.law, 1, 1e-12);
  }
  EXPECT_GT(std::abs(lost.back().area / lost.back().law - 1), 1e-4);
}

// Sides of a polygon bend in a nonlinear motion, so that the area is that of the disc to a few digits; what
// the midpoint rule loses at this step is more.
TEST(Contraction, OfANonlinearSystemIsSeenAsWell) {
  const Assignments strongly{{"nu", "1"}};
  const auto kept = carry_disc(run_of("damped-pendulum", "generating-function", strongly), 60);
  const auto lost = carry_disc(run_of("damped-pendulum", "implicit-midpoint", strongly), 60);
  EXPECT_NEAR(kept.back().area / kept.back().law, 1, 5e-3);
  EXPECT_GT(std::abs(lost.back().area / lost.back().law - 1), 2e-2);
}

const char* const contracting_steps = R"(schema = 1
title = "A test"
[[method]]
label = "RK4, one"
integrator = "rk4"
[[case]]
name = "damped"
system = "damped-oscillator"
time = 4
steps = [0.1, 0.4, 0.2]
[[case]]
name = "kept"
system = "harmonic-oscillator"
time = 4
steps = [0.4]
)";

TEST(Contraction, IsThatOfTheLargestStepThatEndsWell) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "test.toml", contracting_steps);
  const Experiment of = read_experiment(files / "test.toml", false);
  const auto runs = expand(of);
  std::vector<nlohmann::json> summaries(runs.size(), {{"status", "converged"}});
  const auto rows_with = [&](const std::string& begin) {
    std::istringstream lines(contraction_csv(runs, summaries));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(begin) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(rows_with("case,method,step,t,area,law,outline"), 1U);
  EXPECT_EQ(rows_with("damped,\"RK4, one\",0.4,"), 11U);  // the start and ten steps
  EXPECT_EQ(rows_with(""), 12U);
  summaries[1]["status"] = "non_finite";
  EXPECT_EQ(rows_with("damped,\"RK4, one\",0.4,"), 0U);
  EXPECT_EQ(rows_with("damped,\"RK4, one\",0.2,"), 21U);
  for (nlohmann::json& summary : summaries) summary["status"] = "non_finite";
  EXPECT_EQ(contraction_csv(runs, summaries), "");
}
}  // namespace
