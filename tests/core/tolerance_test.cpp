// What a step may err by: the scales of coordinates along a motion, absolute tolerances beside them, starts
// at rest, rounding errors of rates, and the step to begin with.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/tolerance.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {
namespace {

struct Springs {  // two oscillators, q'' = -q and q'' = -4 q
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2 + 2 * q[1] * q[1];
  }
};
struct Cancelling {  // z' = the difference of two numbers of size one, which is zero at z = 1/3
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = (T(3) * z[0] - T(1)) * (T(3) * z[0] + T(5));
  }
};
template <class S>
Problem<double> problem_of(S system, std::vector<Real> initial) {
  return Problem<double>(
      make_model({.name = "sample", .title = "", .reference = "", .initial = std::move(initial)}, system));
}
Problem<double> two_springs() { return problem_of(Springs{}, {1, 0, 0, 0}); }

using Components = std::vector<double>;
Components scales_of(const CoordinateScales<Problem<double>>& scales) {
  return {scales.get().begin(), scales.get().end()};
}

TEST(CoordinateScales, AreTheStateOrWhatAStepAdds) {
  CoordinateScales<Problem<double>> scales(two_springs());
  const Components z{3, -2, 0.5, 1e-3}, rate{0.5, 1e-3, -3, 8};
  scales.find(1e-6, z, rate, -0.25);  // the sign of a step does not matter
  EXPECT_EQ(scales_of(scales), (Components{3, 2, 0.75, 2}));
}

TEST(CoordinateScales, AreTheLargestOfTheStepsThatWereKept) {
  CoordinateScales<Problem<double>> scales(two_springs());
  const Components large{3, -2, 0.5, 1}, small{0.1, 0, 0, 0.2}, still{0, 0, 0, 0};
  scales.find(1e-6, small, still, 1);
  scales.find(1e-6, large, still, 1);
  scales.keep();
  scales.find(1e-6, {Components{100, 100, 100, 100}}, still, 1);  // a step that was rejected
  scales.find(1e-6, small, still, 1);
  EXPECT_EQ(scales_of(scales), (Components{3, 2, 0.5, 1}));
}

// Only a zero has the scale of its group: 1e-9 beside 1e6 keeps its own. Positions do not count for momenta.
TEST(CoordinateScales, OfZerosAreThoseOfTheGroup) {
  CoordinateScales<Problem<double>> scales(two_springs());
  const Components still{0, 0, 0, 0};
  scales.find(1e-6, {Components{1e6, 1e-9, 7, 0}}, still, 1);
  EXPECT_EQ(scales_of(scales), (Components{1e6, 1e-9, 7, 7}));
  scales.find(1e-6, {Components{0, 2, 0, 0}}, still, 1);
  EXPECT_EQ(scales_of(scales), (Components{2, 2, 0, 0}));
  // A group that is zero by state and rate has the size that it gets.
  scales.find(1e-6, {Components{0, 2, 0, 0}}, still, 1, {Components{0, 2, 5, 0}});
  EXPECT_EQ(scales_of(scales), (Components{2, 2, 5, 5}));
  // What is below the square of round-off beside the group, 4.9e-32, counts as zero.
  scales.find(1e-6, {Components{1, 1e-31, 1, 1e-32}}, still, 1);
  EXPECT_EQ(scales_of(scales), (Components{1, 1e-31, 1, 1}));
}

TEST(CoordinateScales, AbsoluteTolerancesAreAllowedBeside) {
  CoordinateScales<Problem<double>> scales(two_springs());
  const Components z{4, 0, 1, 0}, still{0, 0, 0, 0}, absolute{0, 0.5, 0, 0.25};
  const Tolerance<double> tolerance(0.125, absolute);
  scales.find(tolerance, z, still, 1);
  EXPECT_EQ(scales_of(scales), (Components{4, 8, 1, 3}));
  // 1/8 of 8 is allowed in the second coordinate, half of that is made; none is allowed to be infinite.
  EXPECT_EQ(scales.judge(tolerance, {Components{0, -0.5, 0, 0}}), 0.5);
  EXPECT_EQ(scales.judge(tolerance, {Components{0, -0.5, 0.25, 0}}), 2);
  EXPECT_TRUE(std::isinf(scales.judge(tolerance, {Components{0, std::nan(""), 0, 0}})));
}

TEST(CoordinateScales, AStartAtRestInZeroNeedsAbsoluteTolerances) {
  CoordinateScales<Problem<double>> scales(two_springs());
  const Components zero{0, 0, 0, 0}, push{0, 0, 1e-300, 0}, absolute{0, 0, 1e-9, 0};
  EXPECT_THROW(scales.find(1e-6, zero, zero, 1), InputError);
  EXPECT_NO_THROW(scales.find(1e-6, zero, push, 0));
  EXPECT_NO_THROW(scales.find({1e-6, absolute}, zero, zero, 1));
  EXPECT_EQ(scales_of(scales), (Components{0, 0, 1e-3, 0}));
}

// At z = 1/3 the rate is what rounding leaves of 3 z - 1, times six. Eight units of round-off of z change it
// by 8 * 2.2e-16 * 18/3, and eight times as much is allowed; where the field has no rounding errors, nothing
// is.
TEST(CoordinateScales, RoundingErrorsOfRatesAreAllowed) {
  const Problem<double> problem = problem_of(Cancelling{}, {1});
  const Components z{1.0 / 3}, rate{1e-17};
  CoordinateScales<Problem<double>> scales(problem);
  scales.find_noise(problem, 0, z, rate);
  scales.find(1e-12, z, rate, 0.5);
  const double noise = (scales.get()[0] - z[0]) * 1e-12 / 0.5, expected = 64 * 2.2e-16 * 6;
  EXPECT_GT(noise, expected / 2);
  EXPECT_LT(noise, expected * 2);
  const Problem<double> exact = two_springs();
  CoordinateScales<Problem<double>> without(exact);
  const Components zero{0, 0, 1, 0}, rates{1, 0, 0, 0};
  without.find_noise(exact, 0, zero, rates);
  without.find(1e-12, zero, rates, 0.5);
  EXPECT_EQ(without.get()[1], 0.5);  // of its group
}

// The first step follows the motion's own time, whatever its unit, and is not held up by a coordinate near
// zero; where nothing bends the motion it goes to the end.
TEST(CoordinateScales, TheFirstStepIsInTheTimeOfTheMotion) {
  const Problem<double> problem = two_springs();
  const auto first = [&](const Components& z, double end) {
    Components rate(4);
    problem.field(0, z, rate);
    return CoordinateScales<Problem<double>>(problem).first_step(problem, 1e-8, 0, end, z, rate);
  };
  for (const Components& z :
       {Components{1, 0, 0, 0}, Components{1e-17, 0, 1, 0}, Components{0, 0, 0, 1e-30}}) {
    const double h = first(z, 1000);
    EXPECT_GT(h, 1e-3) << z[0];
    EXPECT_LT(h, 0.5) << z[0];
    EXPECT_EQ(first(z, -1000), h) << z[0];
    EXPECT_LE(first(z, 1e-5), 1e-5) << z[0];
  }
  const Components one{1, 0.5, 0, 0.25};
  Components tiny = one;
  for (double& x : tiny) x *= 0x1p-100;
  EXPECT_EQ(first(one, 1000), first(tiny, 1000));
}

}  // namespace
}  // namespace pfaff
