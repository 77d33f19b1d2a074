// Steps of a method's choosing do not depend on the units of a system: motions with closed forms, small and
// large, in every registered method that takes a tolerance.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

#include "adaptive_samples.hpp"

namespace pfaff {
namespace {

using testing::sample_of;
using Doubles = std::vector<double>;

struct Spring {  // q'' = -(k/m) q
  static constexpr int dimension = 2;
  double m = 1, k = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / T(2 * Real(Quad(m)));
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return T(Real(Quad(k))) * q[0] * q[0] / 2;
  }
};
struct Swinging {  // q'' = -sin q
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -cos(q[0]);
  }
};
struct Springs {  // q1'' = -25 q1, q2'' = -q2 / 100
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return 25 * q[0] * q[0] / 2 + q[1] * q[1] / 200;
  }
};
struct TimedPair {  // q1'' = -q1 drives q2'' = -4 q2 + q1; q3'' = -q3 stays where it is
  static constexpr int dimension = 6;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < 3; ++k) rate[k] = z[k + 3];
    rate[3] = -z[0];
    rate[4] = z[0] - 4 * z[1];
    rate[5] = -z[2];
  }
};
struct Dropped {  // q'' = -1 - q
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] + q[0] * q[0] / 2;
  }
};
struct ShakenSpring {  // q'' = -q + sin t
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = sin(t) - z[0];
  }
};
struct Decaying {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = -z[0];
  }
};
struct RoundedRate {
  static constexpr int dimension = 3;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
    rate[2] = (z[0] + 1) * (z[0] + 1) - z[0] * z[0] - 2 * z[0] - 1;
  }
};
struct Chain {  // 32 masses between springs of unit stiffness, q then p
  static constexpr int dimension = 64;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < 32; ++k) {
      rate[k] = z[32 + k];
      rate[32 + k] = -2 * z[k];
      if (k > 0) rate[32 + k] = rate[32 + k] + z[k - 1];
      if (k < 31) rate[32 + k] = rate[32 + k] + z[k + 1];
    }
  }
};

struct ChosenRun {
  Doubles end;
  double steps = 0;
  Status status = Status::converged;
};
template <class S>
ChosenRun chosen_run(const std::string& method, const S& system, const Doubles& z, double time,
                     double tolerance, const Doubles& absolute = {}) {
  const auto stepper = integrators().get(method, "integrator").make({})->stepper(sample_of(system), double());
  ChosenRun result{z};
  double t = 0;
  result.status = stepper->advance_to(t, time, {tolerance, absolute}, result.end);
  result.steps = static_cast<double>(stepper->counters().steps);
  return result;
}

// Every registered method that takes a tolerance.
std::vector<std::string> adaptive_methods() {
  std::vector<std::string> names;
  for (const MethodPlugin* plugin : integrators().all())
    if (plugin->make({})->adaptive()) names.push_back(plugin->name());
  return names;
}
class ChosenSteps : public ::testing::TestWithParam<std::string> {};

// The same motion in units that differ by powers of two: k/m = 2^72, so that times are 2^-36 as long. The
// roots from which `taylor` takes its steps are rounded differently, by some units of round-off.
TEST_P(ChosenSteps, AreTheSameInAllUnits) {
  for (const double tolerance : {1e-5, 1e-10}) {
    const ChosenRun one = chosen_run(GetParam(), Spring{1, 1}, {1, 0.5}, 50, tolerance);
    for (const double size : {0x1p-33, 0x1p40}) {
      const ChosenRun other =
          chosen_run(GetParam(), Spring{0x1p-86, 0x1p-14}, {size, size * 0x1p-51}, 50 * 0x1p-36, tolerance);
      ASSERT_EQ(other.status, Status::converged);
      EXPECT_EQ(one.steps, other.steps);
      const double allowed = GetParam() == "taylor" ? 1e-13 : 0;
      EXPECT_NEAR(other.end[0] / size, one.end[0], allowed) << tolerance;
      EXPECT_NEAR(other.end[1] / (size * 0x1p-50), one.end[1], allowed) << tolerance;
    }
  }
}

// A thousand periods of an oscillator of atomic size and others: each has the error of the oscillator of size
// one, in its own units, and takes the steps of that one. 1e-6 is ten times what the steps of about 160000
// at 1e-10 make of it when their errors add up half at random.
TEST_P(ChosenSteps, OfSmallAndLargeOscillatorsAreAsGoodAsOfOne) {
  struct Case {
    double m, k, q;
  };
  const auto run = [&](const Case& c) {
    return chosen_run(GetParam(), Spring{c.m, c.k}, {c.q, 0}, 2000 * std::numbers::pi / std::sqrt(c.k / c.m),
                      1e-10);
  };
  const ChosenRun one = run({1, 1, 1});
  for (const Case& c : {Case{1e-26, 1e-4, 1e-10}, Case{1e24, 1e3, 1e-4}, Case{1e-31, 7e-2, 3e-12}}) {
    const ChosenRun other = run(c);
    ASSERT_EQ(other.status, Status::converged);
    EXPECT_NEAR(other.steps, one.steps, one.steps / 100) << c.q;
    EXPECT_NEAR(other.end[0] / c.q, 1, 1e-6) << c.q;
    EXPECT_NEAR(other.end[1] / (c.q * std::sqrt(c.k * c.m)), 0, 1e-6) << c.q;
  }
}

// A pendulum of small amplitude a has the frequency 1 - a^2/16 (and a third harmonic of a^2/192 beside it).
TEST_P(ChosenSteps, OfSmallSwings) {
  for (const double a : {1e-7, 1e-9, 3e-12}) {
    const ChosenRun swing = chosen_run(GetParam(), Swinging{}, {a, 0}, 10, 1e-8);
    ASSERT_EQ(swing.status, Status::converged);
    EXPECT_NEAR(swing.end[0] / a, std::cos(10 * (1 - a * a / 16)), 1e-6) << a;
  }
}

// Small coordinates beside large ones: each is right to its own digits.
TEST_P(ChosenSteps, JudgeEveryCoordinateByItself) {
  for (const auto& [small, large] : {std::pair{1e-3, 1e6}, std::pair{1e-8, 1e3}, std::pair{1e6, 1e-6}}) {
    const ChosenRun both = chosen_run(GetParam(), Springs{}, {small, large, 0, 0}, 10, 1e-10);
    ASSERT_EQ(both.status, Status::converged);
    EXPECT_NEAR(both.end[0] / small, std::cos(50), 1e-7) << small;
    EXPECT_NEAR(both.end[1] / large, std::cos(1), 1e-8) << large;
    EXPECT_NEAR(both.end[2] / small, -5 * std::sin(50), 1e-6) << small;
    EXPECT_NEAR(both.end[3] / large, -std::sin(1) / 10, 1e-8) << large;
  }
}

// Coordinates that begin at zero, are driven from there on, or stay there; states of any size.
TEST_P(ChosenSteps, OfCoordinatesThatBeginAtZero) {
  for (const double size : {1.0, 1e-9, 1e7}) {
    const ChosenRun cosine = chosen_run(GetParam(), TimedPair{}, {size, 0, 0, 0, 0, 0}, 20, 1e-10);
    ASSERT_EQ(cosine.status, Status::converged);
    EXPECT_NEAR(cosine.end[0] / size, std::cos(20), 1e-7);
    EXPECT_NEAR(cosine.end[1] / size, (std::cos(20) - std::cos(40)) / 3, 1e-7);
    EXPECT_EQ(cosine.end[2], 0);
    // Here nothing drives the second oscillator at the start, but later on.
    const ChosenRun sine = chosen_run(GetParam(), TimedPair{}, {0, 0, 0, size, 0, 0}, 20, 1e-10);
    ASSERT_EQ(sine.status, Status::converged);
    EXPECT_NEAR(sine.end[0] / size, std::sin(20), 1e-7);
    EXPECT_NEAR(sine.end[1] / size, (std::sin(20) - std::sin(40) / 2) / 3, 1e-7);
    EXPECT_LE(sine.steps, 3000);
  }
  const ChosenRun drop = chosen_run(GetParam(), Dropped{}, {0, 0}, 10, 1e-10);
  ASSERT_EQ(drop.status, Status::converged);
  EXPECT_NEAR(drop.end[0], std::cos(10) - 1, 1e-8);
  EXPECT_NEAR(drop.end[1], -std::sin(10), 1e-8);
}

// What has died away is judged by what it was: e^-700 asks for no more steps than e^-30 does, in whose last
// thirty units of time nothing counts any more. Stiffness bounds the steps of explicit methods.
TEST_P(ChosenSteps, OfDecayAreThoseOfItsBeginning) {
  for (const double size : {1.0, 1e-12}) {
    const ChosenRun decay = chosen_run(GetParam(), Decaying{}, {size}, 30, 1e-10);
    ASSERT_EQ(decay.status, Status::converged);
    EXPECT_NEAR(decay.end[0] / size, std::exp(-30), 1e-8);
    EXPECT_LE(decay.steps, 150);
  }
}

// The first traces of a wave through a chain at rest are of no account. An eigenvector expansion of the chain
// gives q_1(t) = (2/33) sum_j sin^2(j pi/33) cos(2 t sin(j pi/66)).
TEST_P(ChosenSteps, OfAWaveThroughAChainAtRest) {
  Doubles z(64);
  z[0] = 1e-6;
  const ChosenRun wave = chosen_run(GetParam(), Chain{}, z, 10, 1e-8);
  ASSERT_EQ(wave.status, Status::converged);
  double expected = 0;
  for (int j = 1; j <= 32; ++j)
    expected += 2.0 / 33 * std::pow(std::sin(j * std::numbers::pi / 33), 2) *
                std::cos(20 * std::sin(j * std::numbers::pi / 66));
  EXPECT_NEAR(wave.end[0] / 1e-6, expected, 1e-6);
  EXPECT_LE(wave.steps, 3000);
}

// The rate of the third coordinate is zero but for rounding errors, which no step makes right, whatever its
// scale: (q + 1)^2 - q^2 - 2 q - 1. Without the noise that is allowed the run does not end.
TEST_P(ChosenSteps, OfACoordinateThatOnlyRoundingMoves) {
  const ChosenRun one = chosen_run(GetParam(), Spring{}, {1, 0}, 20, 1e-10);
  const ChosenRun both = chosen_run(GetParam(), RoundedRate{}, {1, 0, 0}, 20, 1e-10);
  ASSERT_EQ(both.status, Status::converged);
  EXPECT_NEAR(both.end[0], std::cos(20), 1e-8);
  EXPECT_NEAR(both.end[2], 0, 1e-13);
  EXPECT_LE(both.steps, 20 * one.steps);
}

// At the upper equilibrium sin q is what rounding leaves of pi, and no step makes that right.
TEST_P(ChosenSteps, OfAPendulumAtItsUpperEquilibrium) {
  const ChosenRun upright = chosen_run(GetParam(), Swinging{}, {std::numbers::pi, 0}, 5, 1e-10);
  ASSERT_EQ(upright.status, Status::converged);
  EXPECT_NEAR(upright.end[0], std::numbers::pi, 1e-13 * std::exp(5));
  EXPECT_LE(upright.steps, 200);
}

TEST_P(ChosenSteps, OfAStartAtRestInZeroNeedAnAbsoluteTolerance) {
  for (const double time : {10.0, -10.0}) {
    EXPECT_THROW((void)chosen_run(GetParam(), ShakenSpring{}, {0, 0}, time, 1e-10), InputError);
    const ChosenRun shaken = chosen_run(GetParam(), ShakenSpring{}, {0, 0}, time, 1e-10, {1e-10, 1e-10});
    ASSERT_EQ(shaken.status, Status::converged);
    EXPECT_NEAR(shaken.end[0], (std::sin(time) - time * std::cos(time)) / 2, 1e-7);
  }
  // A hundred thousand times as much allowed in both coordinates is made use of.
  const ChosenRun careless = chosen_run(GetParam(), ShakenSpring{}, {0, 0}, 10, 1e-10, {1e-5, 1e-5});
  EXPECT_LT(careless.steps, chosen_run(GetParam(), ShakenSpring{}, {0, 0}, 10, 1e-10, {1e-10, 1e-10}).steps);
}

INSTANTIATE_TEST_SUITE_P(Methods, ChosenSteps, ::testing::ValuesIn(adaptive_methods()), [](const auto& each) {
  std::string name;
  for (const char c : each.param) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

}  // namespace
}  // namespace pfaff
