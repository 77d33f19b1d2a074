// Verification of systems written as text, by people who had not read the checks: sound ones in units or with
// parameters of their own, which pass, and false ones, which do not.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include <pfaff/core/integrator.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/formulation_checks.hpp>
#include <pfaff/verify/random_checks.hpp>

#include "../temporary_directory.hpp"
#include "judged.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::bad;
using pfaff::testing::Names;

class JudgedTexts : public ::testing::Test {
 protected:
  const SystemPlugin& system(const std::string& name, const std::string& rest) const {
    const auto file = files_ / (name + ".toml");
    std::ofstream(file) << "name = \"" << name << "\"\n" << rest;
    return system_named(file);
  }
  static Names with(const SystemPlugin& system, const char* method, const Assignments& parameters) {
    const auto made = integrators().get(method, "integrator").make(parameters);
    return bad(check_method(*made, parameters, system.name(), system.make({}), false));
  }

 private:
  pfaff::testing::TemporaryDirectory files_;
};

// A constraint of a coordinate alone is exactly zero at a start, and rounds nothing.
TEST_F(JudgedTexts, AStartOffOneConstraintIsFoundBesideOneThatIsExact) {
  const std::string particle =
      "coordinates = { q = 3, p = 3 }\nkinetic = \"(p[1]^2 + p[2]^2 + p[3]^2)/2\"\n"
      "potential = \"q[1]^2/2 + q[3]^4/4\"\n";
  const Names off{"initial state is on the constraints"};
  EXPECT_EQ(bad(check_system(system("its-rate", particle + "initial = [1, 0, 0, 0.3, 1, 0.2]\n"
                                                           "holonomic = { plane = \"q[2]\" }\n"))),
            off);
  const std::string elsewhere = particle + "initial = [1, 0, 3, 0, 0, 0]\n";
  const std::string plane = "plane = \"q[2]\"", circle = "circle = \"q[1]^2 + q[3]^2 - 9\"";
  EXPECT_EQ(
      bad(check_system(system("second", elsewhere + "holonomic = { " + plane + ", " + circle + " }\n"))),
      off);
  EXPECT_EQ(bad(check_system(system("first", elsewhere + "holonomic = { " + circle + ", " + plane + " }\n"))),
            off);
  EXPECT_EQ(bad(check_system(system("on-both", particle + "initial = [3, 0, 0, 0, 0, 0.5]\nholonomic = { " +
                                                   plane + ", " + circle + " }\n"))),
            Names{});
}

// Whether a field has a divergence is asked near the start, in parts of its size: a hundredth, whose
// logarithm is taken, stays positive. One that has a divergence is out of scope.
TEST_F(JudgedTexts, VolumeIsSpokenOfInTheSizesOfTheStart) {
  const std::string small = "coordinates = [\"x\", \"y\"]\ninitial = [0.01, 0.02]\n";
  EXPECT_TRUE(
      in_scope(Claim::volume, *system("free", small + "field = [\"sqrt(y)\", \"log(x)\"]\n").make({})));
  EXPECT_FALSE(in_scope(Claim::volume,
                        *system("spreads", small + "field = [\"sqrt(y)\", \"log(x) + y\"]\n").make({})));
}

// States beside the start are away from it by a part of its own size: those of a spring of 5 cm that cannot
// be longer than this are shorter, and numbers of animals stay positive, whatever they are counted in.
TEST_F(JudgedTexts, StatesBesideASmallStartStayInTheDomain) {
  for (const char* length : {"1", "1/5", "1/20", "1/100"})
    EXPECT_EQ(bad(check_system(system("fene", std::string("parameters = { L = \"") + length +
                                                  "\" }\ncoordinates = [\"q\", \"p\"]\n"
                                                  "initial = [\"L*2/5\", \"L/10\"]\nkinetic = \"p^2/2\"\n"
                                                  "potential = \"-L^2/2*log(1 - (q/L)^2)\"\n"))),
              Names{})
        << length;
  EXPECT_EQ(bad(check_system(system("animals",
                                    "coordinates = [\"x\", \"y\"]\ninitial = [\"0.08\", \"0.04\"]\n"
                                    "field = [\"x*(1 - 20*y)\", \"y*(12.5*x - 1)\"]\n[invariants]\n"
                                    "V = \"12.5*x - log(x) + 20*y - log(y)\"\n"))),
            Names{});
  for (const char* eccentricity : {"0.7", "0.95"})  // bound at the start, and barely so
    EXPECT_EQ(bad(check_system(systems().get("kepler", "system"), {{"eccentricity", eccentricity}})),
              Names{});
}
TEST_F(JudgedTexts, ErrorsOfRoundingAreMeasuredOnMotionsOfTheSameKindInEveryUnit) {
  const SystemPlugin& small =
      system("small-orbit",
             "coordinates = { q = 2, p = 2 }\ninitial = [\"1/20\", \"1/160\", \"1/320\", \"11/160\"]\n"
             "kinetic = \"(p[1]^2 + p[2]^2)/2\"\npotential = \"-1/4096/sqrt(q[1]^2 + q[2]^2)\"\n");
  EXPECT_EQ(with(small, "gauss", {{"stages", "6"}}), Names{});
}

// On a circle that is a sphere's cut with a plane, and redundant, z is zero: what projections leave of it has
// no size by which a step could be judged.
TEST_F(JudgedTexts, NoiseAboutZeroHasNoSize) {
  const SystemPlugin& circle =
      system("redundant-circle",
             "coordinates = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\n"
             "initial = [\"3/5\", \"-4/5\", \"0\", \"4*1.3/5\", \"3*1.3/5\", \"0\"]\n"
             "kinetic = \"(px^2 + py^2 + pz^2)/2.6\"\npotential = \"y\"\n"
             "holonomic = [\"x^2 + y^2 + z^2 - 1\", \"z\", \"x^2 + y^2 - 1\"]\n");
  EXPECT_EQ(bad(check_system(circle)), Names{});
  EXPECT_EQ(with(circle, "composition", {{"scheme", "yoshida"}, {"order", "4"}, {"base", "rattle"}}),
            Names{});
  for (const char* name : {"lmm", "simplified-dirac"})
    EXPECT_EQ(bad(check_formulation(formulations().get(name, "formulation"), {}, circle.make({}))), Names{})
        << name;
}

// A step of a chain with a stiff spring rounds more than its order leaves; the slopes of what is left are
// those of roundings.
TEST_F(JudgedTexts, SlopesOfRoundingsAreNoOrder) {
  const SystemPlugin& chain = system(
      "stiff-chain",
      "coordinates = { q = 12, p = 12 }\ninitial = [\"51.2\", \"vector(i, 2, 24, 0)\"]\n"
      "kinetic = \"sum(i, 1, 12, p[i]^2)/(2*166.4)\"\ndamping = 38.4\n"
      "potential = \"5242880*(sum(i, 1, 11, (q[i+1]-q[i])^2/2 + (q[i+1]-q[i])^4/(4*51.2^2)) + q[1]^2/2)\"\n");
  EXPECT_EQ(with(chain, "extrapolation", {{"columns", "6"}}), Names{});
}

// A state of a run in double is off its constraints by a rounding, which a step back does not bring back.
TEST_F(JudgedTexts, StatesOfARunAreOnTheirConstraintsInQuad) {
  const Assignments pendulum{{"mass", "0.6489"}, {"length", "1.878"}, {"gravity", "2.616"}};
  const auto rattle = integrators().get("rattle", "integrator").make({});
  EXPECT_EQ(bad(check_method(*rattle, {}, "spherical-pendulum",
                             systems().get("spherical-pendulum", "system").make(pendulum))),
            Names{});
}

// The energy of a rail that turns is no mean value at the middle of a step.
TEST_F(JudgedTexts, MeanValuesKeepNoEnergyOfConstraintsThatMove) {
  const auto rail = [&](const std::string& name, const std::string& row) -> const SystemPlugin& {
    return system(name,
                  "coordinates = [\"x\", \"y\", \"u\", \"v\"]\ninitial = [0, 0, 1, 0]\n"
                  "kinetic = \"(u^2 + v^2)/2\"\npotential = \"(x^2 + y^2)/2\"\n"
                  "velocity_constraints = [{ row = " +
                      row + " }]\n");
  };
  const SystemPlugin &turning = rail("turning-rail", "[\"-sin(t)\", \"cos(t)\"]"),
                     &resting = rail("resting-rail", "[\"0\", \"1\"]");
  const Assignments means{{"form", "multipliers"}, {"gradient", "mean-value"}};
  for (const SystemPlugin* const one : {&turning, &resting}) {
    EXPECT_EQ(with(*one, "nonholonomic-discrete-gradient", means), Names{}) << one->name();
    const auto method = integrators().get("nonholonomic-discrete-gradient", "integrator").make(means);
    const auto claims = method->preserves(*one->make({}));
    EXPECT_EQ(std::count(claims.begin(), claims.end(), Claim::energy), one == &resting ? 1 : 0);
  }
}

// Momenta at rest are what quad leaves of zero.
TEST_F(JudgedTexts, StartsAtRestAreOnTheirConstraints) {
  EXPECT_EQ(bad(check_system(systems().get("four-bar", "system"), {{"crank", "1.615"}})), Names{});
  EXPECT_EQ(bad(check_system(systems().get("ring", "system"), {{"beads", "12"}, {"seed", "2"}})), Names{});
}

// A unit of time is the writer's: this one is a thousandth, or a thousand, of the motion's.
TEST_F(JudgedTexts, FormulationsAreLookedAtInTheUnitsOfTheMotion) {
  for (const auto& [length, gravity] : {std::pair{"1", "9.81"}, {"8e-4", "9.81e-9"}, {"1e3", "9.81e6"}}) {
    const std::string l = length, g = gravity;
    EXPECT_EQ(bad(check_system(system("pendulum-of-its-own",
                                      "coordinates = [\"x\", \"y\", \"u\", \"v\"]\n"
                                      "initial = [\"3/5*" +
                                          l + "\", \"-4/5*" + l +
                                          "\", 0, 0]\n"
                                          "kinetic = \"(u^2 + v^2)/2\"\npotential = \"" +
                                          g +
                                          "*y\"\n"
                                          "holonomic = [\"x^2 + y^2 - (" +
                                          l + ")^2\"]\n"))),
              Names{})
        << length;
  }
}

// Steps of compositions go back and forth; of fast motions the longest of them has no solution on its way
// back at a step at which it has one on its way there.
TEST_F(JudgedTexts, StepsAreShortEnoughForTheWayBack) {
  const SystemPlugin& lorenz = system("lorenz",
                                      "coordinates = [\"x\", \"y\", \"z\"]\ninitial = [1, 1, 1]\n"
                                      "field = [\"10*(y - x)\", \"x*(28 - z) - y\", \"x*y - 8/3*z\"]\n");
  EXPECT_EQ(
      with(lorenz, "composition", {{"scheme", "yoshida"}, {"order", "8"}, {"base", "implicit-midpoint"}}),
      Names{});
}

// The momentum of the start is small, and becomes 300 times the angle.
TEST_F(JudgedTexts, UnitsThatDifferAreThoseOfTheMotion) {
  const auto model = systems().get("pendulum", "system").make({{"omega", "300"}});
  const Assignments mixing{{"order", "1"}, {"form", "normal"}, {"normal", "0.2,0.1,-0.3,-0.2"}};
  const auto method = integrators().get("generating-function", "integrator").make(mixing);
  EXPECT_EQ(bad(check_method(*method, mixing, "pendulum", model, false)), Names{});
}

// What is left of a semimetric of rank 2 after two pivots is rounding, of any sign.
TEST_F(JudgedTexts, ASemimetricIsNonNegativeAtEveryStrength) {
  for (const char* alpha : {"1", "7", "10", "100"})
    EXPECT_EQ(bad(check_system(systems().get("damped-rigid-body", "system"), {{"alpha", alpha}})), Names{})
        << alpha;
}

// The motion from the start does not go there.
TEST_F(JudgedTexts, ClaimsAreLookedAtBehindBranchesToo) {
  const std::string spring =
      "coordinates = [\"q\", \"p\", \"s\"]\ninitial = [1, 0, 0]\n"
      "hamiltonian = \"p^2/2 + q^2/2 + s\"\nentropy = \"s\"\n"
      "bracket = [[\"0\", \"1\", \"0\"], [\"-1\", \"0\", \"0\"], [\"0\", \"0\", \"0\"]]\n";
  const auto friction = [](const std::string& g) {
    return "symmetric_bracket = [[\"0\", \"0\", \"0\"], [\"0\", \"" + g + "\", \"-" + g +
           "*p\"], [\"0\", \"-" + g + "*p\", \"" + g + "*p^2\"]]\n";
  };
  EXPECT_EQ(bad(check_system(system("rubbed", spring + friction("(0.1 + select(q > 3, 1, 0))")))), Names{});
  EXPECT_EQ(bad(check_system(system("driven", spring + friction("(0.1 - 0.2*select(q > 3, 1, 0))")))),
            (Names{"entropy does not fall", "symmetric bracket is non-negative"}));
  const std::string wall =
      "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\n"
      "field = [\"p\", \"-q - select(q > 2, (q - 2)^3, 0)\"]\n[invariants]\n";
  EXPECT_EQ(
      bad(check_system(system("wall", wall + "e = \"p^2/2 + q^2/2 + select(q > 2, (q - 2)^4/4, 0)\"\n"))),
      Names{});
  EXPECT_EQ(bad(check_system(system("forgotten-wall", wall + "e = \"p^2/2 + q^2/2\"\n"))),
            Names{"conserves e"});
}

// RK4 loses entropy as it turns a body; a relaxation of 1e-6 makes more of it.
TEST_F(JudgedTexts, AnEntropyThatAMethodLosesShowsBesideAWeakRelaxation) {
  static const Method<pfaff::testing::Classical<false>> claiming{
      {.name = "rk4-of-entropy", .title = "", .reference = "", .order = 4, .preserves = {Claim::entropy}}};
  EXPECT_EQ(bad(check_on_random_systems(*claiming.make({}), {})), Names{"entropy"});
}

// A milligram on a spring in SI units: momenta of its chart are a millionth of its positions, which a
// generating function with a full matrix of `normal` adds to them.
TEST_F(JudgedTexts, SizesOfAChartAreNoFaultOfAMethod) {
  const SystemPlugin& light =
      system("light",
             "coordinates = [\"r\", \"v\"]\nparameters = {m = \"1/10^6\", k = \"2/10^6\", nu = \"1/5\"}\n"
             "initial = [0.7, 0.4]\none_form = [\"m*exp(nu*t)*v\", \"0\"]\n"
             "birkhoffian = \"exp(nu*t)*(m*v^2/2 + k*r^2/2)\"\n");
  EXPECT_EQ(with(light, "generating-function",
                 {{"order", "1"}, {"form", "normal"}, {"normal", "0.2,0.1,-0.3,-0.2"}}),
            Names{});
  EXPECT_EQ(with(light, "generating-function", {{"order", "2"}}), Names{});
}

// A motion that gets ever faster is followed as far as some thousand steps lead; the check ends.
TEST_F(JudgedTexts, AMotionThatGetsEverFasterIsFollowedForAWhile) {
  EXPECT_EQ(bad(check_system(system("hastening",
                                    "coordinates = [\"a\", \"b\", \"c\", \"pa\", \"pb\", \"pc\"]\n"
                                    "initial = [\"1/2\", \"1/3\", \"-1/4\", \"-62591/278117\", "
                                    "\"-408466/1390585\", \"343528/1390585\"]\n"
                                    "hamiltonian = \"a^2 + a*b + b^2 + c^4/4 + c*pa*pb/5 + pa^2*(a^2/4 + "
                                    "1)/2 + pb^2/3 + pc^2/(2*b^2 + 2)\"\n"
                                    "holonomic = [\"a^2 + b*c + b*t/4 + c^3/2 + t^2/5 - 61/384\"]\n"
                                    "friction = [\"1/10\", \"a^2/5 + 1/5\", \"3/10\"]\n"))),
            Names{});
}

}  // namespace
