// Initial states of text models by positions and velocities, and the quantities that runs follow untold.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>

#include "written_models.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::model_written;
using pfaff::testing::refusal_written;

const std::string of_line = "coordinates = [\"q\", \"p\"]\n";
const std::string of_plane = "coordinates = [\"x\", \"y\", \"p\", \"s\"]\n";

TEST(TextInitialState, MomentaOfALagrangianAreExact) {
  // L = (1 + x^2) v1^2/2 + v1 v2 + v2^2 + 3 y v1, p = (1 + x^2) v1 + v2 + 3 y, s = v1 + 2 v2
  const auto model = model_written(of_plane +
                                   "initial = [\"1/3\", 2]\ninitial_velocities = [0.3, \"-1/7\"]\n"
                                   "lagrangian = \"(1 + x^2)*v[1]^2/2 + v[1]*v[2] + v[2]^2 + 3*y*v[1]\"\n");
  const std::vector<Real>& z = model->initial();
  ASSERT_EQ(z.size(), 4U);
  EXPECT_TRUE(z[2] == Real::fraction(10, 9) * Real::fraction(3, 10) - Real::fraction(1, 7) + Real(6));
  EXPECT_TRUE(z[3] == Real::fraction(3, 10) - Real::fraction(2, 7));
}

// The flow of the model begins with the velocities that were asked for.
TEST(TextInitialState, MomentaOfAHamiltonianHaveTheVelocities) {
  for (const std::string& energy :
       {std::string("hamiltonian = \"sqrt(1 + p^2 + s^2) + x*s - y*p + x^2\"\n"),
        std::string("kinetic = \"p^2/2 + p*s/3 + s^2 + p^4/4\"\npotential = \"x*y\"\n"),
        std::string("kinetic = \"p^2/2 + s^2\"\npotential = \"x*y\"\ndamping = 0.1\n")}) {
    const auto model =
        model_written(of_plane + "initial = [0.2, 0.1]\ninitial_velocities = [0.5, \"-1/3\"]\n" + energy);
    std::vector<Quad> z, rate(4);
    for (const Real& x : model->initial()) z.push_back(x.quad());
    Problem<Quad>(model).field(Quad(0), z, rate);
    EXPECT_LT(static_cast<double>(abs(rate[0] - Quad(1) / Quad(2))), 1e-32) << energy;
    EXPECT_LT(static_cast<double>(abs(rate[1] + Quad(1) / Quad(3))), 1e-32) << energy;
  }
}

TEST(TextInitialState, VelocitiesThatNoMomentaHaveAreRefused) {
  const std::string fast = of_line + "initial = [0]\ninitial_velocities = [\"11/10\"]\n";
  EXPECT_EQ(refusal_written(fast + "hamiltonian = \"sqrt(1 + p^2)\"\n")
                .find("model.toml:3:22: initial_velocities: no "
                      "momenta p with H_p = v were found"),
            0U)
      << refusal_written(fast + "hamiltonian = \"sqrt(1 + p^2)\"\n");
  EXPECT_EQ(refusal_written(fast + "hamiltonian = \"q^2*p\"\n").find("model.toml:3:22: initial_velocities: "),
            0U);
  const std::string spring = of_line + "kinetic = \"p^2/2\"\npotential = \"q^2/2\"\n";
  EXPECT_EQ(refusal_written(spring + "initial_velocities = [1]\n"),
            "model.toml:4:1: initial_velocities is written beside initial, with the positions alone, which "
            "is missing");
  EXPECT_EQ(refusal_written(spring + "initial = [1, 2]\ninitial_velocities = [1]\n"),
            "model.toml:4:11: initial: expected one number, got 2");
  EXPECT_EQ(refusal_written(spring + "initial = [1]\ninitial_velocities = [1, 2]\n"),
            "model.toml:5:22: initial_velocities: expected one number, got 2");
  EXPECT_EQ(refusal_written(of_line + "field = [\"p\", \"-q\"]\ninitial = [1]\ninitial_velocities = [1]\n"),
            "model.toml:4:1: initial_velocities is written beside a canonical energy, which is missing");
  // Where Dirac's bracket makes the motion the velocity is another one than H_p.
  EXPECT_EQ(
      refusal_written(of_plane + "hamiltonian = \"p^2 + s^2 + x^2\"\nconstraints = [\"y\", \"s\"]\n"
                                 "initial = [1, 0]\ninitial_velocities = [1, 0]\n"),
      "model.toml:5:1: momenta do not follow from velocities in which constraints of the phase space or a "
      "second bracket take part; expected all of the state in initial");
}

// The names of what is followed, and "?" behind those of which nothing is claimed.
std::string followed(const std::string& text) {
  std::string names;
  const auto model = model_written(text);
  for (const Invariant& i : model->invariants())
    names += (names.empty() ? "" : " ") + i.name + (i.behaviour == Behaviour::conserved ? "" : "?");
  return names;
}

TEST(FollowedQuantities, TheEnergyWhereItIsKnown) {
  const std::string spring = of_line + "kinetic = \"p^2/2\"\npotential = \"q^2/2\"\n";
  EXPECT_EQ(followed(spring), "energy");
  EXPECT_EQ(followed(of_line + "lagrangian = \"v[1]^2/2 - q^4\"\n"), "energy");
  EXPECT_EQ(followed(of_line + "hamiltonian = \"p^2*q^2\"\n"), "energy");
  EXPECT_EQ(followed(spring + "damping = 0.1\n"), "energy?");
  EXPECT_EQ(followed(of_line + "hamiltonian = \"p^2 + q*t\"\n"), "");
  EXPECT_EQ(followed(of_line + "field = [\"p\", \"-q\"]\n"), "");
  const std::string pair = of_plane + "kinetic = \"(p^2 + s^2)/2\"\npotential = \"x^2 + y\"\n";
  EXPECT_EQ(followed(pair + "holonomic = [\"x^2 + y^2 - 1\"]\n"), "energy");
  EXPECT_EQ(followed(pair + "holonomic = [\"x^2 + y^2 - 1 - t\"]\n"), "energy?");
  EXPECT_EQ(followed(pair + "holonomic = [\"x^2 + y^2 - 1\"]\nfriction = [0.1, 0.1]\n"), "energy?");
  EXPECT_EQ(followed(pair + "velocity_constraints = [{ row = [\"y\", 1] }]\n"), "energy");
  EXPECT_EQ(followed(pair + "velocity_constraints = [{ row = [\"y\", 1], b = 1 }]\n"), "energy?");
  EXPECT_EQ(followed(pair + "velocity_constraints = [{ row = [\"t\", 1] }]\n"), "energy?");
}

TEST(FollowedQuantities, WhatTheAuthorStatesStandsAlone) {
  const std::string spring = of_line + "kinetic = \"p^2/2\"\npotential = \"q^2/2\"\ninitial = [1, 0]\n";
  EXPECT_EQ(followed(spring + "invariants = { energy = \"p^2/2 + q^2/2\" }\n"), "energy");
  EXPECT_EQ(followed(spring + "invariants = { action = \"q^2 + p^2\" }\n"), "action");
  EXPECT_EQ(followed(spring + "invariants = { size = { of = \"q^2 + p^2\", behaviour = \"free\" } }\n"),
            "size? energy");
  EXPECT_EQ(followed(spring + "invariants = { place = { of = \"q\", behaviour = \"free\" } }\n"),
            "place? energy");
}

TEST(FollowedQuantities, TheCasimirsOfABracket) {
  const std::string body =
      "coordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2 + 2*y^2 + 3*z^2\"\ninitial = [1, 2, 3]\n"
      "bracket = [[0, \"-z\", \"y\"], [\"z\", 0, \"-x\"], [\"-y\", \"x\", 0]]\n"
      "casimirs = [\"x^2 + y^2 + z^2\"]\n";
  // In units in which momenta are 1e18 times as large as positions it is no function of another one either.
  EXPECT_EQ(followed("name = \"planet\"\ncoordinates = [\"x\", \"y\", \"px\", \"py\"]\n"
                     "initial = [1.47e11, 0, 0, 1.8e29]\nkinetic = \"(px^2 + py^2)/(2*5.97e24)\"\n"
                     "potential = \"-7.92e44/sqrt(x^2 + y^2)\"\ninvariants = { turn = \"x*py - y*px\" }\n"),
            "turn energy");
  EXPECT_EQ(followed(body), "energy casimir1");
  EXPECT_EQ(followed(body + "invariants = { length = \"sqrt(x^2 + y^2 + z^2)\" }\n"), "length energy");
}

}  // namespace
