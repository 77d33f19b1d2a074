// Systems and brackets written as text, by the program: run, rerun, describe, evaluate, verify, falsify and
// compare.
#include <map>

#include "command.hpp"

namespace {

using namespace pfaff::testing;

const std::string spring =
    "coordinates = [\"q\", \"p\"]\ninitial = [1, 0.2]\nparameters = { a = 1 }\nkinetic = \"p^2/2\"\n"
    "potential = \"a*q^4/4\"\ninvariants = { H = \"p^2/2 + a*q^4/4\" }\n";

TEST(TextModel, RunsAndRunsAgainFromItsConfiguration) {
  const TemporaryDirectory files;
  write(files / "spring.toml", spring);
  const Outcome run = run_pfaff({"run", "--system", files / "spring.toml", "--integrator", "verlet", "--set",
                                 "a=2", "--step", "0.1", "--time", "1", "--out", files / "one"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::vector<std::string> again{"run", "--config", files / "one/config.toml", "--out", files / "two"};
  EXPECT_EQ(run_pfaff(again).status, 0);
  EXPECT_EQ(text_of(files / "one/series.csv"), text_of(files / "two/series.csv"));
  write(files / "spring.toml", spring + "# a comment\n");
  const Outcome changed = run_pfaff({"run", "--config", files / "one/config.toml", "--out", files / "three"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_NE(changed.err.find("spring.toml has changed"), std::string::npos) << changed.err;
}

// Runs of an experiment are made of the file, whose initial state is a setting of theirs.
TEST(TextModel, AnotherInitialStateDoesNotReplaceRuns) {
  const TemporaryDirectory files;
  write(files / "spring.toml", spring);
  write(files / "one.toml",
        "schema = 1\ntitle = \"One\"\n[[method]]\nlabel = \"V\"\nintegrator = \"verlet\"\n[[case]]\n"
        "name = \"s\"\nsystem = \"spring.toml\"\ntime = \"1\"\nsteps = [\"0.1\"]\n");
  const std::vector<std::string> compare{"compare", files / "one.toml", "--no-report", "--timing", "0.001",
                                         "--out",   files / "out"};
  const Outcome first = run_pfaff(compare);
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string results = text_of(files / "out/results.csv");
  std::string other = spring;
  other.replace(other.find("[1, 0.2]"), 8, "[1, 0.3]");
  write(files / "spring.toml", other);
  expect_complaint(run_pfaff(compare), 2, {"spring.toml has changed", "--force"}, "compare");
  EXPECT_EQ(text_of(files / "out/results.csv"), results);
}

TEST(TextModel, IsTakenWhereNamesAreTaken) {
  const TemporaryDirectory files;
  write(files / "spring.toml", spring);
  write(files / "plane.toml",
        "coordinates = [\"x\", \"y\"]\ntensor = [[\"0\", \"x\"], [\"-x\", \"0\"]]\nsymmetry = "
        "\"skew\"\njacobi = true\n");
  const std::string model = files / "spring.toml";
  EXPECT_EQ(json_of(run_pfaff({"describe", model, "--json"}).out)["name"], "spring");
  EXPECT_EQ(json_of(run_pfaff({"describe", files / "plane.toml", "--json"}).out)["dimension"], 2);
  EXPECT_EQ(json_of(run_pfaff({"evaluate", "--system", model, "--json"}).out)["rhs"][1], -1);
  EXPECT_EQ(run_pfaff({"verify", files / "plane.toml"}).status, 0);
  // RK4 is not symplectic on a quartic spring.
  EXPECT_EQ(run_pfaff({"falsify", "rk4", "--claim", "symplectic", "--system", model}).status, 1);
  write(files / "compared.toml",
        "schema = 1\ntitle = \"A spring\"\n[[method]]\nlabel = \"verlet\"\nintegrator = \"verlet\"\n"
        "[[case]]\nname = \"spring\"\nsystem = \"spring.toml\"\ntime = 1\nsteps = [0.1]\n");
  const Outcome compared =
      run_pfaff({"compare", files / "compared.toml", "--no-report", "--out", files / "compared"});
  EXPECT_EQ(compared.status, 0) << compared.err;
}

TEST(TextModel, EveryExampleIsDescribed) {
  std::size_t models = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PFAFF_GOLDEN "/../../examples/models")) {
    if (entry.path().extension() != ".toml") continue;
    const Outcome described = run_pfaff({"describe", entry.path().string(), "--json"});
    EXPECT_EQ(described.status, 0) << described.err;
    ++models;
  }
  EXPECT_GE(models, 10U);
}

// Results of formulas stand in the order of the coordinates; names that are not looked at would be believed.
TEST(TextModel, OnlyConstraintsHaveNames) {
  const TemporaryDirectory files;
  for (const char* text :
       {"field = { p = \"-q\", q = \"p\" }\n", "field = [\"p\", \"-q\"]\ninitial = { p = 0.5, q = 1 }\n"}) {
    write(files / "named.toml", "coordinates = [\"q\", \"p\"]\n" + std::string(text));
    const Outcome refused = run_pfaff({"describe", files / "named.toml"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("expected expressions in their order, without names"), std::string::npos)
        << refused.err;
  }
}

// The keys of the action form are words; the literature and the pages say F and B.
TEST(TextModel, IsDescribedInTheSymbolsOfTheLiterature) {
  const nlohmann::json described = json_of(
      run_pfaff({"describe", PFAFF_GOLDEN "/../../examples/models/damped-pendulum.toml", "--json"}).out);
  std::map<std::string, std::string> symbols;
  for (const auto& formula : described["formulas"]) symbols[formula["name"]] = formula["symbol"];
  EXPECT_EQ(symbols["birkhoffian"], "B of F.dz - B dt");
  EXPECT_EQ(symbols["one_form"], "F of F.dz - B dt");
  EXPECT_EQ(symbols["structure"], "K of K z' + D = 0");
}

// A start by velocities that the constraints do not allow: how far off, and what mends it.
TEST(TextModel, StartsThatBreakAConstraintAreMeasured) {
  const TemporaryDirectory files;
  write(files / "pendulum.toml",
        "coordinates = [\"x\", \"y\", \"px\", \"py\"]\ninitial = [1, 0]\ninitial_velocities = [0.5, 1]\n"
        "kinetic = \"(px^2 + py^2)/2\"\npotential = \"y\"\nholonomic = { rod = \"(x^2 + y^2 - 1)/2\" }\n");
  const std::vector<std::string> run{
      "run", files / "pendulum.toml", "rattle", "--step", "0.1", "--time", "0.2", "--out", "-"};
  // d/dt (x^2 + y^2 - 1)/2 = x x' = 0.5; without it the velocity (0, 1) is left, and 0.5/|(0.5, 1)| = 0.447.
  expect_refused(run, {"constraint rod~ is off by 0.5; expected a state on the constraints, or "
                       "--project-initial (which changes it by 0.45, relatively)"});
  EXPECT_EQ(run_pfaff(run + std::vector<std::string>{"--project-initial"}).status, 0);
}

}  // namespace
