// Runs pass many samples on at once: these are the states of the steps that are asked for, one after another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/runs/integration.hpp>

#include "kept_samples.hpp"

namespace pfaff {
namespace {

// Kept as they come, and how many came together.
class CountedSamples final : public SampleTaker {
 public:
  void begin(const MeasuredBeside& /*measured*/) override {}
  void take(const Sample<double>& sample) override {
    states.push_back(sample.state);
    invariants.push_back(sample.invariants);
    times.push_back(sample.t);
    structure.push_back(sample.structure.has_value());
  }
  void take(const Sample<Quad>& /*sample*/) override { FAIL() << "the run is in double"; }
  void take(const SampleRows<double>& samples) override {
    together += samples.rows.count;
    one_by_one(samples);
  }
  using SampleTaker::take;
  std::vector<std::vector<double>> states, invariants;
  std::vector<double> times;
  std::vector<bool> structure;
  std::size_t together = 0;
};

ResolvedRun of_henon_heiles(const char* time, std::int64_t every) {
  RunSettings settings;
  settings.system = "henon-heiles";
  settings.integrator = "verlet";
  settings.step = "0.1";
  settings.time = time;
  settings.every = every;
  return resolve(settings);
}

void expect_states_of_steps(std::int64_t every) {
  const ResolvedRun run = of_henon_heiles("300", every);
  CountedSamples samples;
  const RunRecord record = execute(run, nullptr, {}, nullptr, &samples);
  const auto rows = static_cast<std::size_t>((3000 + every - 1) / every + 1);  // the last step is always one
  ASSERT_EQ(samples.states.size(), rows);
  EXPECT_EQ(record.sample_count, rows);
  EXPECT_EQ(record.completed, 3000);
  Integration<double> by_hand(start_of<double>(run));
  Problem<double> problem(run.model);
  std::vector<double> values(1);
  for (std::size_t k = 0; k < samples.states.size(); ++k) {
    const std::vector<double> z(by_hand.state().begin(), by_hand.state().end());
    ASSERT_EQ(samples.states[k], z) << k;
    ASSERT_EQ(samples.times[k], by_hand.time()) << k;
    problem.invariants(by_hand.time(), z, values);
    ASSERT_EQ(samples.invariants[k], values) << k;
    if (by_hand.steps_taken() < 3000) {
      ASSERT_TRUE(by_hand.steps(std::min(every, 3000 - by_hand.steps_taken())).reached());
    }
  }
  EXPECT_EQ(by_hand.steps_taken(), 3000);
  const auto measured = std::count(samples.structure.begin(), samples.structure.end(), true);
  EXPECT_GE(measured, 50);
  EXPECT_LT(measured, 100);  // so many where the samples are just too few for one of two
  // The start and those that are looked at for residuals come alone.
  EXPECT_GE(samples.together, rows - static_cast<std::size_t>(measured) - 2);
}
TEST(SampleRows, AreTheStatesOfTheSteps) {
  for (const std::int64_t every : {1, 3, 7, 16}) {
    SCOPED_TRACE(every);
    expect_states_of_steps(every);
  }
}

// Whether many come at once depends on who looks: with a solution each is compared with it, and all the rest
// is the same to the last bit.
void expect_the_same_record(std::int64_t every) {
  const ResolvedRun run = of_henon_heiles("200", every);
  CountedSamples together, single;
  const RunRecord one = execute(run, nullptr, {}, nullptr, &together);
  const auto reference = reference_of(run);
  const RunRecord other = execute(run, reference.get(), {}, nullptr, &single);
  EXPECT_GT(together.together, 0U);
  EXPECT_EQ(single.together, 0U);
  EXPECT_EQ(together.states, single.states);
  EXPECT_EQ(together.invariants, single.invariants);
  EXPECT_EQ(together.structure, single.structure);
  EXPECT_EQ(one.structure_residual, other.structure_residual);
  const InvariantsLeft &left = one.invariants(), &right = other.invariants();
  EXPECT_EQ(left.drift[0].maximum, right.drift[0].maximum);
  EXPECT_EQ(left.drift[0].slope, right.drift[0].slope);
  EXPECT_EQ(left.drift[0].evidence, right.drift[0].evidence);
  EXPECT_EQ(left.round_off[0].scale, right.round_off[0].scale);
  EXPECT_EQ(left.round_off[0].propagated, right.round_off[0].propagated);
  EXPECT_EQ(left.round_off[0].range, right.round_off[0].range);
}
TEST(SampleRows, LeaveTheSameRecordAsSingleOnes) {
  for (const std::int64_t every : {1, 3}) {
    SCOPED_TRACE(every);
    expect_the_same_record(every);
  }
}

}  // namespace
}  // namespace pfaff
