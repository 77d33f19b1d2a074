// Systems with velocity constraints on the command line: which formulation moves them, what is refused and
// why, what runs record and what an evaluation shows.
#include <algorithm>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments nonholonomic_run(const std::string& system, const Arguments& more) {
  return Arguments{"run", "--system", system, "--integrator", "rk4", "--step", "0.05", "--time", "2"} + more;
}
void expect_refused_with(const Arguments& arguments, const std::string& message) {
  const Outcome outcome = run_pfaff(arguments + Arguments{"--out", "-"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, "pfaff: " + message + "\n");
}

TEST(VelocityConstraintsCommand, RunInTheNonholonomicFormulationAndRecordTheirDrift) {
  const TemporaryDirectory files;
  const fs::path& directory = files.path();
  const Outcome outcome =
      run_pfaff(nonholonomic_run("contact-particle", {"--out", (directory / "run").string()}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = json_of(text_of(directory / "run" / "summary.json"));
  ASSERT_EQ(summary["constraints"].size(), 1U);
  EXPECT_EQ(summary["constraints"][0]["name"], "constraint");
  EXPECT_LT(summary["constraints"][0]["max"].get<double>(), 1e-5);
  EXPECT_GT(summary["constraints"][0]["max"].get<double>(), 0);  // RK4 leaves the surface a little
  const std::string config = text_of(directory / "run" / "config.toml");
  EXPECT_NE(config.find("\"nonholonomic\""), std::string::npos) << config;
}

// Another motion, whose velocity keeps the constraints whatever its momenta are.
TEST(VelocityConstraintsCommand, RunInTheVakonomicFormulation) {
  const TemporaryDirectory files;
  const fs::path& directory = files.path();
  const Outcome outcome = run_pfaff(nonholonomic_run(
      "contact-particle", {"--formulation", "vakonomic", "--out", (directory / "run").string()}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto summary = json_of(text_of(directory / "run" / "summary.json"));
  EXPECT_FALSE(summary.contains("constraints"));
  EXPECT_EQ(summary["invariants"].size(), 1U);
  EXPECT_EQ(summary["invariants"][0]["name"], "energy");
  expect_refused_with(
      nonholonomic_run("contact-particle", {"--formulation", "vakonomic", "--project-initial"}),
      "--project-initial: states of formulation vakonomic are not constrained");
}

TEST(VelocityConstraintsCommand, FormulationsOfOtherConstraintsAreRefused) {
  for (const std::string other : {"dirac", "simplified-dirac", "lmm", "ggl"})
    expect_refused_with(
        nonholonomic_run("sleigh", {"--formulation", other}),
        "formulation " + other +
            " makes no motion of velocity constraints, which sleigh has; expected nonholonomic or "
            "vakonomic");
  expect_refused_with(
      nonholonomic_run("spherical-pendulum", {"--formulation", "nonholonomic"}),
      "formulation nonholonomic needs velocity-constraints; spherical-pendulum offers holonomic, "
      "constraints, invariants");
}

// z' = y x' is off by 1 at (0, 1, 0) with the momenta (1, 0, 2).
TEST(VelocityConstraintsCommand, StatesOffTheConstraintsAreRefusedOrMoved) {
  const Arguments state{"--set", "initial=0,1,0,1,0,2"};
  expect_refused_with(
      nonholonomic_run("contact-particle", state),
      "initial state of contact-particle: constraint contact is off by 1; expected a state on the "
      "constraints, or --project-initial (which changes it by 0.32, relatively), or "
      "--allow-inconsistent");
  const TemporaryDirectory files;
  const fs::path& directory = files.path();
  const Outcome moved = run_pfaff(nonholonomic_run(
      "contact-particle", state + Arguments{"--project-initial", "--out", (directory / "run").string()}));
  ASSERT_EQ(moved.status, 0) << moved.err;
  EXPECT_NE(text_of(directory / "run" / "series.csv").find("\n0,0,1,0,1.5,0,1.5,"), std::string::npos);
  EXPECT_EQ(
      run_pfaff(nonholonomic_run("contact-particle", state + Arguments{"--allow-inconsistent", "--out", "-"}))
          .status,
      0);
}

// At phi = pi/2 all wheels of the snakeboard roll in one direction.
TEST(VelocityConstraintsCommand, DependentConstraintsAreRefused) {
  const std::string state = "initial=0,0,0,0,1.57079632679489661923132169163975144,0,0,0,0,0";
  const std::string message =
      "the row of A of velocity constraint back-wheels depends on that of front-wheels";
  for (const std::string formulation : {"nonholonomic", "vakonomic"})
    expect_refused_with(nonholonomic_run("snakeboard", {"--set", state, "--formulation", formulation}),
                        "initial state of snakeboard: " + message +
                            "; expected a state where the constraints are independent");
  const auto j = json_of(run_pfaff({"evaluate", "--json", "--system", "snakeboard", "--set", state}).out);
  EXPECT_EQ(j["status"], "singular");
  EXPECT_EQ(j["reason"], message);
  EXPECT_TRUE(j["rhs"].is_null());
}

// At (x, y, z) = (0, 2, 0) with v = (1, 3, 2): A = (-2, 0, 1), S = 5, A' v = -3, so that lambda = -3/5.
TEST(VelocityConstraintsCommand, EvaluationsShowRowsAndMultipliers) {
  const auto j = json_of(run_pfaff({"evaluate", "--json", "--precision", "quad", "--system",
                                    "contact-particle", "--set", "initial=0,2,0,1,3,2"})
                             .out);
  const auto number = [](const nlohmann::json& x) {
    return std::strtod(x.get<std::string>().c_str(), nullptr);
  };
  EXPECT_EQ(j["formulation"], "nonholonomic");
  EXPECT_EQ(j["status"], "converged");
  EXPECT_EQ(j["structure"], "diagonal");
  const double row[] = {-2, 0, 1}, rates[] = {1, 3, 2, -1.2, 0, 0.6};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(number(j["velocity_rows"][0][k]), row[k]);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(number(j["rhs"][k]), rates[k]);
  EXPECT_EQ(number(j["S"][0][0]), 5);
  EXPECT_EQ(number(j["constraints"][0]), 0);
  EXPECT_EQ(number(j["multipliers"][0]), -0.6);
  const auto other = json_of(
      run_pfaff({"evaluate", "--json", "--system", "contact-particle", "--formulation", "vakonomic"}).out);
  EXPECT_EQ(other["formulation"], "vakonomic");
  EXPECT_FALSE(other.contains("constraints"));
}

// Beside holonomic constraints, which hold at both levels, S is that of the level of velocities.
TEST(VelocityConstraints, OfBothKindsAreNamedWhereTheyStand) {
  const TemporaryDirectory files;
  write(files / "model.toml",
        "coordinates = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\ninitial = [1, 0, 0]\n"
        "initial_velocities = [0, 1, 0]\nhamiltonian = \"(px^2 + py^2 + pz^2)/2 + px*y\"\n"
        "velocity_constraints = [{ name = \"flat\", row = [\"0\", \"0\", \"1\"] }]\n"
        "holonomic = { circle = \"x^2 + y^2 - 1\" }\n");
  const auto j = json_of(run_pfaff({"evaluate", files / "model.toml", "--json"}).out);
  EXPECT_EQ(j["velocity_names"], (nlohmann::json{"circle~", "flat"}));
  EXPECT_NE(run_pfaff({"evaluate", files / "model.toml"}).out.find("circle~  4        0"), std::string::npos)
      << run_pfaff({"evaluate", files / "model.toml"}).out;
  // The bracket is that at the momenta on the constraints, and of no other is anything said.
  const auto flow = [&](const char* initial) {
    return run_pfaff({"evaluate", "sleigh", "--set", std::string("initial=") + initial}).out;
  };
  EXPECT_NE(flow("0,0,0,1,0,0").find("flow         {z, H}_nh is the rhs"), std::string::npos)
      << flow("0,0,0,1,0,0");
  EXPECT_NE(flow("0,0,0,1,1,0").find("on the constraints, where this state is not, {z, H}_nh is the rhs"),
            std::string::npos)
      << flow("0,0,0,1,1,0");
}

TEST(VelocityConstraintsCommand, DescriptionsNameTheFormulationsThatFit) {
  const auto j = json_of(run_pfaff({"describe", "sleigh", "--json"}).out);
  EXPECT_EQ(j["formulations"], (nlohmann::json{"nonholonomic", "vakonomic"}));
  const auto& methods = j["integrators_of_formulations"];
  EXPECT_NE(std::find(methods.begin(), methods.end(), "rk4"), methods.end());
  EXPECT_EQ(std::find(methods.begin(), methods.end(), "verlet"), methods.end());
}

// Both motions in one comparison: each is measured against its own solution, and the one without constraints
// leaves their columns empty.
TEST(VelocityConstraintsCommand, ComparisonsHoldBothMotions) {
  const TemporaryDirectory files;
  const fs::path& directory = files.path();
  write(directory / "both.toml", R"(schema = 1
title = "Two motions"
description = "The contact particle, rolling and vakonomic."
reference = ["pitanga-rodrigues"]
[[method]]
label = "vakonomic"
integrator = "rk4"
formulation = "vakonomic"
[[method]]
label = "rolling"
integrator = "rk4"
[[case]]
name = "particle"
title = "contact particle"
system = "contact-particle"
time = "2"
steps = ["0.1"]
)");
  const Outcome outcome = run_pfaff(
      {"compare", (directory / "both.toml").string(), "--no-report", "--out", (directory / "both").string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string run : {"vakonomic", "rolling"}) {
    const auto summary =
        json_of(text_of(directory / "both" / "runs" / ("particle-" + run + "-h0.1") / "summary.json"));
    EXPECT_LT(summary["error_max"].get<double>(), 1e-4) << run;
  }
}

}  // namespace
