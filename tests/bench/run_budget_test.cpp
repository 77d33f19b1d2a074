// Where runs end early because their budget does, they keep their samples and say where that was.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/errors/budget.hpp>

#include "../temporary_directory.hpp"
#include "kept_samples.hpp"
#include "run_settings.hpp"

namespace pfaff {
namespace {
using testing::settings_of;
using testing::TemporaryDirectory;

RunSettings adaptive(const std::string& system, const std::string& integrator, const std::string& time) {
  RunSettings s = settings_of(system, "", time);
  s.integrator = integrator;
  s.tolerance = "1e-10";
  return s;
}

bool says(const testing::RecordWithSamples& record, const std::string& part) {
  return record.message.find(part) != std::string::npos;
}

void expect_the_samples_of(const testing::RecordWithSamples& whole, const testing::RecordWithSamples& part) {
  ASSERT_LE(part.samples.size(), whole.samples.size());
  for (std::size_t k = 0; k < part.samples.size(); ++k) {
    EXPECT_EQ(part.samples[k].t, whole.samples[k].t) << k;
    EXPECT_EQ(part.samples[k].state, whole.samples[k].state) << k;
  }
}

TEST(RunBudget, MaxStepsEndsARunAfterThatStep) {
  for (const char* name : {"taylor", "odeint-dopri5", "extrapolation"}) {
    SCOPED_TRACE(name);
    RunSettings s = adaptive("kepler", name, "20");
    const testing::RecordWithSamples whole = testing::execute_and_keep(resolve(s), nullptr);
    ASSERT_EQ(whole.status, Status::converged) << whole.message;
    s.step_budget = whole.completed / 2;
    const testing::RecordWithSamples part = testing::execute_and_keep(resolve(s), nullptr);
    EXPECT_EQ(part.status, Status::not_converged);
    EXPECT_FALSE(part.interrupted);
    EXPECT_EQ(part.completed, s.step_budget);
    EXPECT_TRUE(says(part, "the budget of " + std::to_string(s.step_budget) + " steps has run out at t = "))
        << part.message;
    EXPECT_TRUE(says(part, "--max-steps")) << part.message;
    EXPECT_GT(part.samples.size(), 1U);
  }
}

TEST(RunBudget, AStopEndsARunWhoseMethodChoosesItsSteps) {
  const ResolvedRun run = resolve(adaptive("kepler", "odeint-dopri5", "100"));
  const testing::RecordWithSamples whole = testing::execute_and_keep(run, nullptr);
  std::atomic<bool> stop{false};
  const testing::RecordWithSamples part = testing::execute_and_keep(
      run, nullptr, [&](double fraction) { stop = fraction >= 0.25; }, &stop);
  EXPECT_TRUE(part.interrupted);
  EXPECT_TRUE(says(part, "it was interrupted at t = 2")) << part.message;
  EXPECT_NEAR(static_cast<double>(part.samples.size()), static_cast<double>(whole.samples.size()) / 4, 2);
  expect_the_samples_of(whole, part);
}

// Asked in the middle of a stretch between two samples, at which a run without a budget would not look.
TEST(RunBudget, AStopEndsARunBetweenItsSamples) {
  RunSettings s = settings_of("kepler", "0.01", "1000");
  s.every = 100000;
  std::atomic<bool> stop{false};
  const ResolvedRun run = resolve(s);
  stop = true;
  const testing::RecordWithSamples part = testing::execute_and_keep(run, nullptr, {}, &stop);
  EXPECT_TRUE(part.interrupted);
  EXPECT_EQ(part.completed, 0);
  EXPECT_EQ(part.samples.size(), 1U);
  EXPECT_EQ(part.message, "it was interrupted at t = 0 (step 0)");
}

TEST(RunBudget, ABudgetAroundTheRunEndsIt) {
  const ResolvedRun run = resolve(settings_of("kepler", "0.1", "100"));
  const testing::RecordWithSamples whole = testing::execute_and_keep(run, nullptr);
  const Budget budget({.evaluations = 2000});
  const testing::RecordWithSamples part = testing::execute_and_keep(run, nullptr);
  EXPECT_EQ(part.status, Status::not_converged);
  EXPECT_TRUE(says(part, "the budget of 2000 evaluations has run out at t = ")) << part.message;
  EXPECT_LE(part.completed, 500);  // four evaluations a step, and some for the structure of a sample
  EXPECT_GT(part.completed, 300);
  expect_the_samples_of(whole, part);
}

TEST(RunBudget, TasksOnOtherThreadsAreAskedToStopToo) {
  std::atomic<bool> stop{false};
  const Budget budget({}, &stop);
  std::atomic<int> done{0};
  in_parallel(20, [&](std::size_t) {
    spend(1, 1);
    ++done;
  });
  EXPECT_EQ(done, 20);
  const auto endless = [&](std::size_t) {
    stop = true;
    for (;;) spend(1, 1);
  };
  EXPECT_THROW(in_parallel(20, endless), BudgetSpent);
}

// Motions that end in finite time. Each run ends with the samples up to there and one line about it.
struct BlowUp {
  std::string text;
  double from, to;  // bounds of the time at which the motion ends
};
const std::vector<BlowUp>& blow_ups() {
  static const std::vector<BlowUp> list{
      // The motion of this energy runs off over a saddle; tried with 1e-3 and 1e-4 it is gone by t = 4.
      {"coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2 + p^3/6\"\n"
       "potential = \"q^2/2 + q^3/5 - cos(q)/4\"\n",
       1, 20},
      {"coordinates = [\"x\"]\ninitial = [1]\nfield = [\"x^2\"]\n", 0.99, 1.01},            // 1/(1 - t)
      {"coordinates = [\"x\"]\ninitial = [\"1/2\"]\nfield = [\"1 + x^2\"]\n", 1.10, 1.11},  // tan(t + .4636)
      {"coordinates = [\"x\"]\ninitial = [1]\nfield = [\"-1/x\"]\n", 0.499, 0.501}};        // sqrt(1 - 2 t)
  return list;
}

TEST(RunBudget, RunsIntoABlowUpEndThere) {
  const TemporaryDirectory files;
  std::size_t number = 0;
  for (const BlowUp& motion : blow_ups()) {
    const std::string file = files / ("blow-up-" + std::to_string(number++) + ".toml");
    std::ofstream(file) << motion.text;
    for (const char* name : {"taylor", "odeint-dopri5", "odeint-bulirsch-stoer", "extrapolation"}) {
      SCOPED_TRACE(motion.text + name);
      RunSettings s = adaptive(file, name, "20");
      s.step_budget = 100000;
      const testing::RecordWithSamples record = testing::execute_and_keep(resolve(s), nullptr);
      EXPECT_NE(record.status, Status::converged);
      EXPECT_TRUE(says(record, " at t = ")) << record.message;
      EXPECT_EQ(record.message.find('\n'), std::string::npos);
      ASSERT_FALSE(record.samples.empty());
      EXPECT_LE(record.samples.back().t, Quad(motion.to));
    }
    // With steps of one length a method jumps over what it cannot see, until the numbers run out.
    const testing::RecordWithSamples record =
        testing::execute_and_keep(resolve(settings_of(file, "0.1", "20")), nullptr);
    if (record.status != Status::converged) {
      EXPECT_TRUE(says(record, " at t = ")) << record.message;
    }
  }
}

}  // namespace
}  // namespace pfaff
