// The contraction of the iteration, which methods remember from step to step: that of the last step, or the
// slowest so far.
#include <gtest/gtest.h>

#include <pfaff/integrators/support/remembered_contraction.hpp>

namespace {
using pfaff::RememberedContraction;

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
}  // namespace
