// Extrapolation of the midpoint rule: one column is that rule, closed forms of what more columns make of it,
// and runs with a tolerance in both precisions.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/integrator.hpp>
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

TEST(Extrapolation, RefusesInDouble) { expect_refused_tolerances<double>(*extrapolation()); }
TEST(Extrapolation, RefusesInQuad) { expect_refused_tolerances<Quad>(*extrapolation()); }

}  // namespace
}  // namespace pfaff
