// Runs in which a method loses the energy, all of it or most: no class says that it is kept. The losses are
// known in closed form or from what is left at the end.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>

#include "../temporary_directory.hpp"
#include "kept_samples.hpp"

namespace pfaff {
namespace {

struct Lost {
  std::string system, integrator, step, time;
  std::vector<std::string> initial = {};
};

testing::RecordWithSamples executed(const Lost& run) {
  RunSettings settings;
  settings.system = run.system;
  settings.integrator = run.integrator;
  settings.step = run.step;
  settings.time = run.time;
  settings.initial = run.initial;
  return testing::execute_and_keep(resolve(settings), nullptr);
}

// A method of order 1, as a table: `a` is 1 for the implicit and 0 for the explicit method of Euler.
std::string euler(const std::filesystem::path& folder, const std::string& a) {
  const std::filesystem::path file = folder / ("euler-" + a + ".toml");
  write_file(file,
             "name = \"euler-" + a +
                 "\"\nkind = \"runge-kutta\"\norder = 1\nreference = \"hairer-lubich-wanner2006\"\na = [[" +
                 a + "]]\nb = [1]\nc = [" + a + "]\n");
  return file.string();
}

// `least`: of the range that is known, how much is gone at the end.
void expect_lost(const testing::RecordWithSamples& record, double range, double least,
                 const std::string& what) {
  ASSERT_EQ(record.status, Status::converged) << what << record.message;
  const Drift& energy = record.invariants().drift.at(0);
  ASSERT_GE(std::abs(energy.final_value), least * range) << what;
  // Of its own range: the equilibrium is found to some per cent.
  ASSERT_TRUE(record.invariants().round_off[0].range.has_value());
  EXPECT_NEAR(*record.invariants().round_off[0].range, range, 0.1 * range) << what;
  const std::string_view name = to_string(energy.drift_class);
  EXPECT_TRUE(name == "linear" || name == "polynomial" || name == "exponential" || name == "undetermined")
      << what << ": " << name << ": " << energy.evidence;
  EXPECT_NE(energy.evidence.find("loses"), std::string::npos)
      << what << ": " << name << ": " << energy.evidence;
}

TEST(DriftLost, ByRungeKuttaOnThePendulum) {
  const testing::RecordWithSamples record = executed({"pendulum", "rk4", "0.5", "200000"});
  const double q = static_cast<double>(record.samples.front().state[0]),
               p = static_cast<double>(record.samples.front().state[1]);
  expect_lost(record, p * p / 2 + 1 - std::cos(q), 0.95, "h = .5");
  EXPECT_EQ(to_string(record.invariants().drift[0].drift_class), "linear")
      << record.invariants().drift[0].evidence;
  expect_lost(executed({"pendulum", "rk4", "0.7", "20000"}), p * p / 2 + 1 - std::cos(q), 0.9, "h = .7");
  expect_lost(executed({"pendulum", "rk4", "0.6", "50000", {"0.5", "0"}}), 1 - std::cos(0.5), 0.5,
              "from q = .5");
}

// RK4 with h omega = 1 multiplies the energy of an oscillator by 1 - 1/72 + 1/576 each step: half of it is
// lost after 57 steps, nearly all after some hundreds.
TEST(DriftLost, ByRungeKuttaOnTheOscillator) {
  for (const char* time : {"1000", "20000", "300000"})
    expect_lost(executed({"harmonic-oscillator", "rk4", "1", time, {"1", "0"}}), 0.5, 0.99, time);
  expect_lost(executed({"harmonic-oscillator", "rk4", "1.2", "20000", {"0", "2"}}), 2, 0.99, "h = 1.2");
}

// The implicit method of Euler divides it by 1 + h^2 each step.
TEST(DriftLost, ByTheImplicitMethodOfEuler) {
  const testing::TemporaryDirectory folder;
  const std::string method = euler(folder.path(), "1");
  for (const char* time : {"200", "1500", "5000", "20000"})
    expect_lost(executed({"harmonic-oscillator", method, "0.1", time, {"1", "0"}}), 0.5, 0.8, time);
  expect_lost(executed({"pendulum", method, "0.05", "3000", {"1", "0"}}), 1 - std::cos(1), 0.9, "pendulum");
}

// Kepler's energy has no equilibrium: it is lost where little is left of |E(0)| = .5, whose terms add up
// to 4.5.
TEST(DriftLost, ByTheExplicitMethodOfEulerOnKepler) {
  const testing::TemporaryDirectory folder;
  const std::string method = euler(folder.path(), "0");
  for (const auto& [step, time] : {std::pair{"0.01", "1000"}, {"0.02", "2000"}}) {
    const testing::RecordWithSamples record = executed({"kepler", method, step, time});
    EXPECT_GT(record.invariants().round_off[0].scale, 2) << step;
    expect_lost(record, 0.5, 0.7, step);
  }
}

// Control: methods that keep the energy lose nothing of it, whatever its range.
TEST(DriftLost, NotBySymplecticMethods) {
  for (const char* system : {"pendulum", "harmonic-oscillator", "kepler"})
    for (const char* method : {"verlet", "gauss"}) {
      const Drift energy = executed({system, method, "0.05", "2000"}).invariants().drift.at(0);
      const std::string_view name = to_string(energy.drift_class);
      EXPECT_TRUE(name == "bounded" || name == "round-off")
          << system << ", " << method << ": " << name << ": " << energy.evidence;
    }
}

// A beat of an oscillator that is driven near its frequency, whose energy does not stay what it is: it falls
// at first, and rises to more than ten times as much then. Neither is the slope of the start that of the run,
// nor is anything lost.
TEST(DriftLost, WhatComesBackAndExceedsTheStartIsNoTrendOfTheStart) {
  const testing::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "beat.toml";
  write_file(file,
             "name = \"beat\"\ncoordinates = [\"x\", \"v\"]\ninitial = [1, 0]\n"
             "field = [\"v\", \"-x + 0.01*sin(1.003*t)\"]\ninvariants = { energy = \"(x^2 + v^2)/2\" }\n");
  for (const char* time : {"1000", "2000"}) {
    const testing::RecordWithSamples record = executed({file.string(), "gauss", "0.1", time});
    const Drift& energy = record.invariants().drift.at(0);
    EXPECT_EQ(to_string(energy.drift_class), "undetermined") << time << ": " << energy.evidence;
  }
}

// A particle on its way along a magnetic field that gets stronger: the error of the midpoint rule follows its
// bounce, rises to 71 % of the energy until t = 30 and is on its way back at 40, a thousandth of it at 60.
TEST(DriftLost, NotByAnErrorThatIsOnItsWayBack) {
  const testing::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "mirror.toml";
  write_file(file,
             "name = \"mirror\"\ncoordinates = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\n"
             "initial = [0.3, 0, 0.1, 0.1, 0.6, 0.5]\n"
             "hamiltonian = \"((px + 5/2*(1+z^2/4)*y)^2 + (py - 5/2*(1+z^2/4)*x)^2 + pz^2)/2\"\n");
  const Drift energy = executed({file.string(), "implicit-midpoint", "0.05", "40"}).invariants().drift.at(0);
  EXPECT_EQ(to_string(energy.drift_class), "undetermined") << energy.evidence;
}

// A rest energy of 1e6 rounds each evaluation to 1.1e-10, and no step. Each step of RK4 at h = .05 loses the
// part h^6/72 - h^8/576 of the energy of motion, .5: 5e-8 in 461 steps, which is nothing that roundings do.
TEST(DriftLost, BesideARestEnergy) {
  const testing::TemporaryDirectory folder;
  const auto system = [&](const std::string& rest) {
    const std::filesystem::path file = folder.path() / ("rest-" + rest + ".toml");
    write_file(file, "name = \"rest-" + rest +
                         "\"\ncoordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"q^2/2 + " +
                         rest + "\"\ninitial = [1, 0]\ninvariants = { energy = \"p^2/2 + q^2/2 + " + rest +
                         "\" }\n");
    return file.string();
  };
  for (const char* rest : {"1000000", "20000", "0"}) {
    const testing::RecordWithSamples record = executed({system(rest), "rk4", "0.05", "23.05"});
    const Drift& energy = record.invariants().drift.at(0);
    const double expected = 0.5 * 461 * (std::pow(0.05, 6) / 72 - std::pow(0.05, 8) / 576);
    EXPECT_NEAR(energy.final_value, -expected, 1e-3 * expected + 2.3e-16 * std::stod(rest)) << rest;
    EXPECT_LE(record.invariants().round_off[0].propagated.value(), 1.0001) << rest;  // q^2 + p^2
    EXPECT_NEAR(*record.invariants().round_off[0].range, 0.5, 0.05) << rest;
    EXPECT_EQ(to_string(energy.drift_class), "linear") << rest << ": " << energy.evidence;
  }
}

}  // namespace
}  // namespace pfaff
