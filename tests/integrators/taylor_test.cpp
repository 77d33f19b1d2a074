// Taylor's method: steps on a linear system are the partial sums of the exponential, and runs with a
// tolerance meet closed forms, and on a nonlinear system a method that shares nothing with this one.
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

struct Falling {  // a polynomial of time of degree two
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = T(-1);
  }
};
struct Draining {  // z0' = sqrt(z1), which is no number once z1 is negative; z1 is a polynomial of time
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = sqrt(z[1]);
    rate[1] = T(-1);
  }
};
template <class T>
StepperPointer<T> stepper(std::shared_ptr<const Model> model, const Assignments& parameters = {},
                          const char* method = "taylor") {
  return integrators().get(method, "integrator").make(parameters)->stepper(std::move(model), T());
}

TEST(Taylor, StepsArePartialSumsOfTheExponential) {
  const Quad h = Quad(3) / Quad(10);
  Quad sum(1), term(1);
  for (int order = 1; order <= 12; ++order) {
    term = term * h / Quad(order);
    sum += term;
    std::vector<Quad> z{Quad(1)};
    std::int64_t completed = 0;
    EXPECT_EQ(stepper<Quad>(sample_of(Growth{}), {{"order", std::to_string(order)}})
                  ->advance(Quad(0), 0, h, 1, z, completed),
              Status::converged);
    EXPECT_LE(static_cast<double>(abs(z[0] - sum)), 1e-33) << order;  // a few roundings of quad
  }
}

// e^t over ten time units, forwards and backwards. The terms left out of a step are below the tolerance times
// the scale of the motion so far; growing, e^t carries the errors of about ten steps on without amplifying
// them relatively, and decaying, what is allowed is relative to the beginning.
template <class T>
void taylor_meets_tolerances(std::initializer_list<double> tolerances) {
  for (const double tolerance : tolerances)
    for (const int direction : {1, -1}) {
      const auto growing = stepper<T>(sample_of(Growth{}));
      std::vector<T> z{T(1)};
      T t(0);
      const T end = T(direction) * T(10);
      ASSERT_EQ(growing->advance_to(t, end, T(tolerance), z), Status::converged) << tolerance;
      EXPECT_TRUE(t == end);
      const Quad error = abs(Quad(z[0]) / exp(Quad(end)) - Quad(1));
      EXPECT_LE(static_cast<double>(error), 100 * tolerance * (direction > 0 ? 1 : std::exp(10)))
          << tolerance;
      EXPECT_LE(growing->counters().steps, 100) << tolerance;
      EXPECT_GE(growing->counters().steps, 3) << tolerance;
    }
}
TEST(Taylor, MeetsTolerancesInDouble) { taylor_meets_tolerances<double>({1e-4, 1e-7, 1e-10, 1e-13}); }
TEST(Taylor, MeetsTolerancesInQuad) { taylor_meets_tolerances<Quad>({1e-10, 1e-16, 1e-22, 1e-28, 1e-31}); }

// Kepler's motion at eccentricity 0.6 to 29 digits, against extrapolation, which evaluates the field and
// never its series.
TEST(Taylor, AgreesWithExtrapolation) {
  const std::shared_ptr<const Model> kepler = systems().get("kepler", "system").make({});
  std::vector<std::vector<Quad>> ends;
  for (const char* method : {"taylor", "extrapolation"}) {
    std::vector<Quad> z;
    for (const Real& x : kepler->initial()) z.push_back(x.quad());
    Quad t(0);
    ASSERT_EQ(stepper<Quad>(kepler, {}, method)->advance_to(t, Quad(4), Quad(1e-30), z), Status::converged);
    ends.push_back(z);
  }
  for (std::size_t k = 0; k < ends[0].size(); ++k)
    EXPECT_LE(static_cast<double>(abs(ends[0][k] - ends[1][k])), 1e-28) << k;
}

// Where the last coefficients vanish the solution is a polynomial, and one step goes all the way.
TEST(Taylor, PolynomialsTakeOneStep) {
  const auto falling = stepper<double>(sample_of(Falling{}, {0, 0}));
  std::vector<double> z{0, 0};
  double t = 0;
  EXPECT_EQ(falling->advance_to(t, 1000.0, 1e-12, z), Status::converged);
  EXPECT_EQ(falling->counters().steps, 1);
  EXPECT_DOUBLE_EQ(z[0], -500000.0);
}

// A component that is no number stops the run where it is, although the others allow any step.
TEST(Taylor, LosesNoNaN) {
  const auto draining = stepper<double>(sample_of(Draining{}, {0, 1}));
  std::vector<double> z{0, -1};
  double t = 0;
  EXPECT_EQ(draining->advance_to(t, 1.0, 1e-8, z), Status::non_finite);
  EXPECT_EQ(t, 0.0);
}

TEST(Taylor, RefusesInDouble) { expect_refused_tolerances<double>(*testing::method_named("taylor")); }
TEST(Taylor, RefusesInQuad) { expect_refused_tolerances<Quad>(*testing::method_named("taylor")); }

}  // namespace
}  // namespace pfaff
