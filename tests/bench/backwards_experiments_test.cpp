// Experiments backwards in time. Motions that begin at rest, or across the line to the centre, are their own
// reversals, so that what is measured backwards is what is measured forwards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;

constexpr const char* methods = R"(schema = 1
title = "There and back"
measures = []

[[method]]
label = "Verlet"
integrator = "verlet"

[[method]]
label = "Gauss"
integrator = "gauss"

[[method]]
label = "chosen"
integrator = "extrapolation"
tolerance = ["1e-6"]
)";

// Rows of a table, each a map from the name of a column; without quotation marks.
std::vector<std::map<std::string, std::string>> table(const std::filesystem::path& path) {
  std::istringstream lines(read_file(path));
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells = split_commas(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = cells[k];
  }
  return rows;
}
double number(const std::string& text) { return Real::parse(text)->value(); }

class BackwardsExperiments : public ::testing::Test {
 protected:
  Experiment read(const std::string& cases) {
    write_file(files / "test.toml", methods + cases);
    return read_experiment(files / "test.toml", false);
  }
  std::filesystem::path made(const std::string& name, const std::string& cases) {
    const std::filesystem::path directory = files.path() / name;
    const ExperimentOutcome outcome =
        run_experiment(read(cases), directory, {}, {.report = false, .timing = 0.001});
    EXPECT_EQ(outcome.failed, 0U);
    return directory;
  }
  static std::string swing(const std::string& time, const std::string& steps) {
    return "[[case]]\nname = \"swing\"\nsystem = \"pendulum\"\ninitial = [2, 0]\nconserved = "
           "\"energy\"\ntime = " +
           time + "\nsteps = " + steps + "\n";
  }
  pfaff::testing::TemporaryDirectory files;
};

TEST_F(BackwardsExperiments, NameStepsByTheirSizes) {
  const Experiment experiment =
      read(swing("\"-4*pi\"", "[\"-0.1\", 0.05, \"-pi/100\"]") +
           "[[finding]]\ncase = \"swing\"\nmeasure = \"error_max\"\nmethod = \"Verlet\"\n"
           "relation = \"exceeds\"\nthan = \"Gauss\"\nstep = \"-0.1\"\n");
  EXPECT_EQ(experiment.claims.front().step, "0.1");
  const auto runs = expand(experiment);
  EXPECT_EQ(runs[0].step, "0.1");
  EXPECT_EQ(runs[1].step, "0.05");
  EXPECT_THAT(runs[2].step, ::testing::StartsWith("0.0314159"));
  for (const ExperimentRun& run : runs)
    if (run.tolerance.empty()) {
      EXPECT_LT(run.resolved.step, Real(0));
    }
  EXPECT_THROW((void)expand(read(swing("4", "[\"-0.1\"]"))), InputError);
}

// The state is of size 2, and 1e-9 of it is far above what a hundred roundings make of it.
TEST_F(BackwardsExperiments, MeasureWhatIsMeasuredForwards) {
  const auto there = table(made("there", swing("-20", "[0.1, \"-0.05\"]")) / "results.csv"),
             here = table(made("here", swing("20", "[0.1, 0.05]")) / "results.csv");
  ASSERT_EQ(there.size(), 5U);
  ASSERT_EQ(here.size(), 5U);
  for (std::size_t k = 0; k < there.size(); ++k) {
    EXPECT_EQ(there[k].at("time"), "-20");
    for (const char* same : {"step", "steps", "status", "energy:class"})
      EXPECT_EQ(there[k].at(same), here[k].at(same)) << same;
    for (const char* near : {"error_max", "error_final", "energy:max", "energy:rms"})
      EXPECT_NEAR(number(there[k].at(near)), number(here[k].at(near)), 1e-9) << near;
    EXPECT_NEAR(number(there[k].at("energy:slope")), -number(here[k].at("energy:slope")), 1e-9);
  }
}

// Trials go back too: of a motion without a closed form the solution is known there alone.
TEST_F(BackwardsExperiments, ChooseTheSameSteps) {
  const auto swinging = [](const std::string& time) {
    return "[[case]]\nname = \"rest\"\nsystem = \"henon-heiles\"\ninitial = [0.3, 0.1, 0, 0]\nconserved = "
           "\"energy\"\n"
           "steps = \"auto\"\nevaluations = 1e4\ntime = " +
           time + "\n";
  };
  const auto there = table(made("there", swinging("-20")) / "results.csv"),
             here = table(made("here", swinging("20")) / "results.csv");
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t k = 0; k < there.size(); ++k) EXPECT_EQ(there[k].at("step"), here[k].at("step"));
}

// A vector that turns by an angle forwards turns by its opposite backwards, in a time that is negative too.
TEST_F(BackwardsExperiments, Frequencies) {
  const auto orbit = [](const std::string& time) {
    return "[[case]]\nname = \"orbit\"\nsystem = \"kepler\"\nmethods = [\"Verlet\", \"Gauss\"]\nconserved = "
           "\"energy\"\nset = { eccentricity = 0.1 }\nsteps = [0.1, 0.05]\ntime = " +
           time + "\n[[case.frequency]]\nname = \"position\"\nx = \"q1\"\ny = \"q2\"\n";
  };
  const auto there = table(made("there", orbit("-30")) / "measures/frequency.csv"),
             here = table(made("here", orbit("30")) / "measures/frequency.csv");
  ASSERT_EQ(there.size(), 4U);
  ASSERT_EQ(here.size(), 4U);
  for (std::size_t k = 0; k < there.size(); ++k) {
    EXPECT_NEAR(number(there[k].at("frequency")), 1, 0.01);
    for (const char* near : {"frequency", "error"})
      EXPECT_NEAR(number(there[k].at(near)), number(here[k].at(near)), 1e-9) << near;
  }
}

// Areas grow by e^{0.3 |t|} on the way back, and are looked at until the run ends; at the largest step.
TEST_F(BackwardsExperiments, Contraction) {
  write_file(files / "test.toml",
             "schema = 1\ntitle = \"Areas\"\nmeasures = [\"contraction\"]\n[[method]]\nlabel = "
             "\"Gauss\"\nintegrator = \"gauss\"\n[[case]]\nname = \"damped\"\nsystem = "
             "\"damped-oscillator\"\ntime = -5\nsteps = [0.05, 0.1]\n");
  const std::filesystem::path directory = files.path() / "areas";
  (void)run_experiment(read_experiment(files / "test.toml", false), directory, {},
                       {.report = false, .timing = 0.001});
  const auto rows = table(directory / "measures" / "contraction.csv");
  ASSERT_EQ(rows.size(), 51U);
  EXPECT_EQ(rows.back().at("step"), "0.1");
  EXPECT_EQ(rows.back().at("t"), "-5");
  EXPECT_NEAR(number(rows.back().at("law")), std::exp(1.5), 1e-12);
  EXPECT_NEAR(number(rows.back().at("area")), std::exp(1.5), 1e-4);  // h^4/720 in each of five units of time
}

TEST_F(BackwardsExperiments, ErrorsAtEveryRowAreAskedFor) {
  const std::string rows = swing("-30", "[0.01]");
  const auto some = table(made("some", rows) / "results.csv"),
             all = table(made("all", rows + "reference = \"every\"\n") / "results.csv");
  EXPECT_LE(number(some[0].at("error_max")), number(all[0].at("error_max")));
  EXPECT_FALSE(read(rows).cases.front().errors_at_every_row);
  EXPECT_TRUE(read(rows + "reference = \"solution,every\"\n").cases.front().errors_at_every_row);
  EXPECT_TRUE(read(rows + "reference = \"every\"\n").cases.front().reference);
  EXPECT_THROW((void)read(rows + "reference = \"none,every\"\n"), InputError);
  EXPECT_THROW((void)read(rows + "reference = \"exact\"\n"), InputError);
}

}  // namespace
