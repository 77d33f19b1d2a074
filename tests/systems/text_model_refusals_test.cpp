// Text models that make no sense are refused with the file, the line and the column, and what was expected.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <pfaff/core/text/source.hpp>
#include <pfaff/systems/text/text_system.hpp>

#include "../temporary_directory.hpp"
#include "written_models.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::refusal_written;

void expect_refused(const std::string& text, const std::string& expected) {
  EXPECT_EQ(refusal_written(text).find(expected), 0U)
      << text << "\ngave: " << refusal_written(text) << "\nnot:  " << expected;
}
const std::string two = "coordinates = [\"q\", \"p\"]\n";
const std::string spring = two + "kinetic = \"p^2/2\"\npotential = \"q^2/2\"\n";

TEST(TextModelRefusals, TheRightOneIsAccepted) { EXPECT_EQ(refusal_written(spring), "accepted"); }

TEST(TextModelRefusals, Parts) {
  const auto parts = [](const std::string& list) { return spring + "parts = " + list + "\n"; };
  const std::string drift = R"({ name = "drift", change = ["h*p", 0] })",
                    kick = R"({ name = "kick", change = [0, "-h*q"] })";
  EXPECT_EQ(refusal_written(parts("[" + drift + ", " + kick + "]")), "accepted");
  expect_refused(parts("[]"), "model.toml:4:9: parts: expected a list of { name = ..., change = [...] }");
  expect_refused(parts("[{ name = \"drift\" }]"), "model.toml:4:10: part: the key 'change' is missing");
  expect_refused(parts("[{ name = \"drift\", change = [\"h*p\"] }]"),
                 "model.toml:4:37: change of 'drift': expected 2 expressions, got 1");
  expect_refused(parts("[{ name = \"drift\", change = [\"t*p\", 0] }]"),
                 "model.toml:4:39: 't' is no argument of change of 'drift'");
  expect_refused(parts("[{ name = \"a\", change = [0, 0], small = true }, { name = \"b\", change = [0, 0], "
                       "small = true }]"),
                 "model.toml:4:96: part 'b': expected one small part at most");
  expect_refused(
      "coordinates = [\"h\", \"p\"]\nfield = [1, 1]\nparts = [{ name = \"all\", change = [\"h\", \"h\"] }]\n",
      "model.toml:3:9: time of a flow 'h' has the name of a coordinate; expected another");
}

TEST(TextModelRefusals, KeysAndFiles) {
  expect_refused(spring + "holonomical = [\"q\"]\n",
                 "model.toml:4:1: unknown key 'holonomical'; did you mean 'holonomic'?");
  expect_refused(
      two + "kinetic = \"p^2/2\"\n",
      "model.toml:2:1: kinetic belongs together with potential, which is missing: H = T(p, t) + V(q, t)");
  expect_refused("kinetic = 1\n", "model.toml:1:1: a text model: the key 'coordinates' is missing");
  expect_refused(two, "model.toml:1:1: this system has no vector field; expected one of");
  expect_refused(two + "field = [\n", "model.toml:");
  expect_refused(two + "jacobi = tr\nfield = [1, 1]\n", "model.toml:2:");  // in one line
  expect_refused(spring + "let = 3\n", "model.toml:4:7: let: expected a table");
  expect_refused(spring + "name = \"Not Kebab\"\n",
                 "model.toml:4:9: the name 'Not Kebab': expected kebab-case");
  expect_refused(spring + "parameters = { a = { value = 1, rnage = [0, 1] } }\n",
                 "model.toml:4:33: unknown key 'rnage'; did you mean 'range'?");
  expect_refused(spring + "parameters = { a = { value = 2, range = [0, 1] } }\n",
                 "model.toml:4:41: parameter 'a': its value 2 is not in its range");
  expect_refused("coordinates = [{ name = \"q\", range = [1] }, \"p\"]\n",
                 "model.toml:1:38: range of coordinate 'q': expected [smallest, largest]");
  expect_refused("coordinates = [{ name = \"q\", range = [1, 0] }, \"p\"]\n",
                 "model.toml:1:38: range of coordinate 'q': expected the smallest before the largest");
  expect_refused(spring + "parameters = { q = 2 }\n",
                 "model.toml:1:17: coordinate 'q' has the name of a parameter");
  expect_refused(spring + "parameters = { sin = 2 }\n",
                 "model.toml:4:16: parameter 'sin': this name has a meaning of its own");
  expect_refused(spring + "invariants = { H = { of = \"q\", behaviour = \"constant\" } }\n",
                 "model.toml:4:45: unknown behaviour 'constant'");
  expect_refused(two + "lagrangian = \"v[1]^2/2\"\nparameters = { v = 1 }\n",
                 "model.toml:2:15: velocity 'v' has the name of a parameter");
  EXPECT_EQ(refusal_written(spring, {{"b", "2"}}).find("unknown parameter 'b'"), 0U);
}

TEST(TextModelRefusals, Formulas) {
  expect_refused(two + "kinetic = \"p^2/2\"\npotential = \"q^2/2 + p\"\n",
                 "model.toml:3:22: 'p' is no argument of potential, a function of positions and time");
  expect_refused(two + "kinetic = \"q^2/2\"\npotential = \"q^2/2\"\n",
                 "model.toml:2:12: 'q' is no argument of kinetic, a function of momenta and time");
  expect_refused(
      two + "lagrangian = \"v[1]^2/2 + p\"\n",
      "model.toml:2:26: 'p' is no argument of lagrangian, a function of positions, velocities and time");
  expect_refused(two + "field = [\"p\"]\n", "model.toml:2:9: field: expected 2 expressions, got 1");
  expect_refused(two + "field = [\"p\", \"-sin(r)\"]\n", "model.toml:2:21: unknown name 'r'");
  expect_refused(two + "field = [\"p\", \"-x\"]\n[let]\nx = \"y\"\ny = \"2*x\"\n",
                 "model.toml:5:8: 'x' is defined by itself: x -> y -> x");
  expect_refused(spring + "let = { unused = \"1 + mist\" }\n", "model.toml:4:23: unknown name 'mist'");
  expect_refused(spring + "initial = [1]\n",
                 "model.toml:4:11: initial: expected 2 numbers, one for each coordinate, got 1");
  expect_refused(spring + "initial = [\"q\", 1]\n",
                 "model.toml:4:13: 'q' is a coordinate; initial is made of parameters alone");
  expect_refused("coordinates = [\"q\"]\nkinetic = \"1\"\npotential = \"q\"\n",
                 "model.toml:1:17: there is 1 coordinate; expected an even number");
  expect_refused("coordinates = { q = \"n\" }\nfield = [\"1\"]\nparameters = { n = 0.5 }\n",
                 "model.toml:1:22: expected a whole number, got 0.5");
  expect_refused(two + "hamiltonian = \"q\"\nbracket = \"canonicl\"\n",
                 "model.toml:3:12: bracket: unknown bracket 'canonicl'; did you mean 'canonical'?");
  expect_refused(two + "hamiltonian = \"q\"\nbracket = \"lie-poisson\"\n",
                 "model.toml:3:12: bracket: it has dimension 3; expected 2");
  expect_refused(two + "hamiltonian = \"q\"\nbracket = [[\"0\", \"1\"], [\"1\"]]\n",
                 "model.toml:3:11: rows of bracket: expected 4 expressions, got 3");
  expect_refused(spring + "velocity_constraints = [{ row = [\"1\", \"q\"] }]\n",
                 "model.toml:4:35: row of psi1: expected 1 expression, got 2");
}

TEST(TextModelRefusals, BracketsAreReadToTheirEnd) {
  const auto refused = [](const std::string& text) {
    const pfaff::testing::TemporaryDirectory directory;
    const std::string file = (directory.path() / "bracket.toml").string();
    std::ofstream(file) << text;
    try {
      (void)bracket_named(file);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find("bracket.toml"));
    }
    return std::string("accepted");
  };
  const std::string rest = "tensor = [[\"0\", \"1\"], [\"-1\", \"0\"]]\nsymmetry = \"skew\"\n";
  EXPECT_EQ(refused(two + rest), "accepted");
  EXPECT_EQ(refused(two + rest + "let = { unread = \"1 + mist\" }\n")
                .find("bracket.toml:4:23: unknown name 'mist'"),
            0U);
  EXPECT_EQ(refused(two + "tensor = [[\"0\", \"1\"]]\nsymmetry = \"skew\"\n")
                .find("bracket.toml:2:10: tensor: expected 2 rows of 2, got 2 expressions"),
            0U);
}

TEST(TextModelRefusals, LagrangiansThatCannotBeSolved) {
  const std::string four = "coordinates = [\"x\", \"y\", \"p\", \"k\"]\n";
  expect_refused(four + "lagrangian = \"(v[1] + v[2])^2/2 - x^2\"\n",
                 "model.toml:2:15: lagrangian: its Hessian in the velocities, d2L/dv2, has rank 1 of 2");
  expect_refused(four + "lagrangian = \"x*v[2] - y*v[1]\"\n",
                 "model.toml:2:15: lagrangian: its Hessian in the velocities, d2L/dv2, has rank 0 of 2");
  expect_refused(
      two + "lagrangian = \"-sqrt(1 - v[1]^2)\"\n",
      "model.toml:2:15: lagrangian: its Hessian in the velocities, d2L/dv2, has rank 1 of 1 in the "
      "initial positions and depends on the velocities; expected a lagrangian that is quadratic");
  expect_refused(two + "lagrangian = \"v[1]^2\"\nhamiltonian = \"p\"\n",
                 "model.toml:2:1: the energy follows from the lagrangian");
}

TEST(TextModelRefusals, ShowThePlace) {
  const pfaff::testing::TemporaryDirectory directory;
  const std::string file = (directory.path() / "model.toml").string();
  std::ofstream(file) << two + "kinetic = \"p^2/2\"\npotential = \"\"\"\nq^2/2 +\n  mass*q\"\"\"\n";
  try {
    (void)system_named(file);
    FAIL() << "accepted";
  } catch (const text::TextError& error) {
    EXPECT_NE(std::string(error.what()).find("model.toml:5:3: unknown name 'mass'"), std::string::npos)
        << error.what();
    EXPECT_EQ(error.excerpt(), "    mass*q\n    ^");
  }
}
}  // namespace
