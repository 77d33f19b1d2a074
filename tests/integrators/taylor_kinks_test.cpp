// Taylor's method on fields with kinks: a step is made of one series on either side, to the round-off of the
// closed forms, in double and quad, with fixed steps and with steps that are chosen.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/numbers/special.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/kinks.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

#include "adaptive_samples.hpp"
#include "methods.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::method_named;
using pfaff::testing::sample_of;

struct Well {  // q'' = -sign(q): parabolas, with the period 4 sqrt(2) from q = 1 at rest
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -sign(z[0]);
  }
};
template <class T>
std::vector<T> in_the_well(const T& time) {
  const T quarter = sqrt(T(2));
  T rest = time;
  int passed = 0;  // quarters of the period
  while (rest > quarter) rest = rest - quarter, ++passed;
  const T fall = passed % 2 == 0 ? rest : quarter - rest;
  const T height = T(1) - fall * fall / T(2), speed = fall;
  const bool below = passed % 4 == 1 || passed % 4 == 2;
  return {below ? -height : height, passed % 4 < 2 ? -speed : speed};
}

struct Rectified {  // z' = |sin t| - z/2 with a kink of the time alone, and y' = max(z, 1/2)
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = abs(sin(t));
    rate[1] = max(z[0], T(1) / 2);
  }
};
struct Sliding {  // from 1 the state reaches 0 at t = 1, where neither side is left
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = select(z[0], T(-1), T(1));
  }
};

template <class T>
std::vector<T> moved(const std::shared_ptr<const Model>& model, const T& h, std::int64_t steps,
                     std::vector<T> z, Status expected = Status::converged) {
  const auto stepper = method_named("taylor", {{"order", "4"}})->stepper(model, T());
  std::int64_t completed = 0;
  EXPECT_EQ(stepper->advance(T(0), 0, h, steps, z, completed), expected);
  return z;
}

// The motion is a polynomial of degree two on either side, so that order 4 is exact; 100 steps pass the
// bottom 35 times, each with the rounding of a bisected time.
TEST(TaylorKinks, StepsAreExactOnEitherSide) {
  const auto model = sample_of(Well{});
  const auto z = moved<double>(model, 0.5, 100, {1, 0});
  const auto expected = in_the_well<double>(50);
  EXPECT_NEAR(z[0], expected[0], 1e-12);
  EXPECT_NEAR(z[1], expected[1], 1e-12);
  const auto exact = in_the_well<Quad>(Quad(50));
  const auto quad = moved<Quad>(model, Quad(1) / Quad(2), 100, {Quad(1), Quad(0)});
  EXPECT_LT(static_cast<double>(abs(quad[0] - exact[0])), 1e-30);
  EXPECT_LT(static_cast<double>(abs(quad[1] - exact[1])), 1e-30);
}
// Without the kink the same step would be wrong in the second digit.
TEST(TaylorKinks, OneSeriesForTheWholeStepWouldBeWrong) {
  const auto model = sample_of(Well{});
  TaylorExpansion<double> expansion(model->tape(Formula::field), 4);
  const std::vector<double> z{0.1, -1};
  expansion.expand(0, z.data());
  const auto kink = expansion.first_kink(0.5);
  ASSERT_TRUE(kink.has_value());
  const double reached = 0.1 + expansion.increment(kink->behind, 0);  // 1/10 - s - s^2/2 = 0
  EXPECT_NEAR(kink->behind, std::sqrt(1.2) - 1, 1e-15);
  EXPECT_LE(reached, 0);
  EXPECT_FALSE(expansion.first_kink(0.05).has_value());
  const double series = 0.1 + expansion.increment(0.5, 0), right = moved<double>(model, 0.5, 1, z)[0];
  EXPECT_GT(std::abs(series - right), 0.1);
}

// |sin t| integrates to 2 over half a turn.
TEST(TaylorKinks, KinksOfTheTimeAndOfTheStateAreSeen) {
  const auto model = sample_of(Rectified{});
  const auto stepper = method_named("taylor", {{"order", "20"}})->stepper(model, 0.0);
  std::vector<double> z{0, 0};
  std::int64_t completed = 0;
  ASSERT_EQ(stepper->advance(0, 0, 0.25, 40, z, completed), Status::converged);
  const double rest = 10 - 3 * std::acos(-1.0);  // three half turns and 10 - 3 pi of the next
  EXPECT_NEAR(z[0], 6 + 1 - std::cos(rest), 1e-12);
  // z = 1 - cos t up to pi exceeds 1/2 from t = pi/3 on; before, y grows at the rate 1/2. After k half turns
  // z is 2 k + 1 - cos, which is never less.
  const double pi = std::acos(-1.0);
  double y = pi / 6 + (pi - pi / 3) - (std::sin(pi) - std::sin(pi / 3));
  for (int k = 1; k < 3; ++k) y += (2 * k + 1) * pi;
  y += 7 * rest - std::sin(rest);
  EXPECT_NEAR(z[1], y, 1e-11);
}

TEST(TaylorKinks, ChosenStepsEndThere) {
  const auto model = sample_of(Well{});
  const auto run = [&]<class T>(const T& tolerance, const T& end) {
    const auto stepper = method_named("taylor")->stepper(model, T());
    std::vector<T> z{T(1), T(0)};
    T t(0);
    EXPECT_EQ(stepper->advance_to(t, end, tolerance, z), Status::converged);
    EXPECT_LT(stepper->counters().steps, 60);  // 17 passages, and what is between them in one step or two
    const auto exact = in_the_well<T>(end);
    return std::max(abs(z[0] - exact[0]), abs(z[1] - exact[1]));
  };
  EXPECT_LT(run(1e-10, 25.0), 1e-12);
  EXPECT_LT(static_cast<double>(run(Quad(1e-25), Quad(25))), 1e-29);
}

// A spring that becomes stiffer at t = 23/10, and two bodies that pass through each other and attract by a
// constant force. Rounding leaves the time, or the difference of the positions, on the near side of the kink.
struct Stiffened {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0] - select(t - T(23) / T(10), T(7) / T(10), T(0)) * z[0];
  }
};
struct Bodies {
  static constexpr int dimension = 4;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[2], rate[1] = z[3];
    rate[2] = -z[0] - sign(z[0] - z[1]);
    rate[3] = -z[1] + sign(z[0] - z[1]);
  }
};
TEST(TaylorKinks, AreLeftBehindWhereRoundingStaysBeforeThem) {
  const auto stepped = [](const auto& model, auto h, std::int64_t steps, auto z) {
    using T = decltype(h);
    const auto stepper = method_named("taylor", {{"order", "20"}})->stepper(model, T());
    std::int64_t completed = 0;
    EXPECT_EQ(stepper->advance(T(0), 0, h, steps, z, completed), Status::converged) << static_cast<double>(h);
    return z;
  };
  const auto spring = sample_of(Stiffened{}), bodies = sample_of(Bodies{});
  const double stiffness = std::sqrt(1.7);
  for (const double h : {0.1, 0.05, 0.02, 0.01, 0.005, 0.023, 0.046, 0.0023, 0.115, 0.23}) {
    const auto z = stepped(spring, h, std::lround(6.9 / h), std::vector<double>{0.2, 0});
    const double q = 0.2 * std::cos(2.3), p = -0.2 * std::sin(2.3), s = stiffness * 4.6;
    EXPECT_NEAR(z[0], q * std::cos(s) + p / stiffness * std::sin(s), 1e-13) << h;
  }
  (void)stepped(spring, Quad(1) / Quad(100), 690, std::vector<Quad>{Quad(1) / Quad(5), Quad(0)});
  for (int k = 1; k <= 40; ++k) {
    const double h = 0.0015 * k;
    const auto z = stepped(bodies, h, std::lround(12 / h), std::vector<double>{1, 0.3, 0, 0.1});
    const double energy = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2] + z[3] * z[3]) / 2 + std::abs(z[0] - z[1]);
    EXPECT_NEAR(energy, (1 + 0.09 + 0.01) / 2 + 0.7, 1e-12) << h;
  }
}

// A motion that stays at a jump of its field ends with a status, soon.
TEST(TaylorKinks, AMotionThatStaysAtAJumpEnds) {
  const auto model = sample_of(Sliding{});
  // The state is that before the step that fails: at t = 1 it is at the jump, within rounding.
  const auto z_there = moved<double>(model, 0.3, 40, {1}, Status::not_converged);
  EXPECT_NEAR(z_there[0], 0.1, 1e-15);
  const auto stepper = method_named("taylor")->stepper(model, 0.0);
  std::vector<double> z{1};
  double t = 0;
  EXPECT_EQ(stepper->advance_to(t, 10, 1e-10, z), Status::not_converged);
  EXPECT_NEAR(t, 1, 1e-9);
}
}  // namespace
