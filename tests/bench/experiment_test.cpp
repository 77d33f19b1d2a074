// Reading and keeping experiments: TOML numbers keep their digits, claims must be in scope, and timings
// survive when the program is killed.
#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/text/source.hpp>

namespace {

using namespace pfaff;
namespace fs = std::filesystem;

class Experiments : public ::testing::Test {
 protected:
  fs::path directory;
  void SetUp() override {
    std::string name = ::testing::TempDir() + "pfaff-experiment-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    directory = name;
  }
  void TearDown() override { fs::remove_all(directory); }
  Experiment read(const std::string& text) {
    write_file(directory / "test.toml", "schema = 1\ntitle = \"A test\"\nreference = [\"su-qin\"]\n" + text);
    return read_experiment((directory / "test.toml").string(), true);
  }
};

TEST_F(Experiments, NumbersKeepTheDigitsTheyAreWrittenWith) {
  const Experiment e = read(R"([[method]]
label = "Størmer–Verlet" # ν, before numbers on other lines
integrator = "verlet"
[[case]]
name = "ü"
system = "harmonic-oscillator"
time = 12.345678901234567890123456789
initial = [ 0.1, # π ≈
  -1.2345678901234567890123456789e-3, 7, "1/3",
  +0.5 ]
steps = [0.1, 1_000.000_000_000_000_000_001,
         2.5e-1]
set = { "ω₀" = "ω", omega = 0.123456789012345678901234567890, other = 1.0 }
precision = "quad"
)");
  const ExperimentCase& c = e.cases.at(0);
  EXPECT_EQ(c.time, "12.345678901234567890123456789");
  EXPECT_EQ(c.initial,
            (std::vector<std::string>{"0.1", "-1.2345678901234567890123456789e-3", "7", "1/3", "+0.5"}));
  EXPECT_EQ(c.steps, (std::vector<std::string>{"0.1", "1000.000000000000000001", "2.5e-1"}));
  for (const auto& [key, value] : c.set) {
    if (key == "omega") {
      EXPECT_EQ(value, "0.123456789012345678901234567890");
    } else if (key == "other") {
      EXPECT_EQ(value, "1.0");
    }
  }
  EXPECT_EQ(c.set.size(), 3U);
}

const char* const two_systems = R"([[method]]
label = "Gauss 4"
integrator = "gauss"
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "damped"
system = "damped-oscillator"
time = 1.0
steps = [0.5, 0.25]
[[case]]
name = "canonical"
system = "harmonic-oscillator"
time = 1.0
steps = [0.5]
)";

TEST_F(Experiments, ClaimsAreThoseInScopeOfEachSystem) {
  (void)run_experiment(read(two_systems), directory / "out", {});
  const auto j = nlohmann::json::parse(read_file(directory / "out/experiment.json"));
  const nlohmann::json gauss{
      {{"name", "damped-oscillator"}, {"order", 4}, {"preserves", {"symmetric"}}},
      {{"name", "harmonic-oscillator"},
       {"order", 4},
       {"preserves", {"symmetric", "reversible", "symplectic", "quadratic-invariants"}}}};
  EXPECT_EQ(j["methods"][0]["systems"], gauss);
  EXPECT_EQ(j["methods"][1]["systems"][0]["preserves"], nlohmann::json{"none"});
}

TEST_F(Experiments, ErrorsOfTextModelsKeepTheirExcerpt) {
  const std::string model = (directory / "model.toml").string();
  write_file(model, "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"mass*q\"\n");
  try {
    (void)expand(
        read("[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n"
             "[[case]]\nname = \"spring\"\nsystem = \"" +
             model + "\"\ntime = 1\ninitial = [1, 0]\nsteps = [0.5]\n"));
    FAIL() << "accepted";
  } catch (const text::TextError& error) {
    EXPECT_NE(std::string(error.what()).find("case spring, method RK4: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("model.toml:3:14: unknown name 'mass'"), std::string::npos)
        << error.what();
    EXPECT_EQ(error.excerpt(), "  mass*q\n  ^");
  }
}

TEST_F(Experiments, TimingsAreKeptAsTheyCome) {
  const Experiment experiment = read(two_systems);
  const fs::path costs = directory / "out/cost.csv";
  std::size_t timed = 0;
  const auto stop_at = [&](std::size_t row) {
    timed = 0;
    return [&timed, row](const std::string& what, std::size_t, std::size_t) {
      if (what.starts_with("timing ") && timed++ == row) throw RunError("stopped");
    };
  };
  const auto rows = [&] {
    std::vector<std::string> lines;
    std::istringstream text(read_file(costs));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  };
  EXPECT_THROW((void)run_experiment(experiment, directory / "out", stop_at(2)), RunError);
  const auto first = rows();
  ASSERT_EQ(first.size(), 3U);  // a header and two runs
  EXPECT_TRUE(first[1].starts_with("damped,Gauss 4,0.5,"));
  EXPECT_TRUE(first[2].starts_with("damped,Gauss 4,0.25,"));

  // A row that is missing in front of known ones: what is known stays while it is timed again.
  write_file(costs, first[0] + "\n" + first[2] + "\n");
  EXPECT_THROW((void)run_experiment(experiment, directory / "out", stop_at(1)), RunError);
  ASSERT_EQ(rows().size(), 3U);
  EXPECT_EQ(rows()[2], first[2]);

  (void)run_experiment(experiment, directory / "out", {});
  ASSERT_EQ(rows().size(), 7U);
  EXPECT_EQ(rows()[2], first[2]);
}

TEST_F(Experiments, TheTableMarksTrendsBelowRoundOff) {
  Experiment experiment = read(two_systems);
  experiment.cases[0].conserved = "birkhoffian";
  (void)run_experiment(experiment, directory / "out", {});
  const auto runs = expand(experiment);
  auto summaries = read_summaries(directory / "out", runs);
  const auto table = [&](const char* kind, double slope) {
    auto& invariant = summaries[0]["invariants"][0];  // 1/2 at the start, in steps of 1/2
    invariant["class"] = kind;
    invariant["slope"] = slope;
    return results_table(directory / "out", experiment, runs, summaries);
  };
  EXPECT_NE(table("linear", 1.0e-16).find("linear* "), std::string::npos);
  EXPECT_NE(table("linear", -1.0e-16).find("* slower than one unit of round-off a step"), std::string::npos);
  EXPECT_EQ(table("linear", -1.2e-16).find('*'), std::string::npos);
  EXPECT_EQ(table("bounded", 1.0e-18).find('*'), std::string::npos);
  EXPECT_NE(table("bounded", 0).find("(damped-oscillator, T = 1)"), std::string::npos);
  experiment.cases[0].conserved = "energy";
  EXPECT_NE(table("bounded", 0).find("never rises"), std::string::npos);
}

}  // namespace
