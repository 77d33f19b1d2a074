// The terminal's table of an experiment: what it marks, and how many digits it shows.
#include <gtest/gtest.h>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include "../temporary_directory.hpp"

namespace {

using namespace pfaff;

class ResultsTable : public ::testing::Test {
 protected:
  // An experiment of RK4 on one case.
  Experiment read(const std::string& of_case) {
    write_file(files.path() / "test.toml",
               "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n"
               "[[case]]\nname = \"case\"\n" +
                   of_case);
    return read_experiment(files / "test.toml", true);
  }
  pfaff::testing::TemporaryDirectory files;
  std::filesystem::path out = files.path() / "out";
};

TEST_F(ResultsTable, MarksTrendsBelowRoundOff) {
  Experiment experiment = read("system = \"damped-oscillator\"\ntime = 1.0\nsteps = [0.5]\n");
  experiment.cases[0].conserved = "birkhoffian";
  (void)run_experiment(experiment, out, {}, {.report = false});
  const auto runs = expand(experiment);
  auto summaries = read_summaries(out, runs);
  const auto table = [&](const char* kind, double slope) {
    auto& invariant = summaries[0]["invariants"][0];  // 1/2 at the start, in steps of 1/2
    invariant["class"] = kind;
    invariant["slope"] = slope;
    invariant["propagated"] = 0.5;
    return results_table(out, experiment, runs, summaries);
  };
  EXPECT_NE(table("linear", 1.0e-16).find("linear* "), std::string::npos);
  EXPECT_NE(table("linear", -1.0e-16).find("* slower than one unit of round-off a step"), std::string::npos);
  EXPECT_EQ(table("linear", -1.2e-16).find('*'), std::string::npos);
  EXPECT_EQ(table("bounded", 1.0e-18).find('*'), std::string::npos);
  EXPECT_NE(table("bounded", 0).find("(damped-oscillator, T = 1)"), std::string::npos);
  experiment.cases[0].conserved = "energy";
  EXPECT_NE(table("bounded", 0).find("never rises"), std::string::npos);
}

TEST_F(ResultsTable, ShowsSixDigitsOfFormulas) {
  const Experiment experiment =
      read("system = \"harmonic-oscillator\"\ntime = \"2*pi\"\nsteps = [\"2*pi/20\", \"0.1\"]\n");
  (void)run_experiment(experiment, out, {}, {.report = false});
  const auto runs = expand(experiment);
  const std::string table = results_table(out, experiment, runs, read_summaries(out, runs));
  for (const char* shown : {"T = 6.28319)", " 0.314159 ", " 0.1 "})
    EXPECT_NE(table.find(shown), std::string::npos) << shown << table;
}

}  // namespace
