// When an iteration that is improved by secants ends.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <pfaff/integrators/support/secant_convergence.hpp>

namespace {
using namespace pfaff;

// Feeds corrections of a component of size 1 until the iteration ends.
struct SecantEnding {
  int taken;
  Status status;
  double contraction;
};
template <class Watch, class... Known>
SecantEnding secant_ending(Watch watch, const std::vector<double>& corrections, Known... known) {
  int taken = 0;
  for (const double correction : corrections) {
    watch.begin_iteration();
    watch.add(correction, 1.0, 1.0);
    ++taken;
    if (watch.finished(100, known...)) break;
  }
  return {taken, watch.status(), watch.contraction()};
}

// Corrections of the derivative of a step, as they were measured.
const std::vector<double> lucky{9.6e-2, 3.8e-3, 2.7e-4, 1.6e-5, 5.0e-12, 1.4e-13, 1.0e-17};

TEST(SecantConvergence, IsNotMisledByOneSmallRatio) {
  const SecantEnding now = secant_ending(SecantConvergence<double>(), lucky, 1.0);
  EXPECT_EQ(now.taken, 7);
  EXPECT_EQ(now.status, Status::converged);
  EXPECT_EQ(secant_ending(Convergence<double>(), lucky).taken, 5) << "the control: the last ratio alone";
}
// Or one correction sooner, where that one would be less than a sixteenth of a unit of round-off.
TEST(SecantConvergence, EndsEvenCorrectionsWhereTheLastRatioWould) {
  for (const double ratio : {0.3, 1e-2, 1e-4}) {
    std::vector<double> even{0.1};
    while (even.size() < 60) even.push_back(ratio * even.back());
    const SecantEnding now = secant_ending(SecantConvergence<double>(), even, ratio);
    const SecantEnding plain = secant_ending(Convergence<double>(), even, ratio);
    EXPECT_LE(now.taken, plain.taken) << ratio;
    EXPECT_GE(now.taken, plain.taken - 1) << ratio;
    EXPECT_EQ(now.status, Status::converged) << ratio;
    EXPECT_EQ(now.contraction, plain.contraction) << ratio;
  }
}
TEST(SecantConvergence, TakesTheSecondCorrectionForTheLastOnlyWhereEarlierStepsSaySo) {
  const std::vector<double> corrections{1e-9, 1e-15, 1e-18};
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), corrections, 1e-4).taken, 2);
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), corrections, 1e-2).taken, 3);
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), corrections, 1.0).taken, 3);
}
// The fifth correction is two units of round-off, and those after it are rounding errors.
TEST(SecantConvergence, DoesNotWaitForRoundingErrorsToVanish) {
  const std::vector<double> noisy{2.4e-4, 9.4e-8, 3.1e-11, 7.9e-15, 2.1e-16, 2.8e-17, 9.1e-17};
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), noisy, 1.0).taken, 5);
  EXPECT_EQ(secant_ending(Convergence<double>(Corrections::in_turns), noisy).taken, 7) << "the control";
  // Contractions that are slower leave something to gain.
  const std::vector<double> slow{1e-13, 1e-14, 2.1e-16, 1e-17, 1e-18};
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), slow, 1.0).taken, 4);
}
TEST(SecantConvergence, MeasuresNothingAgainstACorrectionLargerThanItsComponent) {
  const std::vector<double> from_nothing{1e20, 1e-3, 1e-6, 1e-12, 1e-20};
  const SecantEnding now = secant_ending(SecantConvergence<double>(), from_nothing, 1.0);
  EXPECT_EQ(now.taken, 5);
  EXPECT_EQ(now.contraction, 0);
  EXPECT_GT(secant_ending(Convergence<double>(), from_nothing).contraction, 0) << "the control";
  EXPECT_EQ(secant_ending(Convergence<double>(), from_nothing).taken, 2) << "the control";
}
TEST(SecantConvergence, EndsOnWhatIsNoNumber) {
  EXPECT_EQ(secant_ending(SecantConvergence<double>(), {1e-3, NAN, 1e-3}, 1.0).status, Status::non_finite);
}

}  // namespace
