// States by velocities, --set initial_velocities=a,b,...: the momenta that follow, and who is refused them.
#include <gtest/gtest.h>

#include <fstream>

#include "../formula_values.hpp"
#include "../temporary_directory.hpp"
#include "run_settings.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

RunSettings started(const std::string& system, const Assignments& set) {
  RunSettings settings = settings_of(system, "1e-3", "1e-3", set);
  settings.precision = Precision::quad;
  return settings;
}
Numbers start_of(const RunSettings& settings) {
  Numbers z;
  for (const Real& x : resolve(settings).initial) z.push_back(x.quad());
  return z;
}

// By mpmath, 50 digits: the slopes of the kinetic energy of bobs at sums of rods, as differences of T(v + e)
// and T(v - e), which are exact for a T that is quadratic.
TEST(InitialVelocities, GiveTheMomentaOfAPendulumInAngles) {
  const Numbers expected{ratio(3, 10),
                         ratio(-1, 5),
                         ratio(1, 2),
                         Real::parse("-0.0202969586408700489030280720412341693")->quad(),
                         Real::parse("-1.86241378257701035463950683969640824")->quad(),
                         Real::parse("-0.0496177967277352213875234636355609411")->quad()};
  const Assignments set{
      {"bobs", "3"}, {"initial", "0.3,-0.2,0.5"}, {"initial_velocities", "1, -4/2, sqrt(1/4)"}};
  EXPECT_LT(distance(start_of(started("n-pendulum-angles", set)), expected),
            1e-31);  // a condition of some tens
}

TEST(InitialVelocities, StandBesideTheSystemsOwnPositions) {
  const auto model = model_named("n-pendulum-angles");
  const Numbers own = initial_state(*model),
                z = start_of(started("n-pendulum-angles", {{"initial_velocities", "0.25,-1"}}));
  ASSERT_EQ(z.size(), 4U);
  EXPECT_EQ(z[0], own[0]);
  EXPECT_EQ(z[1], own[1]);
  const auto rate = evaluated(model, Formula::field, z, 4);
  EXPECT_LT(static_cast<double>(abs(rate[0] - ratio(1, 4))), 1e-32);
  EXPECT_LT(static_cast<double>(abs(rate[1] + 1)), 1e-32);
}

std::string written(const TemporaryDirectory& directory, const std::string& text) {
  const std::string file = directory / "model.toml";
  std::ofstream(file) << text;
  return file;
}

// The mass at the start is that of the time of the start: p = (1 + t) v.
TEST(InitialVelocities, AreThoseAtTheTimeOfTheStart) {
  const TemporaryDirectory directory;
  RunSettings settings = started(written(directory,
                                         "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\n"
                                         "hamiltonian = \"p^2/(2*(1 + t)) + q^2\"\n"),
                                 {{"initial_velocities", "3"}});
  EXPECT_LT(distance(start_of(settings), {Quad(1), Quad(3)}), 1e-32);
  settings.t0 = "1/2";
  EXPECT_LT(distance(start_of(settings), {Quad(1), ratio(9, 2)}), 1e-32);
}

// Damping is no part of the velocity, and beside constraints H_p is the velocity too.
TEST(InitialVelocities, OfDampedAndOfConstrainedSystems) {
  const TemporaryDirectory directory;
  const std::string damped = written(directory,
                                     "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/4\"\n"
                                     "potential = \"q^2\"\ndamping = 0.1\n");
  EXPECT_LT(distance(start_of(started(damped, {{"initial_velocities", "3"}})), {Quad(1), Quad(6)}), 1e-32);
  // A rod of length one that hangs: x = 0, y = -1.
  const Assignments hanging{{"bobs", "1"}, {"initial", "0,-1"}};
  Assignments along = hanging, across = hanging;
  along.emplace_back("initial_velocities", "0.5,0");
  across.emplace_back("initial_velocities", "0.5,0.25");
  EXPECT_LT(distance(start_of(started("n-pendulum", along)), {Quad(0), Quad(-1), ratio(1, 2), Quad(0)}),
            1e-32);
  const std::string refused = complaint(started("n-pendulum", across));
  EXPECT_NE(refused.find("is off by 0."), std::string::npos) << refused;
  EXPECT_NE(refused.find("--project-initial (which changes it by"), std::string::npos) << refused;
  RunSettings projected = started("n-pendulum", across);
  projected.project_initial = true;
  EXPECT_LT(distance(start_of(projected), {Quad(0), Quad(-1), ratio(1, 2), Quad(0)}), 1e-30);
}

TEST(InitialVelocities, AreRefusedWhereMomentaDoNotFollow) {
  const auto refused = [](const std::string& system, const Assignments& set, const std::string& expected) {
    const std::string said = complaint(started(system, set));
    EXPECT_NE(said.find(expected), std::string::npos) << said << "\nnot: " << expected;
  };
  refused("lotka-volterra", {{"initial_velocities", "1"}},
          "initial_velocities: momenta of lotka-volterra do not follow from velocities; expected a system "
          "with a "
          "canonical energy, or --set initial= with a state (x, y)");
  refused("n-pendulum-angles", {{"initial_velocities", "1"}},
          "initial_velocities of n-pendulum-angles: expected 2 numbers, got 1");
  refused(
      "n-pendulum-angles", {{"initial_velocities", "1,fast"}},
      "initial_velocities theta2 of n-pendulum-angles: expected a finite decimal number or a/b, got 'fast'");
  refused("n-pendulum-angles", {{"initial", "0,0,0,0"}, {"initial_velocities", "1,1"}},
          "initial positions beside initial_velocities of n-pendulum-angles: expected 2 numbers, got 4");
  refused("n-pendulum-angles", {{"initial_velocities", "1,1"}, {"initial_velocities", "1,1"}},
          "'initial_velocities' is set twice");
  refused("n-pendulum-angles", {{"initial_velocity", "1,1"}}, "did you mean 'initial_velocities'?");
}

}  // namespace
