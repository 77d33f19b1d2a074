// pfaff run: what a run prints, and the files it leaves.
#include <cmath>
#include <cstdio>
#include <set>

#include <pfaff/core/numbers/real.hpp>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;
using pfaff::Quad;
using pfaff::Real;

// Lines that end early must show.
Arguments pendulum_to(const std::string& out, const Arguments& more) {
  return Arguments{"run", "--out", out, "--system", "damped-pendulum", "--integrator"} + more;
}
std::vector<std::vector<std::string>> series(const Arguments& more) {
  const Outcome run = run_pfaff(pendulum_to("-", more));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out.ends_with('\n'));
  return rows_of(run.out);
}
Quad quad(const std::string& text) {
  const auto number = Real::parse(text);
  EXPECT_TRUE(number.has_value()) << text;
  return number ? number->quad() : Quad(0);
}
// Digits that count: from the first that is not 0, exponent apart.
std::size_t digits(const std::string& text) {
  std::string kept;
  for (const char c : text.substr(0, text.find('e')))
    if (c >= '0' && c <= '9' && !(c == '0' && kept.empty())) kept += c;
  return kept.size();
}

TEST(Run, HeaderNamesTimeStateInvariantsAndResidualsWithUnits) {
  const auto rows = series({"rk4", "--step", "0.1", "--time", "1"});
  EXPECT_EQ(rows[0],
            (Arguments{"t [s]", "r [rad]", "p [rad/s]", "energy [rad^2/s^2]", "structure_residual [1]"}));
  const auto described = json_of(run_pfaff({"describe", "damped-pendulum", "--json"}).out);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& c = described["coordinates"][k];
    EXPECT_EQ(rows[0][k + 1], c["name"].get<std::string>() + " [" + c["unit"].get<std::string>() + "]");
  }
  EXPECT_EQ(rows[1][0], "0");
  EXPECT_EQ(rows[1][1], "1");
  EXPECT_EQ(rows[1][2], "0.5");
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
}

TEST(Run, FirstAndLastSamplesAndEveryKth) {
  const auto times = [](const Arguments& more) {
    std::vector<double> result;
    for (const auto& row : series(Arguments{"rk4", "--step", "0.1"} + more))
      if (row[0] != "t [s]") result.push_back(std::stod(row[0]));
    return result;
  };
  const auto expect_times = [](const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-15);
  };
  expect_times(times({"--time", "0.4"}), {0, 0.1, 0.2, 0.3, 0.4});
  expect_times(times({"--time", "1", "--every", "5"}), {0, 0.5, 1});
  expect_times(times({"--time", "1", "--every", "3"}), {0, 0.3, 0.6, 0.9, 1});
  expect_times(times({"--time", "1", "--every", "1000"}), {0, 1});
  expect_times(times({"--time", "0.35", "--quiet"}), {0, 0.1, 0.2, 0.3});  // whole steps
  EXPECT_EQ(times({"--time", "1000"}).size(), 1001U);                      // about a thousand by default
}

TEST(Run, SeventeenDigitsAndThirtySixInQuad) {
  const Arguments run{"generating-function", "--step", "0.1", "--time", "2"};
  std::size_t most = 0;
  auto rows = series(run);
  for (std::size_t k = 1; k < rows.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c) {
      most = std::max(most, digits(rows[k][c]));
      std::array<char, 40> again{};  // the text names one double
      std::snprintf(again.data(), again.size(), "%.17g", std::stod(rows[k][c]));
      EXPECT_EQ(rows[k][c], again.data());
    }
  EXPECT_EQ(most, 17U);
  most = 0;
  rows = series(run + Arguments{"--precision", "quad"});
  for (std::size_t k = 1; k < rows.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c) {
      most = std::max(most, digits(rows[k][c]));
      EXPECT_EQ(to_string(quad(rows[k][c]), 36), rows[k][c]);
    }
  EXPECT_EQ(most, 36U);
}

TEST(Run, DecimalInputsAreExactInQuad) {
  const auto rows = series({"rk4", "--step", "0.1", "--time", "2", "--precision", "quad", "--set",
                            "initial=0.1,1/3", "--set", "nu=0.3"});
  ASSERT_EQ(rows.size(), 22U);
  EXPECT_EQ(rows[21][0], "2");
  for (std::size_t k = 1; k < rows.size(); ++k)
    EXPECT_LE(abs(quad(rows[k][0]) - Quad(static_cast<int>(k - 1)) / Quad(10)), Quad(4e-34)) << rows[k][0];
  EXPECT_EQ(quad(rows[1][1]), Quad(1) / Quad(10));  // not 0.1000000000000000055
  EXPECT_EQ(quad(rows[1][2]), Quad(1) / Quad(3));
  const Quad energy = Quad(1) / Quad(18) + Quad(1) - cos(Quad(1) / Quad(10));
  EXPECT_LE(std::min(abs(quad(rows[1][3]) - energy), abs(quad(rows[1][3]) - energy + Quad(1))), Quad(1e-33));
}

TEST(Run, GoldenTrajectories) {
  const auto golden = json_of(text_of(fs::path(PFAFF_GOLDEN) / "damped_pendulum.json"))["trajectories"];
  int compared = 0;
  for (const auto& g : golden) {
    const int order = g["order"];
    const int steps = g["steps"];
    const auto text = [&](const char* key) { return g[key].get<std::string>(); };
    const Quad duration = Quad(steps) * quad(text("tau"));
    const TemporaryDirectory files;
    write(files / "state.json",
          R"({"t": ")" + text("t0") + R"(", "z": [")" + text("r0") + R"(", ")" + text("p0") + R"("]})");
    for (const auto& [precision, tolerance] : {std::pair{"double", 1e-14}, std::pair{"quad", 1e-30}}) {
      Arguments run{"generating-function",
                    "--set",
                    "order=" + std::to_string(order),
                    "--set",
                    "variant=P",
                    "--set",
                    "extra=0",
                    "--set",
                    "nu=" + text("nu"),
                    "--step",
                    text("tau"),
                    "--time",
                    to_string(duration, 20),
                    "--precision",
                    precision};
      for (const Arguments& start : {Arguments{"--set", "initial=" + text("r0") + "," + text("p0")},
                                     Arguments{"--state", files / "state.json"}}) {
        if (start[0] == "--set" && text("t0") != "0") continue;
        const auto rows = series(run + start);
        ASSERT_EQ(rows.size(), static_cast<std::size_t>(steps) + 2);
        EXPECT_LE(abs(quad(rows.back()[1]) - quad(text("r"))), Quad(tolerance)) << order << ' ' << precision;
        EXPECT_LE(abs(quad(rows.back()[2]) - quad(text("p"))), Quad(tolerance)) << order << ' ' << precision;
        compared += order == 6;
      }
    }
  }
  EXPECT_EQ(compared, 4);
}

TEST(Run, StateFiles) {
  const TemporaryDirectory files;
  const auto start = [&](const std::string& content, const Arguments& more = {}) {
    write(files / "state.json", content);
    return series(Arguments{"rk4", "--step", "0.5", "--time", "1", "--state", files / "state.json"} +
                  more)[1];
  };
  for (const std::string same :
       {R"({"t": 2, "z": [0.25, "-1/8"]})", R"({"t": "2", "q": [0.25], "p": ["-0.125"]})"}) {
    const auto row = start(same);
    EXPECT_EQ(row[0], "2");
    EXPECT_EQ(row[1], "0.25");
    EXPECT_EQ(row[2], "-0.125");
  }
  // JSON numbers keep all their digits.
  const std::string third = "0.333333333333333333333333333333333";
  const auto row = start(R"({"z": [)" + third + ", 1e-1]}", {"--precision", "quad"});
  EXPECT_EQ(quad(row[1]), quad(third));
  EXPECT_EQ(quad(row[2]), Quad(1) / Quad(10));
}

TEST(Run, LeavesThreeFilesAndSummarisesThem) {
  const TemporaryDirectory files;
  const Arguments run{"generating-function", "--step", "0.1", "--time", "10"};
  const Outcome outcome = run_pfaff(pendulum_to(files / "deep/er/run", run + Arguments{"--json"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(files.path() / "deep/er/run"))
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"config.toml", "series.csv", "summary.json"}));
  EXPECT_EQ(text_of(files / "deep/er/run/series.csv"), run_pfaff(pendulum_to("-", run)).out);
  EXPECT_EQ(text_of(files / "deep/er/run/summary.json"), outcome.out);
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["schema"], 2);
  EXPECT_EQ(j["status"], "converged");
  EXPECT_EQ(j["completed"], 100);
  EXPECT_EQ(j["steps"], 100);
  EXPECT_EQ(j["step"], "0.1");
  EXPECT_EQ(j["parameters"]["system.nu"], "0.3");
  EXPECT_EQ(j["parameters"]["integrator.order"], "4");
  EXPECT_LT(j["structure_residual"].get<double>(), 1e-14);
  EXPECT_EQ(j["invariants"][0]["name"], "energy");
  EXPECT_TRUE(j["invariants"][0]["initial"].is_number());
  for (const char* key : {"pfaff", "compiler", "flags", "standard"}) EXPECT_TRUE(j["versions"].contains(key));
  for (const char* key : {"steps", "right_hand_sides", "jacobians", "iterations", "factorisations"})
    EXPECT_GT(j["counts"][key], 0) << key;
}

TEST(Run, SaysWhatBecameOfQuantitiesThatMustDecrease) {
  TemporaryDirectory files;
  const Outcome outcome = run_pfaff({"run", "--system", "damped-pendulum", "--integrator", "rk4", "--step",
                                     "0.1", "--time", "10", "--out", files / "run"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("energy     largest rise 0, expected to decrease\n"), std::string::npos)
      << outcome.out;
}

TEST(Run, QuadNumbersAreStrings) {
  const TemporaryDirectory files;
  const Outcome outcome = run_pfaff(
      pendulum_to(files / "run", {"rk4", "--step", "0.1", "--time", "1", "--precision", "quad", "--json"}));
  const auto j = json_of(outcome.out);
  ASSERT_TRUE(j["invariants"][0]["initial"].is_string());
  EXPECT_EQ(digits(j["invariants"][0]["initial"]), 36U);
}

TEST(Run, ToStandardOutputNothingElseIsPrinted) {
  const Arguments run{"rk4", "--step", "0.1", "--time", "1"};
  const TemporaryDirectory files;
  Circumstances here;
  here.directory = files.path();
  EXPECT_EQ(run_pfaff(pendulum_to("-", run), here).out.find("t [s],r [rad],"), 0U);
  EXPECT_TRUE(fs::is_empty(files.path()));
}

TEST(Run, AdaptiveStepsEndAtTheHorizon) {
  const auto rows = series({"odeint-dopri5", "--tolerance", "1e-10", "--time", "10"});
  EXPECT_EQ(rows[1][0], "0");
  EXPECT_EQ(rows.back()[0], "10");
  const auto exact = series({"gauss", "--set", "stages=4", "--step", "0.05", "--time", "10"});
  EXPECT_NEAR(std::stod(rows.back()[1]), std::stod(exact.back()[1]), 1e-8);
}

// Over ten time units the errors of some steps of 1e-25 add up and the motion hardly multiplies them.
TEST(Run, AdaptiveStepsInQuad) {
  const auto rows = series({"extrapolation", "--tolerance", "1e-25", "--time", "10", "--precision", "quad",
                            "--reference", "solution"});
  EXPECT_EQ(rows.back()[0], "10");
  const auto exact =
      series({"gauss", "--set", "stages=12", "--step", "0.1", "--time", "10", "--precision", "quad"});
  for (const std::size_t k : {1U, 2U})
    EXPECT_LE(abs(quad(rows.back()[k]) - quad(exact.back()[k])), Quad(1e-23)) << k;
}

// The same numbers as an object: the summary, the columns with their units, and the rows.
TEST(Run, TheSeriesAsJson) {
  const Arguments run{"generating-function", "--step", "0.1", "--time", "10"};
  const auto j = json_of(run_pfaff(pendulum_to("-", run + Arguments{"--json"})).out);
  EXPECT_EQ(j["schema"], 2);
  EXPECT_EQ(j["status"], "converged");
  EXPECT_EQ(j["columns"][1], "r [rad]");
  std::istringstream lines(run_pfaff(pendulum_to("-", run)).out);
  std::string line;
  std::getline(lines, line);
  int without_value = 0;
  for (const auto& row : j["rows"]) {
    EXPECT_EQ(row.size(), j["columns"].size());
    std::getline(lines, line);
    std::istringstream cells(line);
    for (const auto& x : row) {
      std::string cell;
      std::getline(cells, cell, ',');
      without_value += x.is_null();
      EXPECT_EQ(x.is_null() ? "" : "a number", cell.empty() ? "" : "a number");
      if (x.is_number()) {
        EXPECT_EQ(x.get<double>(), std::stod(cell));
      }
    }
  }
  EXPECT_EQ(without_value, 50);  // the structure is measured at every other sample
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
