// Methods that step on the constraint surface: what they keep over many steps, which other results they agree
// with, and how they end when they fail.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/tests/integrators/constrained_systems.hpp>
#include <pfaff/verify/check.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using constrained::BentSphere;
using constrained::on_sphere;
using constrained::UnevenSphere;
using testing::method_named;
using testing::model_named;

template <class T>
struct ConstrainedRun {
  std::vector<T> z;
  std::int64_t completed = 0;
  Status status = Status::converged;
  Counters counters;
};
template <class T>
ConstrainedRun<T> run_constrained(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                                  const T& h, std::int64_t steps, std::vector<T> start = {}) {
  const auto motion = motion_for(method, model);
  if (start.empty()) start = testing::initial_state<T>(*model);
  Integration<T> run(start_with<T>(method, motion, std::move(start), h, T(0)));
  const Outcome outcome = run.steps(steps);
  return {{run.state().begin(), run.state().end()}, outcome.steps(), outcome.status(), run.counters()};
}

template <class T>
double largest_residual(const Model& model, const T& t, const std::vector<T>& z) {
  std::vector<T> residuals;
  ConstraintResiduals<T> residuals_of(model);
  residuals_of(t, z, residuals);
  return static_cast<double>(*std::max_element(residuals.begin(), residuals.end()));
}
template <class T>
double distance_of_first(const std::vector<T>& a, const std::vector<T>& b, std::size_t count) {
  T largest(0);
  for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, abs(a[k] - b[k]));
  return static_cast<double>(largest);
}
double energy(const Model& model, double t, const std::vector<double>& z) {
  double value = 0;
  Replay<double> hamiltonian(model.tape(Formula::hamiltonian));
  hamiltonian(t, z.data(), &value);
  return value;
}

struct Named {
  const char* name;
  Assignments parameters;
};
const std::vector<Named> keeping_both{{"rattle", {}},
                                      {"yoshida-rattle", {{"order", "4"}}},
                                      {"suzuki-rattle", {{"order", "4"}}},
                                      {"kahan-li-rattle", {{"order", "6"}}},
                                      {"lobatto-spark", {{"stages", "2"}}},
                                      {"lobatto-spark", {{"stages", "4"}}},
                                      {"projected-rk4", {}},
                                      {"projected-gauss", {{"stages", "1"}}}};

// Sums of squares of numbers of order one: some units of round-off, 1e-16 and 1e-34.
TEST(ConstrainedMethods, KeepBothLevelsToRoundOff) {
  for (const Named& n : keeping_both)
    for (const auto& on :
         {on_sphere(BentSphere()), model_named("n-pendulum"), model_named("torus-particle")}) {
      const auto m = method_named(n.name, n.parameters);
      const auto in_double = run_constrained<double>(*m, on, 0.004, 500);
      EXPECT_EQ(in_double.status, Status::converged) << n.name << ' ' << on->name();
      EXPECT_LE(largest_residual<double>(*on, 2.0, in_double.z), 1e-14) << n.name << ' ' << on->name();
      const auto in_quad = run_constrained<Quad>(*m, on, Quad(0.004), 10);
      EXPECT_LE(largest_residual<Quad>(*on, Quad(0.04), in_quad.z), 1e-31) << n.name << ' ' << on->name();
    }
}

TEST(ConstrainedMethods, OthersDoNot) {  // control
  const auto on = on_sphere(BentSphere());
  const auto rk4 = run_constrained<double>(*method_named("rk4"), on, 0.05, 40);
  EXPECT_GT(largest_residual<double>(*on, 2.0, rk4.z), 1e-7);
  const auto shake = run_constrained<double>(*method_named("shake"), on, 0.05, 40);
  EXPECT_GT(largest_residual<double>(*on, 2.0, shake.z), 1e-4);  // of the momenta
}

TEST(ConstrainedMethods, WithAKineticEnergyThatIsNotQuadraticToo) {
  BentSphere fast;
  fast.fast = true;
  const auto on = on_sphere(fast);
  for (const char* name : {"rattle", "lobatto-spark"}) {
    const auto m = method_named(name);
    EXPECT_LE(largest_residual<Quad>(*on, Quad(0.5), run_constrained<Quad>(*m, on, Quad(0.05), 10).z), 1e-32)
        << name;
    EXPECT_NEAR(measure_order(*m, on).slope, m->order(*on), 0.1) << name;
  }
}

TEST(ConstrainedMethods, HaveTheirOrders) {
  const auto bent = on_sphere(BentSphere()), uneven = on_sphere(UnevenSphere());
  for (const Named& n : keeping_both) {
    const auto m = method_named(n.name, n.parameters);
    for (const auto& on : {motion_for(*m, bent), motion_for(*m, uneven)}) {
      if (!m->refuses(*on).empty()) continue;
      EXPECT_NEAR(measure_order(*m, on).slope, m->order(*on), 0.1) << n.name;
    }
  }
  for (const char* name : {"shake", "lincs"})
    EXPECT_NEAR(measure_order(*method_named(name), bent).slope, 2, 0.1) << name;
}

TEST(ConstrainedMethods, RattleIsTheLobattoPairOfTwoStages) {
  const auto on = model_named("n-pendulum");
  const auto rattle = run_constrained<Quad>(*method_named("rattle"), on, Quad(0.01), 50);
  const auto lobatto =
      run_constrained<Quad>(*method_named("lobatto-spark", {{"stages", "2"}}), on, Quad(0.01), 50);
  // Fifty steps of a motion whose errors grow by some e^5 a second.
  EXPECT_LE(distance_of_first(rattle.z, lobatto.z, rattle.z.size()), 1e-30);
  const auto other =
      run_constrained<Quad>(*method_named("lobatto-spark", {{"stages", "3"}}), on, Quad(0.01), 50);
  EXPECT_GT(distance_of_first(rattle.z, other.z, rattle.z.size()), 1e-6);  // control
}

TEST(ConstrainedMethods, ShakeHasThePositionsOfRattle) {
  const auto on = on_sphere(BentSphere());
  double gap = 0;
  for (const int steps : {20, 40}) {
    const Quad h = Quad(1) / Quad(steps);
    const auto rattle = run_constrained<Quad>(*method_named("rattle"), on, h, steps),
               shake = run_constrained<Quad>(*method_named("shake"), on, h, steps);
    EXPECT_LE(distance_of_first(rattle.z, shake.z, 3), 1e-31);
    const double momenta = distance_of_first(rattle.z, shake.z, 6);  // of second order in h
    if (gap > 0) {
      EXPECT_NEAR(gap / momenta, 4, 0.2);
    }
    gap = momenta;
  }
}

TEST(ConstrainedMethods, LincsComesNearerWithEveryPowerAndCorrection) {
  const auto on = model_named("n-pendulum", {{"bobs", "3"}});
  double last = 1;
  for (const int expansion : {0, 1, 4, 16}) {
    const auto lincs = method_named("lincs", {{"expansion", std::to_string(expansion)}, {"iterations", "3"}});
    const double residual =
        largest_residual<double>(*on, 0.05, run_constrained<double>(*lincs, on, 0.001, 50).z);
    EXPECT_LT(residual, last / (expansion == 1 ? 1.5 : 3)) << expansion;  // one power more, or several
    last = residual;
  }
  const auto exact = run_constrained<double>(
      *method_named("lincs", {{"expansion", "64"}, {"iterations", "60"}}), on, 0.001, 50);
  const auto rattle = run_constrained<double>(*method_named("rattle"), on, 0.001, 50);
  EXPECT_LE(distance_of_first(exact.z, rattle.z, rattle.z.size()), 1e-10);
}

TEST(ConstrainedMethods, EnergyDoesNotDriftWhereTheStepIsSymplectic) {
  const auto on = on_sphere(constrained::StillSphere());
  const auto largest_error = [&](const char* name, const Assignments& parameters, double h) {
    const auto m = method_named(name, parameters);
    const auto motion = motion_for(*m, on);
    Integration<double> run(start_with(*m, motion, testing::initial_state<double>(*on), h, 0.0));
    const auto energy_now = [&] { return energy(*on, 0, {run.state().begin(), run.state().end()}); };
    const double start = energy_now();
    std::array<double, 4> quarters{};
    for (std::int64_t k = 0; k < 20000; ++k) {
      run.steps(1).expect_reached();
      double& worst = quarters[static_cast<std::size_t>(k / 5000)];
      worst = std::max(worst, std::abs(energy_now() - start));
    }
    return quarters;
  };
  for (const Named& n :
       {Named{"rattle", {}}, {"lobatto-spark", {{"stages", "3"}}}, {"yoshida-rattle", {{"order", "4"}}}}) {
    const auto errors = largest_error(n.name, n.parameters, 0.1);
    EXPECT_LE(errors[3], 1.5 * errors[0]) << n.name;
  }
  const auto control = largest_error("projected-rk4", {}, 0.1);
  EXPECT_GT(control[3], 3 * control[0]);
}

TEST(ConstrainedMethods, MomentumMapsAreKeptOverManySteps) {
  const auto on = model_named("spherical-pendulum");
  const auto vertical = [](const std::vector<double>& z) { return z[0] * z[4] - z[1] * z[3]; };
  std::vector<double> start;
  for (const Real& x : on->initial()) start.push_back(x.value());
  // 10000 steps, each with a rounding error or so of the state.
  for (const char* name : {"rattle", "kahan-li-rattle", "lobatto-spark"})
    EXPECT_NEAR(vertical(run_constrained<double>(*method_named(name), on, 0.05, 10000).z), vertical(start),
                1e-13)
        << name;
  EXPECT_GT(std::abs(vertical(run_constrained<double>(*method_named("projected-rk4"), on, 0.05, 10000).z) -
                     vertical(start)),
            1e-6);
}

TEST(ConstrainedMethods, RunBackToWhereTheyCameFrom) {
  const auto on = on_sphere(BentSphere());
  for (const Named& n : keeping_both) {
    const auto m = method_named(n.name, n.parameters);
    const auto motion = motion_for(*m, on);
    const auto start = testing::initial_state<Quad>(*on);
    const Quad h = Quad(1) / Quad(16);  // so that the times of the way back are those of the way there
    Integration<Quad> there(start_with(*m, motion, start, h, Quad(0)));
    there.steps(16).expect_reached();
    Integration<Quad> back = there.reversed();
    back.steps(16).expect_reached();
    const std::vector<Quad> z(back.state().begin(), back.state().end());
    if (std::string(n.name) == "projected-rk4") {
      EXPECT_GT(distance_of_first(z, start, 6), 1e-9);  // control
    } else {
      EXPECT_LE(distance_of_first(z, start, 6), 1e-30) << n.name;
    }
  }
}

TEST(ConstrainedMethods, RattleFactorsOnceAStep) {
  const auto result = run_constrained<double>(*method_named("rattle"), model_named("n-pendulum"), 0.001, 100);
  EXPECT_EQ(result.counters.factorisations, 101);
  EXPECT_EQ(result.counters.fields, 101);
  EXPECT_LE(result.counters.iterations, 400);
  // So do its compositions: each of the three sub-steps goes on from the one before.
  EXPECT_EQ(run_constrained<double>(*method_named("yoshida-rattle"), model_named("n-pendulum"), 0.001, 100)
                .counters.factorisations,
            301);
}

TEST(ConstrainedMethods, StopWhereAStepIsTooLargeAndKeepTheState) {
  const auto on = on_sphere(BentSphere());
  for (const Named& n : keeping_both) {
    const auto m = method_named(n.name, n.parameters);
    const auto result = run_constrained<double>(*m, on, 40.0, 3);
    EXPECT_NE(result.status, Status::converged) << n.name;
    EXPECT_EQ(result.completed, 0) << n.name;
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(result.z[k], on->initial()[k].value()) << n.name;
  }
  EXPECT_EQ(run_constrained<double>(*method_named("rattle"), on, 40.0, 3).status, Status::not_converged);
}

TEST(ConstrainedMethods, SayWhereConstraintsHaveNoGradient) {
  const auto on = on_sphere(BentSphere());
  for (const char* name : {"rattle", "shake", "lobatto-spark", "lincs"})
    EXPECT_EQ(run_constrained<double>(*method_named(name), on, 0.01, 1, std::vector<double>{0, 0, 0, 1, 0, 0})
                  .status,
              Status::singular)
        << name;
}

TEST(ConstrainedMethods, RefuseWhatTheyAreNotMadeFor) {
  BentSphere rough;
  rough.drag = Real::fraction(1, 10);
  const auto friction = on_sphere(rough), uneven = on_sphere(UnevenSphere());
  for (const char* name : {"rattle", "shake", "lincs", "yoshida-rattle", "lobatto-spark"})
    EXPECT_NE(method_named(name)->refuses(*friction).find("friction"), std::string::npos) << name;
  for (const char* name : {"rattle", "shake", "lincs"})
    EXPECT_NE(method_named(name)->refuses(*uneven).find("T(p, t) + V(q, t)"), std::string::npos) << name;
  EXPECT_EQ(method_named("lobatto-spark")->refuses(*uneven), "");
  EXPECT_NE(method_named("rattle")->refuses(*model_named("pendulum")).find("holonomic"), std::string::npos);
  EXPECT_NE(method_named("rk4")->refuses(*friction).find("vector-field"), std::string::npos);
}

TEST(ConstrainedMethods, RefuseInTheirOwnNames) {
  BentSphere rough;
  rough.drag = Real::fraction(1, 10);
  const auto friction = on_sphere(rough);
  const std::string reason =
      " keeps energies and needs a system without friction; " + friction->name() + " has friction";
  for (const char* name : {"rattle", "shake", "lincs", "yoshida-rattle", "lobatto-spark"})
    EXPECT_EQ(method_named(name)->refuses(*friction), name + reason);
  EXPECT_EQ(integrators().get("composition", "integrator").make({{"base", "rattle"}})->refuses(*friction),
            "composition of rattle" + reason);
}

// Symmetric methods take their first step back from a start at rest, where momenta end as what is left of two
// that cancel.
TEST(ConstrainedMethods, TakeAStepBackOntoRest) {
  const auto model = model_named("bead-rod");
  const auto start = testing::initial_state<double>(*model);
  for (const char* method : {"projected-gauss", "rattle", "lobatto-spark"})
    for (const double h : {0.2, 0.05, 1e-3}) {
      const auto there = run_constrained<double>(*method_named(method), model, h, 1);
      const auto back = run_constrained<double>(*method_named(method), model, -h, 1, there.z);
      EXPECT_EQ(back.status, Status::converged) << method << ' ' << h;
      EXPECT_LT(distance_of_first(back.z, start, start.size()), 2e-15) << method << ' ' << h;
    }
}

}  // namespace
}  // namespace pfaff
