// RATTLE over a million steps of the 4-pendulum, from 16 random starts. Both levels of constraints stay at
// round-off; the energy oscillates, and any trend in it is within what the correlation of its errors
// explains.
#include <gtest/gtest.h>

#include <pfaff/bench/runner/record.hpp>

namespace {
using namespace pfaff;

RunRecord run(const std::string& integrator, const std::string& formulation, int seed, const char* step,
              const char* time) {
  RunSettings settings;
  settings.system = "n-pendulum";
  settings.integrator = integrator;
  settings.formulation = formulation;
  settings.set = {{"seed", std::to_string(seed)}};
  settings.step = step;
  settings.time = time;
  return execute(resolve(settings), nullptr);
}
bool trend_is_none(const Drift& energy) { return energy.slope_low <= 0 && energy.slope_high >= 0; }

TEST(LongDrift, RattleOverAMillionSteps) {
  int without_trend = 0;
  for (int seed = 1; seed <= 16; ++seed) {
    const RunRecord record = run("rattle", "", seed, "0.001", "1000");
    ASSERT_EQ(record.status, Status::converged) << record.message;
    ASSERT_EQ(record.completed, 1000000);
    // Positions up to 4 m and velocities up to some 10 m/s: their spacing is 4.4e-16 and 1.8e-15.
    EXPECT_LE(record.constraints().drift[0].maximum, 1e-14) << seed;
    EXPECT_LE(record.constraints().drift[1].maximum, 1e-14) << seed;
    without_trend += trend_is_none(record.invariants().drift[0]);
  }
  EXPECT_GE(without_trend, 13);  // intervals that hold in 95 of 100 give fewer once in 140 times
}

// The control: classical Runge-Kutta on Dirac's formulation loses energy, and the interval says so.
TEST(LongDrift, RungeKuttaHasATrend) {
  int with_trend = 0;
  for (int seed = 1; seed <= 4; ++seed)
    with_trend += !trend_is_none(run("rk4", "dirac", seed, "0.01", "1000").invariants().drift[0]);
  EXPECT_EQ(with_trend, 4);
}

}  // namespace
