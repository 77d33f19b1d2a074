// Every exact solution that a system offers agrees with Taylor series of its field.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/scalars.hpp>

#include "../formula_values.hpp"
#include "motion.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

constexpr double t0 = 0.7;

template <class T>
std::vector<T> exact(const std::shared_ptr<const Model>& model, const Numbers& start, T elapsed) {
  std::vector<T> arguments, z(start.size());
  for (const Quad x : start) arguments.push_back(static_cast<T>(x));
  arguments.push_back(T(t0));
  Problem<T>(model).exact_solution(elapsed, arguments, z);
  return z;
}

// What errors are measured by: the change of the solution when the initial state and the time change by one
// part in one. Rounding them to a precision of u changes it by u times that.
double condition(const std::shared_ptr<const Model>& model, const Numbers& start, double elapsed) {
  using D = StepDual<double>;
  const std::size_t n = start.size();
  const Problem<D> problem(model);
  std::vector<double> rate(n), sum(n);
  const auto end = exact<double>(model, start, elapsed);
  Problem<double>(model).field(t0 + elapsed, end, rate);
  for (std::size_t k = 0; k < n; ++k) sum[k] = std::fabs(rate[k] * elapsed);
  for (std::size_t first = 0; first < n; first += step_directions) {
    std::vector<D> arguments, z(n);
    for (const Quad x : start) arguments.emplace_back(static_cast<double>(x));
    for (std::size_t d = 0; d < step_directions && first + d < n; ++d)
      arguments[first + d].derivative[d] = static_cast<double>(start[first + d]);
    arguments.emplace_back(t0);
    problem.exact_solution(D(elapsed), arguments, z);
    for (std::size_t k = 0; k < n; ++k)
      for (const double slope : z[k].derivative) sum[k] += std::fabs(slope);
  }
  return *std::max_element(sum.begin(), sum.end());
}

// Formulas of up to 500 operations whose roundings partly add up: 20 units in double, measured 9. In quad the
// error of the reference, which takes some hundred steps, is allowed for: 1000 units, measured 120.
constexpr double scaled_double_bound = 20 * 0x1p-53, scaled_quad_bound = 1e-31;
// Unscaled, where the problem is not ill-conditioned.
constexpr double plain_double_bound = 1e-13, plain_quad_bound = 1e-29, well_conditioned = 300;

// Compares one exact solution with a reference. A solution at a time that is off by 1e-9 must fail.
void compare(const std::shared_ptr<const Model>& model, const Numbers& start, double elapsed,
             const Numbers& reference) {
  Numbers rounded;  // the state a double run starts from
  for (const Quad x : start) rounded.emplace_back(static_cast<double>(x));
  const double scale = condition(model, start, elapsed);
  const double coarse = distance(exact<double>(model, start, elapsed), reference);
  const double fine = distance(exact<Quad>(model, start, Quad(elapsed)), reference);
  EXPECT_LE(coarse, scaled_double_bound * scale);
  EXPECT_LE(fine, scaled_quad_bound * scale);
  if (scale < well_conditioned) {
    EXPECT_LE(coarse, plain_double_bound);
    EXPECT_LE(fine, plain_quad_bound);
  }
  Numbers rate(start.size());
  Problem<Quad>(model).field(Quad(t0 + elapsed), reference, rate);
  const double moved = distance(rate, Numbers(start.size())) * std::fabs(elapsed);
  const double wrong = distance(exact<Quad>(model, start, Quad(elapsed) * Quad(1 + 1e-9)), reference);
  EXPECT_TRUE(moved <= 1e-3 * scale || wrong > 1e4 * scaled_quad_bound * scale) << "control";
}

constexpr double times[] = {0.1, 1, 10, 20};

void compare_at_all_times(const std::shared_ptr<const Model>& model, const Numbers& start) {
  const auto field = model->tape(Formula::field);
  Numbers reference = start;
  double now = 0;
  for (const double t : times) {
    reference = taylor_flow(field, Quad(t0) + Quad(now), reference, Quad(t) - Quad(now));
    now = t;
    compare(model, start, t, reference);
  }
  compare(model, start, -2.3, taylor_flow(field, Quad(t0), start, Quad(-2.3)));
}

std::vector<const SystemPlugin*> solved_systems() {
  std::vector<const SystemPlugin*> list;
  for (const SystemPlugin* plugin : systems().all())
    if (plugin->make({})->facets().has(Facet::exact_solution)) list.push_back(plugin);
  return list;
}

TEST(ExactSolution, AgreesWithTaylorSeries) {
  ASSERT_GE(solved_systems().size(), 5U);
  for (const SystemPlugin* plugin : solved_systems()) {
    Samples samples(2024);
    for (int k = 0; k < 50; ++k) {
      const Assignments parameters = samples.parameters(*plugin);
      const auto model = motion_of(plugin->make(parameters));
      const Numbers start = samples.start(*model);
      // Starts are doubles, so that a double and a quad run are the same problem.
      Numbers rounded;
      for (const Quad x : start) rounded.emplace_back(static_cast<double>(x));
      // Doubles do not meet velocity constraints, on which exact solutions hold.
      rounded = on_velocity_constraints(*plugin, parameters, rounded);
      SCOPED_TRACE(plugin->name() + " " + pfaff::testing::describe(parameters, rounded));
      compare_at_all_times(model, rounded);
    }
  }
}

TEST(ExactSolution, IsAGroup) {
  for (const SystemPlugin* plugin : solved_systems()) {
    Samples samples(7);
    for (int k = 0; k < 50; ++k) {
      const Assignments parameters = samples.parameters(*plugin);
      const auto model = motion_of(plugin->make(parameters));
      const Numbers start = on_velocity_constraints(*plugin, parameters, samples.start(*model));
      SCOPED_TRACE(plugin->name() + " " + pfaff::testing::describe(parameters, start));
      const Quad a = samples.quad(-5, 5), b = samples.quad(-5, 5);
      const double scale = condition(model, start, static_cast<double>(a + b)) +
                           condition(model, start, static_cast<double>(a));
      const Numbers middle = exact<Quad>(model, start, a);
      const double onward = condition(model, middle, static_cast<double>(b)) +
                            condition(model, middle, static_cast<double>(-a));
      EXPECT_LE(distance(exact<Quad>(model, middle, b), exact<Quad>(model, start, a + b)),
                scaled_quad_bound * scale * onward);
      EXPECT_LE(distance(exact<Quad>(model, middle, -a), start), scaled_quad_bound * scale * onward);
      EXPECT_LE(distance(exact<Quad>(model, start, Quad(0)), start), scaled_quad_bound * scale);
    }
  }
}

void compare_special(const char* system, const Assignments& parameters,
                     const std::vector<std::vector<double>>& starts) {
  const SystemPlugin& plugin = systems().get(system, "system");
  const auto model = motion_of(plugin.make(parameters));
  for (const auto& z : starts) {
    const Numbers start = on_velocity_constraints(plugin, parameters, Numbers(z.begin(), z.end()));
    SCOPED_TRACE(std::string(system) + " " + pfaff::testing::describe(parameters, start));
    compare_at_all_times(model, start);
  }
}

TEST(ExactSolution, OfThePendulumHoldsInEveryRegime) {
  const double pi = 3.141592653589793;
  compare_special("pendulum", {},
                  {{0, 0},
                   {1e-100, 0},
                   {0, 1e-10},  // at rest, small swings
                   {3, 0},
                   {-3.1, 0.01},
                   {pi, 0},
                   {-pi, 0},  // from nearly upside down
                   {3 * pi, 0},
                   {100, 0.5},
                   {-100, -0.5},  // swinging, some turns away
                   {0, 2},
                   {0, -2},  // on the separatrix
                   {0, 2.0000000000000004},
                   {0, 1.9999999999999998},  // on either side of it
                   {0, 2.1},
                   {0, -2.1},
                   {100, 30},
                   {-100, -30}});  // revolving
  compare_special("pendulum", {{"omega", "0.001"}}, {{1, 0}, {1, 0.1}});
  compare_special("pendulum", {{"omega", "30"}}, {{1, 0}, {1, 100}});
}

TEST(ExactSolution, OfTheRigidBodyHoldsForEveryOrderOfMoments) {
  const std::vector<std::vector<double>> states{
      {0.3, -0.4, 0.5}, {-0.9, 0.05, 0.1}, {0.1, 0.7, -0.1}, {0.02, 0.1, -0.8}, {0, 0, 0},     {1, 0, 0},
      {0, -1, 0},       {0, 0, 1},         {0, 0.5, 0.5},    {0.5, 0, -0.5},    {-0.5, 0.5, 0}};
  for (const auto& i : std::vector<std::array<const char*, 3>>{{"1", "2", "3"},
                                                               {"1", "3", "2"},
                                                               {"2", "1", "3"},
                                                               {"2", "3", "1"},
                                                               {"3", "1", "2"},
                                                               {"3", "2", "1"},
                                                               {"1", "1", "2"},
                                                               {"1", "2", "1"},
                                                               {"2", "1", "1"},
                                                               {"2", "2", "2"},
                                                               {"1", "1.000000000001", "2"}})
    compare_special("free-rigid-body", {{"i1", i[0]}, {"i2", i[1]}, {"i3", i[2]}}, states);
  // On the separatrix of the default moments, where the middle axis is the second.
  compare_special("free-rigid-body", {},
                  {{0.5, 0.2, 0.5}, {0.5, 0.2, -0.5}, {1e-8, 1, 1e-8}, {1e-8, 1, -1e-8}});
}

TEST(ExactSolution, OfTheOscillatorHoldsWhenOverdampedAndCritical) {
  for (const char* nu : {"0", "1.999999999", "2", "2.000000001", "5", "10"})
    compare_special("damped-oscillator", {{"nu", nu}}, {{1, 0}, {-0.3, 0.8}});
  // Long after the fast part has gone the slow one is still there: e^{-400/rate}, rate = 5 + sqrt 24.
  const auto model = systems().get("damped-oscillator", "system").make({{"nu", "10"}});
  const double late = exact<double>(model, {Quad(1), Quad(0)}, 400.0)[0], rate = 5 + std::sqrt(24);
  EXPECT_NEAR(late, std::exp(-400 / rate) * (0.5 + 2.5 / std::sqrt(24)), 1e-13 * late);
}

TEST(ExactSolution, OfTheSleighHoldsInEveryRegime) {
  // Straight ahead, straight backwards (which is unstable), at rest, about to turn, turning either way.
  compare_special("sleigh", {},
                  {{0.3, -0.2, 0, 1, 0, 0},
                   {0.3, -0.2, 0, -1, 0, 0},
                   {0.3, -0.2, 1, 0, 0, 0},
                   {0, 0, 0, -1, 8e-9, 1e-8},
                   {0, 0, 0, 1, -8e-9, -1e-8},
                   {0, 0, 0.5, 0, 0, 2},
                   {0, 0, 0.5, 0, 0, -2},
                   {1, 2, -3, -0.7, 0.1, -0.9}});
  // The largest ratio of inertia to offset for which it is said to hold, and a small one.
  compare_special("sleigh", {{"inertia", "2"}, {"offset", "0.1"}}, {{0, 0, 0, -0.5, 0.05, 1}});
  compare_special("sleigh", {{"inertia", "0.01"}, {"offset", "2"}}, {{0, 0, 0, -0.5, 2, 0.01}});
  // After a long time nothing overflows: it runs straight ahead at the speed that the energy leaves it.
  const auto model = motion_of(systems().get("sleigh", "system").make({}));
  const auto late = exact<double>(model, {Quad(0), Quad(0), Quad(0), Quad(0), Quad(0.8), Quad(1)}, 1e5);
  for (const double x : late) EXPECT_TRUE(std::isfinite(x));
  EXPECT_NEAR(std::hypot(late[3], late[4]), std::sqrt(2 * (0.32 + 1)), 1e-12);
}

TEST(ExactSolution, OfCircularPathsHoldsOnStraightLinesToo) {
  for (const double turning : {0.0, 1e-200, 1e-20, 1e-9, -1e-3, 0.3, 5.0}) {
    compare_special("heisenberg-geodesic", {}, {{0.3, -0.5, 0.2, 0.8, 0.6, turning}});
    compare_special("knife-edge", {}, {{0, 0, 0.3, 0.7, 0.2, turning}});
    compare_special("rolling-disk", {}, {{0, 0, 0.3, 0.1, 0.5, 0.2, turning / 16, 0.15}});
  }
}

TEST(ExactSolution, OfTheContactParticleHoldsFarOutAndWhereYStands) {
  for (const double rate : {0.0, 1e-200, 1e-20, 1e-9, -1e-3, 0.5, -3.0})
    for (const double y : {0.0, 1e-20, -0.7, 30.0})
      compare_special("contact-particle", {}, {{0.3, y, 0.1, 0.8, rate, 0.8 * y}});
}

TEST(ExactSolution, OfKeplerHoldsFromCirclesToNeedles) {
  const auto model = systems().get("kepler", "system").make({});
  Samples samples(13);
  for (const double e : {0.0, 1e-9, 0.5, 0.9, 0.95, 0.99})
    for (int k = 0; k < 4; ++k) {
      const Numbers start = samples.kepler_ellipse(e);
      SCOPED_TRACE(pfaff::testing::describe({}, start));
      compare_at_all_times(model, start);
    }
}

}  // namespace
