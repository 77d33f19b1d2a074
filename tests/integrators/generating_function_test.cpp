// How accurately the steps of generating functions are solved: structure along runs at long steps, where the
// iteration has most to do, and solutions in components that begin at almost nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/structure.hpp>

namespace pfaff {
namespace {

struct Motion {
  std::string system;
  Assignments parameters;
  std::vector<double> start;
  double h;
  int steps;
};

// The largest structure residual of the steps of a run, and the iterations that a step of it takes.
struct Measured {
  double residual = 0, iterations = 0;
};
template <class T>
Measured measured(const Motion& motion, const Assignments& method_parameters) {
  const auto model = systems().get(motion.system, "").make(motion.parameters);
  const auto method = integrators().get("generating-function", "").make(method_parameters);
  StructureResidual<T> residual(*method, model);
  const T h(motion.h);
  Integration<T> run(start_with<T>(*method, model, {motion.start.begin(), motion.start.end()}, h, T(0)));
  Measured result;
  for (int n = 0; n < motion.steps; ++n) {
    const auto now = static_cast<double>(residual(run.time(), h, {run.state().begin(), run.state().end()}));
    if (!(now <= result.residual)) result.residual = now;
    run.steps(1).expect_reached();
  }
  result.iterations = static_cast<double>(run.counters().iterations) / motion.steps;
  return result;
}

const Motion damped_motion{"damped-pendulum", {{"nu", "1.5"}}, {2, 0}, 0.4, 50};
const Motion weakly_damped{"damped-pendulum", {}, {1, 0.5}, 0.8, 50};
const Motion predators{"lotka-volterra", {}, {3, 1}, 0.4, 125};
const Motion stars{"henon-heiles", {}, {0.1, 0.2, 0.3, -0.1}, 0.8, 50};

// M^T K M - K is relative to the largest sums of its terms. M itself is a sum over the terms of a few sums of
// roundings; eight units of round-off, of 1.1e-16, are twice what is found. An iteration that ends one
// correction too early leaves 1e-14 to 3e-12 in some step of each of these runs.
TEST(GeneratingFunction, KeepsStructureToRoundOffInEveryStepOfARun) {
  for (const Motion& motion : {damped_motion, weakly_damped, predators, stars})
    for (const char* extra : {"0", "auto"})
      for (const char* order : {"1", "2", "4", "8", "12"}) {
        const Measured now = measured<double>(motion, {{"order", order}, {"extra", extra}});
        EXPECT_LE(now.residual, 8 * unit_roundoff<double>())
            << motion.system << " " << motion.h << " " << order << " " << extra;
      }
  for (const char* form : {"qhat-p", "q-phat"})
    EXPECT_LE(measured<double>(predators, {{"order", "4"}, {"form", form}}).residual,
              8 * unit_roundoff<double>())
        << form;
}
TEST(GeneratingFunction, KeepsStructureToRoundOffInQuad) {
  Motion shorter = predators;
  shorter.steps = 20;
  for (const Motion& motion : {damped_motion, shorter})
    for (const char* order : {"1", "4", "12"})
      EXPECT_LE(measured<Quad>(motion, {{"order", order}}).residual,
                8 * static_cast<double>(unit_roundoff<Quad>()))
          << motion.system << " " << order;
}
// Without secants the same steps take 8.7 and 8.0 iterations.
TEST(GeneratingFunction, TakesFewIterationsAtLongSteps) {
  EXPECT_LE(measured<double>(predators, {{"order", "8"}, {"extra", "0"}}).iterations, 6.5);
  EXPECT_LE(measured<double>(damped_motion, {{"order", "8"}, {"extra", "0"}}).iterations, 5.5);
}

// A chain of which all but one momentum begin at almost nothing. The first corrections of the others are
// larger than these themselves by many decades, and the ratio of later ones to them says nothing of the steps
// that follow. The control restarts the iteration in every step.
TEST(GeneratingFunction, IsNotMisledByComponentsThatBeginAtAlmostNothing) {
  const auto model = systems().get("coupled-damped-oscillators", "").make({});
  for (const double least : {1e-300, 1e-30, 1e-12})
    for (const char* order : {"1", "4"}) {
      const auto method = integrators().get("generating-function", "").make({{"order", order}});
      Integration<double> going_on(start_with(*method, model, {least, 0, 0, 0, 0, 0.5}, 0.1, 0.0)),
          anew = going_on.beside({least, 0, 0, 0, 0, 0.5});
      for (int n = 0; n < 40; ++n) {
        going_on.steps(1).expect_reached();
        anew.forget();
        anew.steps(1).expect_reached();
        // Roundings of so many steps without compensation, each of a few units of the largest component.
        for (std::size_t k = 0; k < 6; ++k)
          ASSERT_NEAR(going_on.state()[k], anew.state()[k], 40 * 4 * unit_roundoff<double>())
              << least << " order " << order << " step " << n << " component " << k;
      }
    }
}

}  // namespace
}  // namespace pfaff
