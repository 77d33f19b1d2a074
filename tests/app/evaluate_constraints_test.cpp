// pfaff evaluate on systems with constraints: the keys of its JSON, the agreement of the solvers, and
// constraints that are not second class, which it names.
#include <cmath>
#include <set>
#include <sstream>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

double number(const nlohmann::json& x) {
  return x.is_string() ? std::strtod(x.get<std::string>().c_str(), nullptr) : x.get<double>();
}
void expect_solvers_agree(const nlohmann::json& j, double tolerance) {
  for (const auto& [name, solver] : j["solvers"].items()) {
    EXPECT_EQ(solver["status"], "converged") << name;
    EXPECT_LE(number(solver["difference"]), tolerance) << name;
    ASSERT_EQ(solver["rhs"].size(), j["rhs"].size());
  }
}

// At rest at the side, q = (1, 0, 0): S = 1, h = 0; falling, the rod only keeps the length.
TEST(EvaluateConstraints, TheSphericalPendulum) {
  const auto j = evaluated({"spherical-pendulum", "--set", "initial=1,0,0,0,2,0", "--set", "gravity=10"});
  EXPECT_EQ(keys_of(j), (std::set<std::string>{"schema",      "system",
                                               "formulation", "parameters",
                                               "precision",   "t",
                                               "coordinates", "state",
                                               "status",      "rhs",
                                               "energy",      "energy_rate",
                                               "S",           "A",
                                               "S_D",         "structure",
                                               "constraints", "hidden_constraints",
                                               "multipliers", "constraint_names",
                                               "W",           "rank",
                                               "condition",   "first_class",
                                               "redundant",   "dirac_bracket",
                                               "solvers"}));
  EXPECT_EQ(j["formulation"], "dirac");
  EXPECT_EQ(j["status"], "converged");
  EXPECT_EQ(j["constraint_names"], (nlohmann::json{"rod", "rod~"}));
  EXPECT_EQ(j["rhs"], (nlohmann::json{0.0, 2.0, 0.0, -4.0, 0.0, -10.0}));  // centripetal: -4
  EXPECT_EQ(j["multipliers"], (nlohmann::json{4.0}));
  EXPECT_EQ(j["S"], (nlohmann::json{{1.0}}));
  EXPECT_EQ(j["W"], (nlohmann::json{{0.0, 1.0}, {-1.0, 0.0}}));
  EXPECT_EQ(j["rank"], 2);
  EXPECT_EQ(j["constraints"], (nlohmann::json{0.0}));
  EXPECT_EQ(j["hidden_constraints"], (nlohmann::json{0.0}));
  EXPECT_TRUE(j["S_D"].is_null());
  EXPECT_EQ(j["energy"], 2.0);
  EXPECT_EQ(j["energy_rate"], 0.0);
  EXPECT_EQ(
      keys_of(j["solvers"]),
      (std::set<std::string>{"dense", "holonomic-blocks", "skew-forest", "recursive-vectors",
                             "recursive-vectors-pivoted", "recursive-bivector", "recursive-bivector-pivoted",
                             "recursive-literal", "bordered-determinant", "pfaffian"}));
  // {x, p_x}_D = 1 - x^2/|q|^2 = 0, {y, p_y}_D = 1, {p_x, p_y}_D = -(x p_y - y p_x)/|q|^2.
  EXPECT_EQ(j["dirac_bracket"][0][3], 0.0);
  EXPECT_EQ(j["dirac_bracket"][1][4], 1.0);
  EXPECT_EQ(j["dirac_bracket"][3][4], -2.0);
}

TEST(EvaluateConstraints, EverySolverAgreesOffTheSurfaceToo) {
  for (const char* system : {"spherical-pendulum", "sphere-particle", "torus-particle",
                             "polar-double-pendulum", "shaken-pendulum", "guiding-centre"}) {
    const auto initial = evaluated({system})["state"];
    std::string text;
    for (std::size_t k = 0; k < initial.size(); ++k)
      text +=
          (k == 0 ? "" : ",") + std::to_string(initial[k].get<double>() + 0.01 * static_cast<double>(k % 3));
    for (const auto& [precision, tolerance] : {std::pair{"double", 1e-13}, std::pair{"quad", 1e-31}}) {
      SCOPED_TRACE(std::string(system) + " " + precision);
      const auto j =
          evaluated({system, "--set", "initial=" + text, "--time", "0.3", "--precision", precision});
      EXPECT_EQ(j["status"], "converged");
      EXPECT_GE(j["solvers"].size(), 9U);
      expect_solvers_agree(j, tolerance);
    }
    // The control: off the surface another formulation is another motion, and no solver's.
    if (std::string(system) == "guiding-centre") continue;
    const auto simple = evaluated({system, "--set", "initial=" + text, "--formulation", "simplified-dirac"});
    double difference = 0;
    for (std::size_t k = 0; k < simple["rhs"].size(); ++k)
      difference = std::max(
          difference, std::fabs(number(simple["rhs"][k]) - number(simple["solvers"]["dense"]["rhs"][k])));
    EXPECT_GT(difference, 1e-4);
    expect_solvers_agree(simple, 1e-13);
  }
}

TEST(EvaluateConstraints, NamesWhatIsNotSecondClass) {
  // b = b0 + b2 r^2 vanishes at r^2 = 5/4.
  const auto j = evaluated({"guiding-centre", "--set", "b0=-1.25", "--set", "b2=1"}, 1);
  EXPECT_EQ(j["status"], "singular");
  EXPECT_EQ(j["rank"], 0);
  EXPECT_EQ(j["first_class"], (nlohmann::json{"p_x - A_x", "p_y - A_y"}));
  EXPECT_TRUE(j["rhs"].is_null());
  EXPECT_FALSE(j.contains("solvers"));
  const std::string reason = j["reason"];
  EXPECT_NE(reason.find("rank 0 of 2"), std::string::npos) << reason;
  EXPECT_NE(reason.find("p_x - A_x"), std::string::npos) << reason;
  EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
  // The constraint has no gradient at the origin.
  const auto origin = evaluated({"spherical-pendulum", "--set", "initial=0,0,0,1,0,0"}, 1);
  EXPECT_EQ(origin["status"], "singular");
  EXPECT_FALSE(origin["redundant"].empty());
  EXPECT_TRUE(origin["rhs"].is_null());
  // The gradient is not finite on the axis.
  const auto axis = evaluated({"torus-particle", "--set", "initial=0,0,1,1,0,0"}, 1);
  EXPECT_EQ(axis["status"], "non_finite");
  EXPECT_FALSE(axis.contains("solvers"));
}

// Constraints of velocities: their forces and the nonholonomic bracket, of which the motion is the flow.
TEST(EvaluateConstraints, TheSleigh) {
  const auto j = evaluated({"sleigh"});
  EXPECT_EQ(j["formulation"], "nonholonomic");
  EXPECT_EQ(j["status"], "converged");
  EXPECT_EQ(j["constraint_forces"].size(), 3U);
  EXPECT_EQ(keys_of(j["nonholonomic"]),
            (std::set<std::string>{"P", "bracket", "rank", "casimirs", "casimir_residual",
                                   "one_form_residual", "jacobiator", "flow_difference"}));
  EXPECT_EQ(j["nonholonomic"]["rank"], 4);
  EXPECT_EQ(j["nonholonomic"]["casimirs"], j["constraint_names"]);
  EXPECT_LE(number(j["nonholonomic"]["flow_difference"]), 1e-14);
  const Outcome text = run_pfaff({"evaluate", "--system", "sleigh"});
  for (const char* part : {"constraint force", "{,}_nh", "rank 4 of 6", "Casimirs", "Jacobi"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
  std::stringstream lines(text.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(EvaluateConstraints, TablesKeepToAHundredColumns) {
  for (const char* system : {"spherical-pendulum", "polar-double-pendulum", "guiding-centre", "n-pendulum"}) {
    const Outcome outcome = run_pfaff({"evaluate", "--system", system});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::stringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
    EXPECT_NE(outcome.out.find("recursive-vectors"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("  nan"), std::string::npos) << outcome.out;
  }
}

}  // namespace
