// Extrapolation of the midpoint rule: one column is that rule, closed forms of what more columns make of it,
// and runs with a tolerance in both precisions.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

#include "adaptive_samples.hpp"
#include "methods.hpp"

namespace pfaff {
namespace {

using testing::expect_refused_tolerances;
using testing::Growth;
using testing::sample_of;

std::unique_ptr<MethodInstance> extrapolation(const Assignments& parameters = {}) {
  return integrators().get("extrapolation", "integrator").make(parameters);
}

// On z' = z a step with n substeps multiplies z by a polynomial in h. With two it is 1 + h + h^2/2; with
// four, by d_{m+1} = d_{m-1} + (1 + d_m) h/2 with d_1 = h/4,
//   1 + h + h^2/2 + h^3/8 + h^4/32... , d_2 = h/2 (1 + h/4), d_3 = h/4 + h/2 (1 + d_2), d_4 = d_2 + h/2 (1 +
//   d_3),
// and two columns combine them to d_4 + (d_4 - d_2(n = 2))/3.
TEST(Extrapolation, StepsAreTheClosedForm) {
  const Quad h = Quad(3) / Quad(10);
  const Quad two = h + h * h / Quad(2);
  const Quad d1 = h / Quad(4), half = h / Quad(2), d2 = half * (Quad(1) + d1),
             d3 = d1 + half * (Quad(1) + d2), d4 = d2 + half * (Quad(1) + d3);
  const std::vector<Quad> expected{Quad(1) + two, Quad(1) + d4 + (d4 - two) / Quad(3)};
  for (std::size_t columns = 1; columns <= 2; ++columns) {
    const auto method = extrapolation({{"columns", std::to_string(columns)}});
    const auto z = testing::after_steps<Quad>(*method, sample_of(Growth{}), h, 1, {Quad(1)});
    EXPECT_LE(static_cast<double>(abs(z[0] - expected[columns - 1])), 1e-33) << columns;
  }
}

// e^t over ten time units at tolerances down to 1e-30: the error is in proportion to the tolerance, the time
// is met exactly, forwards and backwards, and smaller tolerances do not take many times more steps.
template <class T>
void extrapolation_meets_tolerances(std::initializer_list<double> tolerances) {
  for (const double tolerance : tolerances)
    for (const int direction : {1, -1}) {
      const auto stepper = extrapolation()->stepper(sample_of(Growth{}), T());
      std::vector<T> z{T(1)};
      T t(0);
      const T end = T(direction) * T(10);
      ASSERT_EQ(stepper->advance_to(t, end, T(tolerance), z), Status::converged) << tolerance;
      EXPECT_TRUE(t == end);
      const Quad error = abs(Quad(z[0]) / exp(Quad(end)) - Quad(1));
      // Growing, e^t carries the errors on, a hundred of them at most; decaying, what is allowed is relative
      // to the scale of the motion, which is that of its beginning.
      EXPECT_LE(static_cast<double>(error), 100 * tolerance * (direction > 0 ? 1 : std::exp(10)))
          << tolerance;
      EXPECT_LE(stepper->counters().steps, 200) << tolerance;
      EXPECT_GE(stepper->counters().steps, 3) << tolerance;
    }
}
TEST(Extrapolation, MeetsTolerancesInDouble) {
  extrapolation_meets_tolerances<double>({1e-4, 1e-7, 1e-10, 1e-13});
}
TEST(Extrapolation, MeetsTolerancesInQuad) {
  extrapolation_meets_tolerances<Quad>({1e-10, 1e-16, 1e-22, 1e-28, 1e-30});
}

// q'' = -q, and from the time c on 1 - q: from (1, 0), q = cos t, and 1 - cos(t - c) more behind c.
struct Switched {
  static constexpr int dimension = 2;
  Real c = 0;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = select(t - T(c), T(1), T(0)) - z[0];
  }
};
// Rows that do not look where the field jumps agree on a wrong step: the error was .01 whatever the
// tolerance. A step ends within what is allowed of the jump at best, and so many of them are tried near it.
template <class T>
void sees_jumps(double tolerance) {
  for (int k = 0; k < 40; ++k) {
    const Real c = Real::fraction(513 + 225 * k, 1000);
    SystemDescriptor descriptor{.name = "switched", .title = "", .reference = "landau-lifshitz1976"};
    descriptor.coordinates = {{"q", ""}, {"p", ""}};
    descriptor.initial = {1, 0};
    const auto stepper = extrapolation()->stepper(make_model(descriptor, Switched{c}), T());
    std::vector<T> z{T(1), T(0)};
    T t(0);
    ASSERT_EQ(stepper->advance_to(t, T(10), T(tolerance), z), Status::converged);
    const Quad end(10), right = cos(end) + Quad(1) - cos(end - c.quad());
    EXPECT_LE(static_cast<double>(abs(Quad(z[0]) - right)), 1000 * tolerance) << c.value();
  }
}
TEST(Extrapolation, SeesWhereAFieldJumps) { sees_jumps<double>(1e-8); }
TEST(Extrapolation, SeesWhereAFieldJumpsInQuad) { sees_jumps<Quad>(1e-16); }

struct Pole {
  static constexpr int dimension = 1;
  Real c = 0;
  template <class T>
  void field(const T& t, In<T> /*z*/, Out<T> rate) const {
    rate[0] = T(1) / (t - T(c));
  }
};
TEST(Extrapolation, DoesNotStepOverPoles) {
  for (int k = 0; k < 40; ++k) {
    SystemDescriptor descriptor{.name = "pole", .title = "", .reference = "landau-lifshitz1976"};
    descriptor.coordinates = {{"z", ""}};
    descriptor.initial = {1};
    const Real c = Real::fraction(2013 + 637 * k, 10000);
    const auto stepper = extrapolation()->stepper(make_model(descriptor, Pole{c}), 0.0);
    std::vector<double> z{1};
    double t = 0;
    EXPECT_NE(stepper->advance_to(t, 3, 1e-6, z), Status::converged) << c.value();
    EXPECT_NEAR(t, c.value(), 1e-3);
  }
}

TEST(Extrapolation, RefusesInDouble) { expect_refused_tolerances<double>(*extrapolation()); }
TEST(Extrapolation, RefusesInQuad) { expect_refused_tolerances<Quad>(*extrapolation()); }

}  // namespace
}  // namespace pfaff
