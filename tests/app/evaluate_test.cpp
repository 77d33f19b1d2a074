// pfaff evaluate: the keys of its JSON, values against closed forms, states at which formulas fail, and what
// it refuses.
#include <cmath>
#include <set>

#include <pfaff/core/numbers/quad.hpp>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

const std::set<std::string> common{"schema", "system", "parameters", "precision", "t",          "coordinates",
                                   "state",  "status", "rhs",        "energy",    "energy_rate"};
const std::set<std::string> birkhoffian{
    "K", "F_t", "D", "F", "B", "regular", "condition", "class", "kernel", "self_adjoint", "centre"};
void expect_near(const nlohmann::json& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size()) << found;
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found[k].get<double>(), expected[k], 1e-14 * std::max(1.0, std::abs(expected[k]))) << k;
}

TEST(Evaluate, TheDampedOscillator) {
  const auto j =
      evaluated({"damped-oscillator", "--set", "nu=0.25", "--set", "initial=1.5,-0.75", "--time", "2"});
  std::set<std::string> keys = common;
  keys.insert(birkhoffian.begin(), birkhoffian.end());
  EXPECT_EQ(keys_of(j), keys);
  const double r = 1.5, p = -0.75, nu = 0.25, e = std::exp(0.5);
  EXPECT_EQ(j["system"], "damped-oscillator");
  EXPECT_EQ(j["parameters"], (nlohmann::json{{"nu", "0.25"}}));
  EXPECT_EQ(j["coordinates"], (nlohmann::json{"r", "p"}));
  EXPECT_EQ(j["t"], 2.0);
  EXPECT_EQ(j["state"], (nlohmann::json{1.5, -0.75}));
  EXPECT_EQ(j["status"], "converged");
  expect_near(j["rhs"], {p, -r - nu * p});
  expect_near(j["K"][0], {0, -e});
  expect_near(j["K"][1], {e, 0});
  expect_near(j["D"], {-e * (r + nu * p), -e * p});
  expect_near(j["F"], {e * p / 2, -e * r / 2});
  expect_near(j["F_t"], {nu * e * p / 2, -nu * e * r / 2});
  EXPECT_NEAR(j["B"].get<double>(), e * (r * r + nu * r * p + p * p) / 2, 1e-14);
  EXPECT_EQ(j["regular"], true);
  EXPECT_EQ(j["kernel"], nlohmann::json::array());
  EXPECT_NEAR(j["condition"].get<double>(), 1, 1e-14);
  EXPECT_EQ(j["class"], "nonautonomous");
  EXPECT_EQ(keys_of(j["self_adjoint"]), (std::set<std::string>{"skew", "closed", "time"}));
  for (const auto& residual : j["self_adjoint"]) EXPECT_LE(residual.get<double>(), 1e-14);
  EXPECT_TRUE(j["centre"].is_null());
}

TEST(Evaluate, LotkaVolterraInQuad) {
  const auto j = evaluated({"lotka-volterra", "--set", "initial=2,0.5", "--precision", "quad"});
  EXPECT_EQ(j["class"], "autonomous");
  EXPECT_EQ(j["precision"], "quad");
  const auto number = [](const nlohmann::json& text) {
    pfaff::Quad x;
    EXPECT_TRUE(parse(text.get<std::string>(), x)) << text;
    return x;
  };
  const auto parameter = [&](const char* name) { return number(j["parameters"][name]); };
  const pfaff::Quad x(2), y(0.5), alpha = parameter("alpha"), beta = parameter("beta"),
                                  gamma = parameter("gamma"), delta = parameter("delta");
  EXPECT_LE(abs(number(j["rhs"][0]) - x * (alpha - beta * y)), pfaff::Quad(1e-32));
  EXPECT_LE(abs(number(j["rhs"][1]) - y * (delta * x - gamma)), pfaff::Quad(1e-32));
  EXPECT_LE(abs(abs(number(j["K"][0][1])) - pfaff::Quad(1) / (x * y)), pfaff::Quad(1e-33));
}

TEST(Evaluate, EnergiesOfHamiltonianAndDampedSystems) {
  const auto oscillator = evaluated({"harmonic-oscillator", "--set", "initial=3,4"});
  EXPECT_EQ(keys_of(oscillator), common);
  EXPECT_EQ(oscillator["energy"], 12.5);
  EXPECT_EQ(oscillator["energy_rate"], 0.0);
  // T + V falls at the rate nu p^2.
  const auto damped =
      evaluated({"damped-oscillator", "--set", "nu=0.5", "--set", "initial=0.5,2", "--time", "3"});
  EXPECT_NEAR(damped["energy"].get<double>(), (0.25 + 4) / 2, 1e-15);
  EXPECT_NEAR(damped["energy_rate"].get<double>(), -0.5 * 4, 1e-15);
  EXPECT_TRUE(evaluated({"magnetic-induction"})["energy"].is_null());
}

TEST(Evaluate, EquationsWithoutAnActionFormHaveOneAboutACentre) {
  const Arguments point{"magnetic-induction", "--set", "initial=0.5,0.25,1,-1", "--time", "0.5"};
  const auto j = evaluated(point);
  EXPECT_EQ(j["centre"], (nlohmann::json{1.0, 0.0, 0.2, 0.6}));  // the initial state of the system
  EXPECT_EQ(j["class"], "nonautonomous");
  const double b = 1 + 0.5 * std::cos(0.5), slope = -0.5 * std::sin(0.5), pull = 0.2 + 0.5 * 0.3125;
  expect_near(j["rhs"], {1, -1, -b - pull * 0.5 + slope * 0.125, -b - pull * 0.25 - slope * 0.25});
  expect_near(j["K"][0], {0, b, -1, 0});
  // F = (K x)/2 backwards: F_i = x_j K_ji / 2, x from the centre.
  const auto about = evaluated(point + Arguments{"--centre", "0,0,0,0"});
  expect_near(about["F"], {(0.25 * -b + 1) / 2, (0.5 * b - 1) / 2, -0.25, -0.125});
  EXPECT_NE(about["F"], j["F"]);
  EXPECT_EQ(about["D"], j["D"]);
  // At the centre F.x and B vanish.
  EXPECT_EQ(evaluated({"magnetic-induction"})["B"], 0.0);
}

TEST(Evaluate, AStateOutsideTheDomainIsShownNotRefused) {
  const auto j = evaluated({"lotka-volterra", "--set", "initial=-1,2"}, 1);
  EXPECT_EQ(j["status"], "non_finite");
  EXPECT_TRUE(j["B"].is_null());
  EXPECT_EQ(j["state"], (nlohmann::json{-1.0, 2.0}));
  EXPECT_EQ(evaluated({"lotka-volterra", "--set", "initial=0,1"}, 1)["status"], "non_finite");
  EXPECT_EQ(evaluated({"kepler", "--set", "initial=0,0,1,0"}, 1)["status"], "non_finite");
}

TEST(Evaluate, ADegenerateStructureNamesItsDirections) {
  const Arguments where{"degenerate", "--plugin", test_plugin("degenerate")};
  const auto j = evaluated(where, 1);
  EXPECT_EQ(j["regular"], false);
  EXPECT_EQ(j["status"], "singular");
  EXPECT_TRUE(j["rhs"].is_null());
  EXPECT_EQ(j["D"], (nlohmann::json{-1.0, 0.0, 0.0, 0.0}));
  ASSERT_EQ(j["kernel"].size(), 2U);
  const std::string text = run_pfaff(Arguments{"evaluate", "--system"} + where).out;
  EXPECT_NE(text.find("degenerate, condition "), std::string::npos) << text;
  EXPECT_NE(text.find("degenerate along  u\n"), std::string::npos) << text;
  EXPECT_NE(text.find("degenerate along  -0.5 y + v\n"), std::string::npos) << text;
  // Control: nothing of the kind where K is regular.
  EXPECT_EQ(run_pfaff({"evaluate", "--system", "magnetic-induction"}).out.find("degenerate"),
            std::string::npos);
}

TEST(Evaluate, StateFiles) {
  const TemporaryDirectory files;
  write(files / "state.json", R"({"t": 0.5, "q": [0.25], "p": [2]})");
  const Arguments from{"damped-pendulum", "--state", files / "state.json"};
  const auto j = evaluated(from);
  EXPECT_EQ(j["t"], 0.5);
  EXPECT_EQ(j["state"], (nlohmann::json{0.25, 2.0}));
  expect_refused(Arguments{"evaluate", "--system"} + from + Arguments{"--time", "1"},
                 {"--time", "state.json"});
  expect_refused(Arguments{"evaluate", "--system"} + from + Arguments{"--set", "initial=1,2"},
                 {"--state", "exclude"});
  // Positions and velocities: p = M v with M = ((2, cos theta), (cos theta, 1)) of unit masses and lengths.
  write(files / "state.json", R"({"q": [0.25, 0], "v": [0, 2.5]})");
  const auto momenta = evaluated({"n-pendulum-angles", "--state", files / "state.json"})["state"];
  EXPECT_NEAR(momenta[2].get<double>(), 2.5 * std::cos(0.25), 1e-15);
  EXPECT_NEAR(momenta[3].get<double>(), 2.5, 1e-15);
  write(files / "state.json", R"({"z": [0.25, 2]})");
  EXPECT_EQ(evaluated(from + Arguments{"--time", "1"})["t"], 1.0);
  for (const auto& [bad, fragment] :
       {std::pair{"[]", "expected a JSON object"}, std::pair{R"({"z": [1]})", "expected 2 numbers"},
        std::pair{R"({"z": [1, 2, 3]})", "expected 2 numbers"},
        std::pair{R"({"y": [1, 2]})", "unknown key 'y'"},
        std::pair{R"({"z": [1, "a"]})", "initial p of damped-pendulum"}}) {
    write(files / "state.json", bad);
    expect_refused(Arguments{"evaluate", "--system"} + from, {fragment});
  }
}

TEST(Evaluate, Refuses) {
  const auto refused = [](const Arguments& more, const Arguments& fragments) {
    expect_refused(Arguments{"evaluate"} + more, fragments);
  };
  refused({}, {"--system is missing"});
  refused({"--system", "damped-oscilator"}, {"'damped-oscilator'", "damped-oscillator"});
  refused({"--system", "damped-oscillator", "--set", "mu=1"}, {"'mu'", "nu"});
  refused({"--system", "damped-oscillator", "--set", "nu=11"}, {"'nu'", "0 .. 10"});
  refused({"--system", "damped-oscillator", "--set", "initial=1"}, {"expected 2 numbers, got 1"});
  refused({"--system", "damped-oscillator", "--time", "soon"}, {"time", "'soon'"});
  refused({"--system", "damped-oscillator", "--precision", "half"}, {"'half'", "double"});
  refused({"--system", "damped-oscillator", "--centre", "1"}, {"centre state", "expected 2 numbers, got 1"});
  refused({"--system", "damped-oscillator", "--centre", "1,b"}, {"centre p", "'b'"});
  refused({"--system", "kepler", "--centre", "0,0,0,0"}, {"--centre", "kepler", "no structure K"});
  refused({"--system", "damped-oscillator", "--state", "none.json"}, {"none.json"});
}

TEST(Evaluate, OnAScreen) {
  for (const char* system : {"damped-oscillator", "magnetic-induction", "point-vortices", "kepler",
                             "coupled-damped-pendula", "free-rigid-body"}) {
    const Outcome outcome = run_pfaff({"evaluate", "--system", system});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
    EXPECT_NE(outcome.out.find("coordinate"), std::string::npos);
  }
  EXPECT_NE(run_pfaff({"evaluate", "--system", "damped-oscillator"}).out.find("regular, condition 1"),
            std::string::npos);
}

}  // namespace
