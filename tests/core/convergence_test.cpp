// When an iteration has converged to round-off and cannot improve further, and compensated sums that keep
// what each addition rounds off.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <pfaff/core/numbers/sum_of_two.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/core/solve/summation.hpp>

namespace {
using namespace pfaff;

// Feeds the corrections of one component of size 1; returns the status and how many were taken.
template <class Sizes>
std::pair<Status, int> watch(const Sizes& correction, int limit = 60,
                             Corrections corrections = Corrections::even) {
  Convergence<double> c(corrections);
  do {
    c.begin_iteration();
    c.add(correction(c.iterations()), 1.0, 1.0);
  } while (!c.finished(limit));
  return {c.status(), c.iterations()};
}

TEST(Convergence, StopsAtRoundOffAndNotBefore) {
  const auto [halving, halvings] = watch([](int k) { return std::ldexp(1.0, -k); });
  EXPECT_EQ(halving, Status::converged);
  EXPECT_EQ(halvings, 56);  // an eighth of a unit of round-off
  // A contraction of 1e-3 is stopped one iteration early: the next correction would be nothing.
  const auto [fast, steps] = watch([](int k) { return std::pow(1e-3, k); });
  EXPECT_EQ(fast, Status::converged);
  EXPECT_EQ(steps, 5);  // 1e-15, the next one 1e-18
  // A quadratic iteration is, too.
  EXPECT_EQ(watch([](int k) { return std::pow(0.1, std::pow(2, k)); }).second, 4);
}

// Corrections that shrink by 1e-2 and 1e-9 in turns, as a forecast by the last ratio alone does not expect.
TEST(Convergence, TakesTwoForecastsOfCorrectionsThatShrinkUnevenly) {
  const auto uneven = [](int k) { return std::pow(1e-2, (k + 1) / 2) * std::pow(1e-9, k / 2); };
  // 1e-2, 1e-11, 1e-13: after the second one 1e-20 is expected and 1e-13 comes.
  EXPECT_EQ(watch(uneven), (std::pair{Status::converged, 2}));
  const auto two = watch(uneven, 60, Corrections::uneven);
  EXPECT_EQ(two.first, Status::converged);
  EXPECT_EQ(two.second, 4);  // 1e-13, of which 1e-15 is expected, then 1e-22
  // Even ones that end before there are four are iterated once more than they have to be; slower ones are not
  // affected.
  const auto fast = [](int k) { return std::pow(1e-6, k); };
  EXPECT_EQ(watch(fast, 60, Corrections::uneven).second, watch(fast).second + 1);
  const auto even = [](int k) { return std::pow(1e-3, k); };
  EXPECT_EQ(watch(even, 60, Corrections::uneven), watch(even));
  const auto slow = [](int k) { return std::ldexp(1.0, -k); };
  EXPECT_EQ(watch(slow, 60, Corrections::uneven), watch(slow));
  // Where no forecast counts, corrections have to be lost in rounding themselves.
  EXPECT_EQ(watch(even, 60, Corrections::in_turns).second, 6);
}

// Corrections of Lobatto stages as they were measured, in units of round-off: every other one stalls, five
// times in all, and the last one is still thousands of units large.
const std::vector<double> lobatto_corrections{3.4e13, 3.0e9, 2.8e9, 1.6e8, 1.6e8, 4.2e6, 4.3e6, 7.9e4, 1.0e5,
                                              2.8e3,  3.0e3, 1.1e2, 1.2e2, 3.6,   2.9,   0.1,   0.1,   0.01};
TEST(Convergence, DoesNotTakeStallsForRoundOffWhileEverySecondCorrectionShrinks) {
  const auto measured = [](int k) { return lobatto_corrections.at(static_cast<std::size_t>(k)) * 0x1p-53; };
  for (const Corrections kind : {Corrections::even, Corrections::uneven, Corrections::in_turns}) {
    const auto [status, taken] = watch(measured, 60, kind);
    EXPECT_EQ(status, Status::converged);
    EXPECT_GE(taken, 14) << "3.6 units, the first that is round-off";
    EXPECT_LE(taken, 16);
  }
  // Corrections of a pair of complex unknowns turn and shrink: most of a period passes without a smaller one.
  // Below 256 units three of them in turn are taken for rounding.
  const auto turning = [](int k) { return std::pow(0.75, k) * (0.2 + std::abs(std::cos(0.52 * k))); };
  for (const Corrections kind : {Corrections::even, Corrections::uneven, Corrections::in_turns}) {
    const auto [status, taken] = watch(turning, 300, kind);
    EXPECT_EQ(status, Status::converged);
    EXPECT_LE(turning(taken), 64 * 0x1p-53);
  }
  // Faster ones in turns are ended by what two iterations gain together, before they are round-off.
  const auto pairs = [](int k) { return std::pow(1e-7, k / 2); };  // 1, 1e-7, 1e-7, 1e-14, 1e-14, 1e-21
  EXPECT_EQ(watch(pairs, 60, Corrections::uneven), (std::pair{Status::converged, 5}));
  EXPECT_EQ(watch(pairs, 60, Corrections::in_turns).second, 6);
  // The control: corrections that shrink no more, not even by pairs, are round-off that sums amplify.
  const auto amplified = [](int k) { return k < 4 ? std::pow(1e-3, k) : 1e-12 * (1 + k % 3 / 8.0); };
  EXPECT_EQ(watch(amplified).first, Status::converged);
}

// Where the contraction is known from before, one correction may do, and must not where it would not.
TEST(Convergence, TrustsAKnownContractionWithAFactorToSpare) {
  const auto iterations = [](double size, double known) {
    Convergence<double> c;
    do {
      c.begin_iteration();
      c.add(size, 1, 1);
      size *= 1e-6;
    } while (!c.finished(10, known));
    EXPECT_EQ(c.status(), Status::converged);
    return c.iterations();
  };
  EXPECT_EQ(iterations(1e-15, 1), 2);
  EXPECT_EQ(iterations(1e-15, 1e-5), 1);  // 100 * 1e-5 * 1e-15 = 1e-18
  EXPECT_EQ(iterations(1e-14, 1e-5), 2);
  EXPECT_EQ(iterations(1e-9, 1e-6), 2);
  Convergence<double> c;
  c.begin_iteration();
  c.add(1e-6, 1, 1);
  EXPECT_FALSE(c.finished(10));
  EXPECT_EQ(c.contraction(), 0);
  c.begin_iteration();
  c.add(1e-9, 1, 1);
  (void)c.finished(10);
  EXPECT_NEAR(c.contraction(), 1e-3, 1e-12);
}

TEST(Convergence, NoiseNearRoundOffCountsAsConverged) {
  const auto noise = [](int k) { return k < 5 ? std::pow(0.01, k) : 2e-15 * (1 + k % 2); };
  EXPECT_EQ(watch(noise).first, Status::converged);
  // Controls: noise at 1e-9 does not, nor does slow convergence cut short, nor growth.
  EXPECT_EQ(watch([](int k) { return k < 4 ? std::pow(0.01, k) : 1e-9 * (1 + k % 2); }).first,
            Status::not_converged);
  EXPECT_EQ(watch([](int k) { return std::pow(0.9, k); }).first, Status::not_converged);
  EXPECT_EQ(watch([](int k) { return std::pow(1.1, k); }).first, Status::not_converged);
}

TEST(Convergence, SeesNaNInAnyComponentAndDerivative) {
  Convergence<double> c;
  c.begin_iteration();
  c.add(NAN, 1, 1);
  c.add(0, 1, 1);
  EXPECT_TRUE(c.finished(10));
  EXPECT_EQ(c.status(), Status::non_finite);
  Convergence<Dual<double, 2>> d;
  d.begin_iteration();
  Dual<double, 2> delta(0.0);
  delta.derivative[1] = NAN;
  d.add(delta, Dual<double, 2>(1), Dual<double, 2>(1));
  EXPECT_TRUE(d.finished(10));
  EXPECT_EQ(d.status(), Status::non_finite);
}

TEST(Convergence, JudgesEveryPartByItsOwnSize) {
  EXPECT_DOUBLE_EQ(relative_size(1e-30, 1e-20, 0.0), 1e-10);
  EXPECT_DOUBLE_EQ(relative_size(1e-30, 0.0, -1e-25), 1e-5);
  EXPECT_EQ(relative_size(0.0, 0.0, 0.0), 0);
  EXPECT_EQ(relative_size(1e-300, 0.0, 0.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(relative_size(static_cast<double>(NAN), 1.0, 1.0)));
  using D = Dual<double, 2>;
  D delta(1e-16), reference(1.0);
  delta.derivative = {1e-8, 0};
  reference.derivative = {1e-4, 1e-2};  // one scale for all directions
  EXPECT_DOUBLE_EQ(relative_size(delta, reference, D(0)), 1e-6);
}

TEST(Convergence, KnowsItsContraction) {
  Convergence<double> c;
  EXPECT_EQ(c.ratio(), 1);
  for (const double delta : {1e-2, 1e-3}) {
    c.begin_iteration();
    c.add(delta, 1, 1);
    EXPECT_FALSE(c.finished(10));
  }
  EXPECT_NEAR(c.ratio(), 0.1, 1e-15);
}

// Two components that contract by 0.1 each, of which the second is zero until the third iteration: its first
// correction is infinitely large in units of it, and says nothing about the next one.
TEST(Convergence, GoesOnAfterTheFirstCorrectionOfAComponentThatWasZero) {
  Convergence<double> convergence;
  double correction = 0.1, second = 0;
  int iterations = 0;
  do {
    ++iterations;
    const bool arrives = iterations == 3;
    convergence.begin_iteration();
    convergence.add(correction, 1, 1);
    convergence.add(arrives ? 1e-3 : second, 0, iterations > 3 ? 1e-3 : 0);
    second = arrives ? 1e-4 : second / 10;
    correction /= 10;
  } while (!convergence.finished(50));
  EXPECT_EQ(convergence.status(), Status::converged);
  EXPECT_GT(iterations, 12);  // corrections reach round-off, and do not end at the fourth
}

// Ten million additions of 0.1. The exact sum of the doubles is n * 0.1 in quad.
TEST(Summation, KeepsWhatItRoundsOff) {
  constexpr int n = 10'000'000;
  double compensated = 0, carry = 0, plain = 0, unused = 0;
  for (int k = 0; k < n; ++k) {
    add_to(compensated, carry, 0.1, true);
    add_to(plain, unused, 0.1, false);
  }
  const Quad exact = Quad(n) * Quad(0.1);
  // One unit in the last place of 1e6, 1.2e-10.
  const double bound = 1.2e-10;
  EXPECT_LE(static_cast<double>(abs(Quad(compensated) - exact)), bound);
  EXPECT_LE(static_cast<double>(abs(Quad(compensated) + Quad(carry) - exact)), 1e-16 * n * 1e-9);
  EXPECT_GT(static_cast<double>(abs(Quad(plain) - exact)), 1e5 * bound);  // control
  EXPECT_EQ(unused, 0);
}

TEST(Summation, WorksForSignsDualsAndQuads) {
  // A random walk with increments of both signs, in duals, against the sum in quad.
  using D = Dual<double, 1>;
  D sum(1.0), carry(0.0);
  Quad value(1), slope(0), fine(1), fine_carry(0);
  for (int k = 0; k < 100000; ++k) {
    D increment(std::sin(k * 0.7) * 1e-3);
    increment.derivative[0] = std::cos(k * 0.3) * 1e-2 + 1e-2;
    compensated_add(sum, carry, increment);
    compensated_add(fine, fine_carry, Quad(increment.value));
    value += Quad(increment.value);
    slope += Quad(increment.derivative[0]);
  }
  EXPECT_LE(static_cast<double>(abs(Quad(sum.value) - value)), 2.3e-16);
  EXPECT_LE(static_cast<double>(abs(Quad(sum.derivative[0]) - slope)), 1e3 * 1.2e-16);
  EXPECT_LE(static_cast<double>(abs(fine - value)), 1e-30);
}

// In quad the sum of two doubles of like size is exact.
TEST(Summation, TheSumOfTwoLosesNothing) {
  for (const double a : {1.0, 1e-3, -1e10, 0.1})
    for (const double b : {0.1, 1e10, -1.0 / 3, 1e-9}) {
      double sum = 0, lost = 0;
      two_sum(a, b, sum, lost);
      EXPECT_EQ(sum, a + b);
      EXPECT_EQ(Quad(sum) + Quad(lost), Quad(a) + Quad(b)) << a << ' ' << b;
    }
}

// A million increments 0.1 + 1e-18, of which the second part is below the round-off of the first.
TEST(Summation, KeepsWhatTheIncrementHasLost) {
  constexpr int n = 1'000'000;
  double with = 0, carry = 0, without = 0, other = 0, plain = 0, unused = 0;
  for (int k = 0; k < n; ++k) {
    add_sum(with, carry, 0.1, 1e-18, true);
    add_to(without, other, 0.1, true);
    add_sum(plain, unused, 0.1, 1e-18, false);
  }
  const Quad exact = Quad(n) * (Quad(0.1) + Quad(1e-18));
  // What each step rounds off of the carry, whose own round-off is 1e-28 where sums are below 1e5.
  EXPECT_LE(static_cast<double>(abs(Quad(with) + Quad(carry) - exact)), 1e-20);
  EXPECT_GT(static_cast<double>(abs(Quad(without) + Quad(other) - exact)), 5e-13);  // controls
  EXPECT_GT(static_cast<double>(abs(Quad(plain) - exact)), 1e-9);
  EXPECT_EQ(unused, 0);
}

}  // namespace
