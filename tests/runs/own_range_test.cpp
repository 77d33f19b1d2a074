// How much of a quantity there is to lose, and what roundings of the state do to it, where both are known in
// closed form.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/runs/support/output_gradients.hpp>
#include <pfaff/runs/support/own_range.hpp>

#include "../bench/kept_samples.hpp"

namespace pfaff {
namespace {

testing::RecordWithSamples executed(const std::string& system, const std::string& integrator,
                                    const std::vector<std::string>& initial, const char* step,
                                    const char* time, const Assignments& set = {},
                                    const std::string& formulation = "") {
  RunSettings settings;
  settings.system = system;
  settings.integrator = integrator;
  settings.formulation = formulation;
  settings.step = step;
  settings.time = time;
  settings.initial = initial;
  settings.set = set;
  return testing::execute_and_keep(resolve(settings), nullptr);
}
double range_of(const std::string& system, const std::vector<std::string>& initial,
                std::size_t invariant = 0) {
  return executed(system, "gauss", initial, "0.05", "10").invariants().round_off.at(invariant).range.value();
}

TEST(OwnRange, IsTheDistanceFromTheEquilibrium) {
  EXPECT_NEAR(range_of("harmonic-oscillator", {"1", "0.5"}), 0.625, 0.03 * 0.625);
  EXPECT_NEAR(range_of("harmonic-oscillator", {"1e-9", "0"}), 0.5e-18, 0.03 * 0.5e-18);
  for (const double q : {0.1, 1.0, 1.5707963, 2.5})  // at 1.57 the energy itself is zero
    EXPECT_NEAR(range_of("pendulum", {std::to_string(q), "0"}), 1 - std::cos(q), 0.05 * (1 - std::cos(q)))
        << q;
  EXPECT_NEAR(range_of("henon-heiles", {"0.1", "0.2", "0.1", "0"}), 0.03 + 0.002 - 0.008 / 3, 0.05 * 0.03);
}

TEST(OwnRange, IsTheSizeWhereThereIsNoEquilibrium) {
  const testing::RecordWithSamples kepler = executed("kepler", "gauss", {}, "0.05", "10");
  for (std::size_t i = 0; i < 2; ++i) {  // energy and angular momentum
    const double size = std::abs(static_cast<double>(kepler.samples.front().invariants[i]));
    EXPECT_NEAR(kepler.invariants().round_off[i].range.value(), size, 0.06 * size) << i;
  }
  // Where that is zero, as of the angular momentum of a radial motion: the terms, p q + q p.
  EXPECT_GT(range_of("kepler", {"1", "0.5", "0.2", "0.1"}, 1), 0.1);
}

// q^2 + p^2 of the oscillator's energy; p^2 + |q sin q| of the pendulum's.
TEST(PropagatedRoundings, AreThoseOfTheGradient) {
  EXPECT_NEAR(executed("harmonic-oscillator", "gauss", {"3", "4"}, "0.05", "1")
                  .invariants()
                  .round_off[0]
                  .propagated.value(),
              25, 1e-6);
  const testing::RecordWithSamples pendulum = executed("pendulum", "gauss", {"1", "0.5"}, "0.05", "10");
  double largest = 0;
  for (const Sample<Quad>& sample : pendulum.samples) {
    const auto q = static_cast<double>(sample.state[0]), p = static_cast<double>(sample.state[1]);
    largest = std::max(largest, p * p + std::abs(q * std::sin(q)));
  }
  EXPECT_NEAR(pendulum.invariants().round_off[0].propagated.value(), largest, 1e-13);
}

// Residuals that RATTLE leaves are roundings of q.q and q.p; those of a method that knows nothing of
// constraints are not.
TEST(ConstraintRoundings, AreCalledSo) {
  const testing::RecordWithSamples kept = executed("n-pendulum", "rattle", {}, "0.01", "40");
  for (const Drift& d : kept.constraints().drift)
    EXPECT_TRUE(to_string(d.drift_class) == "round-off" || to_string(d.drift_class) == "exact")
        << d.evidence << ' ' << d.maximum;
  EXPECT_EQ(kept.constraints().drift.size(), 2U);
  const testing::RecordWithSamples lost = executed("n-pendulum", "rk4", {}, "0.01", "40", {}, "dirac");
  for (const Drift& d : lost.constraints().drift)
    EXPECT_NE(to_string(d.drift_class), "round-off") << d.maximum;
}

}  // namespace
}  // namespace pfaff
