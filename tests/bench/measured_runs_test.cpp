// Tables of measures in the directories of runs and of experiments: made once, made anew where they have to
// be, and joined.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <pfaff/bench/experiment/measured_runs.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"
#include "run_settings.hpp"

namespace {
using namespace pfaff;
namespace fs = std::filesystem;
using ::testing::HasSubstr;

const char* const swings = R"(schema = 1
title = "A test"
[[method]]
label = "RK4, one"
integrator = "rk4"
[[method]]
label = "chosen"
integrator = "odeint-dopri5"
tolerance = ["1e-6"]
[[method]]
label = "two states"
integrator = "leap-frog"
[[case]]
name = "swing"
system = "damped-oscillator"
methods = ["RK4, one", "chosen", "two states"]
time = 4
steps = [0.1, 0.4, 0.2]
[[case]]
name = "many"
system = "quartic-nonholonomic"
methods = ["RK4, one"]
time = 4
steps = [0.1]
seeds = 2
)";

class MeasuredRuns : public ::testing::Test {
 protected:
  Experiment read(const std::string& more = "") {
    write_file(files / "test.toml", more + swings);
    return read_experiment(files / "test.toml", false);
  }
  // The lines of a joined table of an experiment in that folder; none where there is no table.
  std::vector<std::string> joined(const std::string& name, const std::string& folder = "") const {
    const auto text = text_in(files.path() / folder / "measures" / (name + ".csv"));
    std::istringstream stream(text.value_or(""));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  std::vector<std::string> written(const Experiment& of, const std::string& failed_step = "",
                                   const std::string& expected_notes = "") {
    const auto runs = expand(of);
    std::vector<nlohmann::json> summaries(runs.size(), {{"status", "converged"}, {"checksum", "a"}});
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (failed_step == "all" || runs[k].step == failed_step) summaries[k]["status"] = "non_finite";
    std::string notes;
    References references;
    write_measures(files.path(), of, runs, summaries, references, notes);
    EXPECT_EQ(notes, expected_notes);
    EXPECT_EQ(text_in(files.path() / "measures" / "notes.txt").value_or(""), expected_notes);
    return joined("reversibility");
  }
  static std::ptrdiff_t beginning_with(const std::vector<std::string>& lines, const std::string& begin) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const auto& line) { return line.starts_with(begin); });
  }
  pfaff::testing::TemporaryDirectory files;
};

// Of cases without seeds, of methods with fixed steps, of those that the measure fits.
TEST_F(MeasuredRuns, AreThoseAtTheLargestStepThatEndsWell) {
  const Experiment of = read();
  const auto not_led_back = [](const std::string& step) {
    return "reversibility of case swing, method two states, step " + step +
           " ends early: the method remembers earlier steps, and nothing is known to lead it back\n";
  };
  const auto lines = written(of, "", not_led_back("0.4"));
  EXPECT_EQ(lines.front(), "case,method,step,t,distance,rounding,by");
  const std::ptrdiff_t turns = 9;  // after 1 to 8 and 10 steps, as 10^(k/12) is rounded
  EXPECT_EQ(beginning_with(lines, "swing,\"RK4, one\",0.4,"), turns);
  EXPECT_EQ(std::ssize(lines), 1 + turns);
  EXPECT_EQ(joined("contraction").size(), 1 + 2 * 11U);  // two methods, the start and ten steps
  EXPECT_EQ(joined("poincare-loop").size(), 1 + 2 * 11U);
  EXPECT_EQ(beginning_with(joined("contraction"), "swing,two states,0.4,"), 11);
  const auto smaller = written(of, "0.4", not_led_back("0.2"));
  EXPECT_GT(beginning_with(smaller, "swing,\"RK4, one\",0.2,"), 0);
  EXPECT_EQ(beginning_with(smaller, "swing,\"RK4, one\",0.4,"), 0);
  EXPECT_TRUE(written(of, "all").empty());
}

// Coordinates that one case names are those of no other case.
TEST_F(MeasuredRuns, HaveThePlaneOfTheirCase) {
  const char* const two = R"(schema = 1
title = "A test"
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "orbit"
system = "kepler"
time = 4
steps = [0.1]
motion = ["q1", "p1"]
[[case]]
name = "swing"
system = "damped-oscillator"
time = 4
steps = [0.1]
[[case]]
name = "away"
system = "kepler"
time = 4
steps = [0.1]
reference = "none"
)";
  write_file(files / "test.toml", two);
  (void)written(read_experiment(files / "test.toml", false));
  const auto lines = joined("motion");
  EXPECT_EQ(lines.size(), 1 + 3 * 41U);
  EXPECT_EQ(beginning_with(lines, "orbit,RK4,0.1,0,q1,p1,1,0.4,0,0.4,0"), 1);
  EXPECT_EQ(beginning_with(lines, "swing,RK4,0.1,0,r [m],p [m/s],1,"), 1);
  EXPECT_EQ(beginning_with(lines, "away,RK4,0.1,0,q1,q2,1,0.4,0,,"), 1);  // without a solution
}

TEST_F(MeasuredRuns, AreThoseOfTheMeasuresThatAreNamed) {
  const std::string of_seeds = "contraction of many is left out: its runs have seeds\n";
  (void)written(read("measures = [\"contraction(looks=2)\"]\n"), "", of_seeds);
  EXPECT_EQ(joined("contraction").size(), 1 + 2 * 3U);
  (void)written(read("measures = [\"contraction(looks=2)\"]\n"), "all",
                "contraction of swing is left out: no run of it ended well\n" + of_seeds);
  EXPECT_TRUE(joined("reversibility").empty());
  EXPECT_TRUE(written(read("measures = []\n")).empty());
  EXPECT_TRUE(joined("contraction").empty());
  for (const auto& [text, words] : {std::pair("[\"contractoin\"]", "did you mean 'contraction'"),
                                    {"[\"contraction\", \"contraction(looks=2)\"]", "is asked for twice"},
                                    {"\"contraction\"", "expected a list"}})
    try {
      (void)read("measures = " + std::string(text) + "\n");
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
      EXPECT_THAT(error.what(), HasSubstr("key 'measures'"));
    }
}

// A table is made once, and anew where it was cut, edited or made of another run or with other settings.
TEST_F(MeasuredRuns, KeepTheirTables) {
  RunSettings settings = pfaff::testing::settings_of("pendulum", "0.1", "4");
  settings.integrator = "verlet";
  const ResolvedRun run = resolve(settings);
  const Measures measures = measures_asked_for({"poincare-loop"});
  const auto table = [&](const std::string& made_of, const Measures& asked) {
    return tables_of(files.path(), run, made_of, asked, *solution_of(run)).front();
  };
  const fs::path file = files.path() / "measures" / "poincare-loop.csv";
  const MeasureTable first = table("a", measures);
  EXPECT_EQ(first.columns, (std::vector<std::string>{"t", "integral", "uncertainty"}));
  EXPECT_EQ(first.lines.size(), 41U);
  const auto text = *text_in(file);
  const auto made = fs::last_write_time(file);
  const auto made_anew = [&] {
    const bool anew = fs::last_write_time(file) != made;
    fs::last_write_time(file, made);
    return anew;
  };
  fs::last_write_time(file, made);
  EXPECT_EQ(table("a", measures).lines, first.lines);
  EXPECT_FALSE(made_anew());
  EXPECT_EQ(table("b", measures).lines, first.lines);
  EXPECT_TRUE(made_anew());
  write_file(file, text.substr(0, text.size() - 10));
  fs::last_write_time(file, made);
  EXPECT_EQ(table("b", measures).lines, first.lines);
  EXPECT_TRUE(made_anew());
  EXPECT_EQ(*text_in(file), text);
  fs::remove(files.path() / "measures" / "poincare-loop.json");
  (void)table("b", measures);
  EXPECT_TRUE(made_anew());
  write_file(files.path() / "measures" / "poincare-loop.json", "[]\n");
  (void)table("b", measures);
  EXPECT_TRUE(made_anew());
  EXPECT_EQ(table("b", measures_asked_for({"poincare-loop(looks=5)"})).lines.size(), 6U);
  EXPECT_TRUE(made_anew());
}

TEST_F(MeasuredRuns, AreInThePrecisionOfTheRun) {
  RunSettings settings = pfaff::testing::settings_of("pendulum", "0.1", "1");
  settings.integrator = "verlet";
  settings.precision = Precision::quad;
  const ResolvedRun run = resolve(settings);
  const auto tables = tables_of(files.path(), run, "a",
                                measures_asked_for({"poincare-loop", "reversibility"}), *solution_of(run));
  EXPECT_GT(tables[0].lines.back().size(), 40U);
  EXPECT_THAT(tables[1].lines.back(), HasSubstr("e-3"));  // distances and roundings of 1e-3x
}

TEST_F(MeasuredRuns, AdaptiveOnesAreRefused) {
  RunSettings settings = pfaff::testing::settings_of("pendulum", "", "4");
  settings.integrator = "taylor";
  settings.tolerance = "1e-9";
  const auto measure = measure_asked_for("reversibility");
  EXPECT_THAT(refuses(*measure, resolve(settings)), HasSubstr("expected --step instead of --tolerance"));
}

// What a run measures of the structure of a step would be that of the method of its first steps.
// A quantity that only one of the systems has is a column of all rows, and empty in those of the others; the
// description names it.
TEST_F(MeasuredRuns, HaveTheColumnsOfAllCases) {
  write_file(files / "test.toml",
             "schema = 1\ntitle = \"A test\"\nmeasures = [\"error\"]\n[[method]]\nlabel = \"RK4\"\n"
             "integrator = \"rk4\"\n[[case]]\nname = \"plain\"\nsystem = \"harmonic-oscillator\"\ntime = 1\n"
             "steps = [0.25]\n[[case]]\nname = \"damped\"\nsystem = \"damped-oscillator\"\ntime = 1\n"
             "steps = [0.25]\n");
  (void)run_experiment(read_experiment(files / "test.toml", false), files.path() / "out", {},
                       {.report = false, .timing = 1e-4});
  const auto lines = joined("error", "out");
  ASSERT_EQ(lines.size(), 1U + 2 * 5);
  EXPECT_EQ(lines[0], "case,method,step,t,error,energy:error");
  EXPECT_TRUE(lines[5].starts_with("plain,") && lines[5].ends_with(",")) << lines[5];
  EXPECT_TRUE(lines[10].starts_with("damped,") && !lines[10].ends_with(",")) << lines[10];
  const auto described =
      nlohmann::json::parse(text_in(files.path() / "out" / "experiment.json").value_or(""));
  std::string columns;
  for (const auto& table : described["tables"])
    if (table["file"] == "measures/error.csv")
      for (const auto& column : table["columns"]) columns += column["name"].get<std::string>() + " ";
  EXPECT_EQ(columns, "case method step t error energy:error ");
}

TEST(MultistepRuns, HaveNoStructureOfAStep) {
  RunSettings settings = pfaff::testing::settings_of("kepler", "0.05", "20");
  settings.integrator = std::string(PFAFF_GOLDEN) + "/../../examples/tables/quinlan-tremaine-12.toml";
  EXPECT_FALSE(execute(resolve(settings), nullptr).structure_residual);
  settings.integrator = "gauss";
  EXPECT_TRUE(execute(resolve(settings), nullptr).structure_residual);
}

}  // namespace
