// The contraction of the iteration, which methods remember from step to step: that of the last step, or the
// slowest so far. And iterations that end by it.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include <pfaff/integrators/support/remembered_contraction.hpp>
#include <pfaff/integrators/support/settling_convergence.hpp>

namespace {
using pfaff::RememberedContraction;
using pfaff::SettlingConvergence;
using pfaff::Status;

TEST(RememberedContraction, IsOneUntilMeasuredAndOnceForgotten) {
  RememberedContraction<double> contraction;
  EXPECT_FALSE(contraction.known());
  EXPECT_EQ(contraction.ratio(), 1);
  EXPECT_TRUE(contraction.remember_last(0.25));
  EXPECT_TRUE(contraction.known());
  EXPECT_EQ(contraction.ratio(), 0.25);
  contraction.forget();
  EXPECT_FALSE(contraction.known());
  EXPECT_EQ(contraction.ratio(), 1);
}

TEST(RememberedContraction, TheLastFollowsTheMotion) {
  RememberedContraction<double> contraction;
  contraction.remember_last(0.25);
  EXPECT_TRUE(contraction.remember_last(0.125));
  EXPECT_EQ(contraction.ratio(), 0.125);
  EXPECT_FALSE(contraction.remember_last(0)) << "a step that measured nothing changes nothing";
  EXPECT_EQ(contraction.ratio(), 0.125);
}

TEST(RememberedContraction, TheSlowestOnlyGrows) {
  RememberedContraction<double> contraction;
  contraction.remember_slowest(0.125);
  contraction.remember_slowest(0.25);
  contraction.remember_slowest(0.0625);
  contraction.remember_slowest(0);
  EXPECT_EQ(contraction.ratio(), 0.25);
  contraction.remember_slowest(2);
  EXPECT_EQ(contraction.ratio(), 2);
  contraction.remember_slowest(0.5);
  EXPECT_EQ(contraction.ratio(), 0.5) << "a ratio that did not contract gives way to the next";
}

// Feeds corrections of a component of size 1 until the iteration ends: how many it has taken, and how it
// ended.
struct RememberedEnding {
  int taken;
  Status status;
};
RememberedEnding remembered_ending(const std::vector<double>& corrections, double remembered) {
  RememberedContraction<double> contraction;
  contraction.remember_slowest(remembered);
  SettlingConvergence<double> convergence;
  int taken = 0;
  for (const double correction : corrections) {
    convergence.begin_iteration();
    convergence.add(correction, 1.0, 1.0);
    ++taken;
    if (convergence.finished(100, contraction)) break;
  }
  return {taken, convergence.status()};
}

// 5e-15 is what a good prediction is off by, and the corrections after it are round-off.
TEST(SettlingConvergence, EndsWhereTheSecondCorrectionIsRoundOff) {
  const RememberedEnding known = remembered_ending({5e-15, 1.5e-16, 1e-16, 1e-17}, 1e-3);
  EXPECT_EQ(known.taken, 2);
  EXPECT_EQ(known.status, Status::converged);
  // Controls: without a contraction that is known, or with one that leaves more, it goes on.
  EXPECT_GT(remembered_ending({5e-15, 1.5e-16, 1e-16, 1e-17}, 0).taken, 2);
  EXPECT_GT(remembered_ending({5e-15, 1.5e-16, 1e-16, 1e-17}, 0.25).taken, 2);
}
// A correction that is more than round-off shows that the iteration contracts more slowly than remembered.
TEST(SettlingConvergence, DoesNotTrustWhatIsRememberedBeyondRoundOff) {
  EXPECT_EQ(remembered_ending({1e-6, 1e-8, 1e-10, 1e-12}, 1e-12).taken, 4);
}
TEST(SettlingConvergence, ReportsHowIterationsFail) {
  EXPECT_EQ(remembered_ending({1e-3, std::numeric_limits<double>::quiet_NaN(), 0}, 1e-3).status,
            Status::non_finite);
  EXPECT_EQ(remembered_ending({1e-3, std::numeric_limits<double>::quiet_NaN(), 0}, 1e-3).taken, 2);
  EXPECT_EQ(remembered_ending(std::vector<double>(120, 1e-3), 1e-3).status, Status::not_converged);
}
}  // namespace
