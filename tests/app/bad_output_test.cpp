// Output that cannot be written is refused before work starts (exit status 2) or reported where it happens
// (1), and never leaves half a row.
#include <algorithm>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments pendulum_run_to(const std::string& out, const std::string& time = "1") {
  return {"run",     "--system", "damped-pendulum", "--integrator", "rk4",   "--step", "0.1",
          "--every", "1",        "--time",          time,           "--out", out};
}

TEST(BadOutput, ADirectoryThatHoldsSomethingIsLeftAlone) {
  const TemporaryDirectory files;
  fs::create_directory(files.path() / "kept");
  write(files / "kept/notes.txt", "mine");
  expect_complaint(run_pfaff(pendulum_run_to(files / "kept")), 2, {"'" + files / "kept" + "' exists already"},
                   "run");
  EXPECT_EQ(text_of(files / "kept/notes.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(files.path() / "kept"), {}), 1);

  write(files / "file", "mine");
  expect_complaint(run_pfaff(pendulum_run_to(files / "file")), 2, {"exists already"}, "run to a file");
  EXPECT_EQ(text_of(files / "file"), "mine");
  expect_complaint(run_pfaff({"compare", "kepler", "--quick", "--out", files / "kept"}), 2,
                   {"exists already"}, "compare");
  EXPECT_EQ(std::distance(fs::directory_iterator(files.path() / "kept"), {}), 1);
}

// Files that have the names of ours are somebody else's where no run has left them.
TEST(BadOutput, FilesOfTheSameNamesAreLeftAlone) {
  const TemporaryDirectory files;
  fs::create_directories(files.path() / "thesis/measures");
  write(files / "thesis/measures/2024.csv", "mine");
  fs::create_directory(files.path() / "summary");
  write(files / "summary/summary.json", "{\"mine\": 1}");
  for (const char* name : {"thesis", "summary"})
    expect_complaint(run_pfaff(pendulum_run_to(files / name)), 2,
                     {"neither a config.toml nor a summary.json of a run", "--force"}, name);
  EXPECT_EQ(text_of(files / "thesis/measures/2024.csv"), "mine");
  EXPECT_EQ(text_of(files / "summary/summary.json"), "{\"mine\": 1}");
}

TEST(BadOutput, AnEmptyDirectoryIsTaken) {
  const TemporaryDirectory files;
  EXPECT_EQ(run_pfaff(pendulum_run_to(files.path().string())).status, 0);
  EXPECT_TRUE(fs::exists(files.path() / "summary.json"));
}

// Places where nobody can write, root included.
TEST(BadOutput, AParentThatCannotBeWritten) {
  const TemporaryDirectory files;
  write(files / "file", "mine");
  expect_complaint(run_pfaff(pendulum_run_to(files / "file/run")), 2, {"file/run' cannot be made"},
                   "run under a file");
  EXPECT_EQ(text_of(files / "file"), "mine");
  expect_refused(pendulum_run_to("/proc/run"), {"'/proc/run'", "cannot be made"});
  expect_refused(pendulum_run_to("/proc/self/fdinfo"), {"'/proc/self/fdinfo'"});
  expect_refused({"compare", "kepler", "--quick", "--out", "/proc/run"}, {"'/proc/run'", "cannot be made"});
}

TEST(BadOutput, FullDiskAmidTheWork) {
  // Room for config.toml and summary.json, not for a series of 1001 samples.
  const TemporaryDirectory files;
  Circumstances full;
  full.largest_file = 16384;
  const Outcome outcome = run_pfaff(pendulum_run_to(files / "run", "100"), full);
  const std::string series = text_of(files / "run/series.csv");
  const auto rows = std::count(series.begin(), series.end(), '\n') - 1;
  expect_complaint(outcome, 1, {"cannot write", "series.csv", std::to_string(rows) + " rows were written"},
                   "full disk");
  EXPECT_FALSE(fs::exists(files.path() / "run/summary.json"));
  // Control: with room for it, the same run is written.
  full.largest_file = 1 << 20;
  EXPECT_EQ(run_pfaff(pendulum_run_to(files / "again", "100"), full).status, 0);
  const std::string whole = text_of(files / "again/series.csv");
  EXPECT_GT(whole.size(), 16384U);
  // What was written is the beginning of it, up to the last row for which there was room.
  EXPECT_TRUE(whole.starts_with(series) && series.ends_with('\n'));
  EXPECT_GT(whole.find('\n', series.size()) + 1, 16384U);
}

TEST(BadOutput, FullDiskBeforeTheWork) {
  const TemporaryDirectory files;
  Circumstances full;
  full.largest_file = 0;
  expect_complaint(run_pfaff(pendulum_run_to(files / "run"), full), 2, {"cannot be written to"}, "full disk");
  EXPECT_TRUE(fs::is_empty(files.path() / "run"));
}

TEST(BadOutput, FullDiskInAnExperiment) {
  const TemporaryDirectory files;
  Circumstances full;
  full.largest_file = 32768;  // more than the description of the experiment, less than a series
  const Arguments compare{"compare", "kepler", "--quick", "--out", files / "kepler"};
  expect_complaint(run_pfaff(compare, full), 1, {"cannot write", "series.csv"}, "compare");
  EXPECT_FALSE(fs::exists(files.path() / "kepler/results.csv"));
  for (const auto& run : fs::directory_iterator(files.path() / "kepler/runs"))
    EXPECT_TRUE(run.path().extension() == ".part") << "counts as done: " << run.path();
}

// A full disk is an error; a reader that has what it wanted, such as head, is none.
TEST(BadOutput, StandardOutputThatTakesNothing) {
  Circumstances full;
  full.standard_output = "/dev/full";
  Circumstances gone;
  gone.nobody_reads = true;
  for (const Arguments& command :
       {pendulum_run_to("-"), pendulum_run_to("-", "1000"), Arguments{"list"}, Arguments{"list", "--json"},
        Arguments{"describe", "kepler"}, Arguments{"cite", "verlet"}, Arguments{"reproduce", "su-qin"}}) {
    expect_complaint(run_pfaff(command, full), 1, {"cannot write to standard output"}, joined(command));
    const Outcome outcome = run_pfaff(command, gone);
    EXPECT_EQ(outcome.status, 0) << joined(command);
    EXPECT_EQ(outcome.err, "") << joined(command);
  }
}

}  // namespace
