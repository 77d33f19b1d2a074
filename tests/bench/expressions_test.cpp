// Numbers that are asked for by expressions, of runs and of experiments.
#include <gtest/gtest.h>

#include <pfaff/bench/experiment/case_steps.hpp>
#include <pfaff/bench/runner/expressions.hpp>

#include "run_settings.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::complaint;
using pfaff::testing::settings_of;

const std::string full_turn = "6.283185307179586476925286766559005768";

TEST(Expressions, BecomeNumbers) {
  EXPECT_EQ(*Real::parse(evaluated("2*pi", "--step")), *Real::parse(full_turn));
  EXPECT_EQ(evaluated("(1/3 + 1/6)*3", "--step"), "1.5");
  EXPECT_EQ(*Real::parse(evaluated("period/4", "--step", {{"period", "3"}})), Real::fraction(3, 4));
  EXPECT_EQ(evaluated("period", "--step", {{"period", "3"}, {"kind", "none"}}), "3");
  EXPECT_EQ(evaluated("0.5-0.2", "--step"), "0.3");
  EXPECT_EQ(evaluated("1/30 + 1/30", "--step"), evaluated("(2/30)*1", "--step"));
  EXPECT_EQ(evaluated("2.5e-1+1e-1", "--step"), "0.35");
}

// What is a number stays as it is written, and what is neither is for the reader to refuse.
TEST(Expressions, OtherTextsStay) {
  for (const char* text : {"0.1", "1e-3", "1/3", "-2", "", "abc", "1/0", "1e5x", "--"})
    EXPECT_EQ(evaluated(text, "--step"), text);
}

TEST(Expressions, OfUnknownNamesAreRefused) {
  try {
    (void)evaluated("perod/4", "--step", {{"period", "3"}});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--step:1:1: unknown name 'perod'; did you mean 'period'?");
  }
}

TEST(Expressions, AreTakenByRuns) {
  // omega is a parameter of the pendulum.
  const ResolvedRun run = resolve(settings_of("pendulum", "2*pi/(100*omega)", "2*pi/omega",
                                              {{"omega", "sqrt(4)"}, {"initial", "pi/4,(1 - omega)"}}));
  EXPECT_EQ(run.steps, 100);
  EXPECT_EQ(run.step, *Real::parse(full_turn) / Real(200));
  EXPECT_EQ(run.initial[0], *Real::parse(full_turn) / Real(8));
  EXPECT_EQ(run.initial[1], Real(-1));
  EXPECT_EQ(complaint(settings_of("pendulum", "omga/100", "1")),
            "--step:1:1: unknown name 'omga'; did you mean 'omega'?");
  EXPECT_EQ(resolve(settings_of("pendulum", "0.1", "-(2*pi)")).steps, 62);
}

TEST(Expressions, AreTakenByCasesOfExperiments) {
  ExperimentCase one;
  one.system = "pendulum";
  one.set = {{"omega", "2"}};
  one.time = "20*pi";
  one.steps = {"0.1", "pi/(10*omega)"};
  one.initial = {"pi/2"};
  one.initial_velocities = {"omega*3"};
  evaluate_numbers(one, "file");
  EXPECT_EQ(*Real::parse(one.time), *Real::parse(full_turn) * Real(10));
  EXPECT_EQ(*Real::parse(one.initial[0]), *Real::parse(full_turn) / Real(4));
  EXPECT_EQ(one.initial_velocities[0], "6");
  EXPECT_EQ(one.steps[0], "0.1");
  EXPECT_EQ(*Real::parse(one.steps[1]), *Real::parse(full_turn) / Real(40));
  one.steps = {"1/40", "1/3"};
  evaluate_numbers(one, "file");
  EXPECT_EQ(one.steps[0], "0.025");
  EXPECT_EQ(one.steps[1].substr(0, 20), "0.333333333333333333");
  one.time = "20*pe";
  EXPECT_THROW(evaluate_numbers(one, "file"), InputError);
}

}  // namespace
