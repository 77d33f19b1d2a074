// Rows of a run are written while it goes, stay whatever ends it, and are not replaced by fewer unasked.
#include <algorithm>
#include <chrono>
#include <thread>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments long_kepler_to(const std::string& out) {
  return {"run", "kepler",  "verlet", "--step", "0.001", "--time",
          "1e7", "--every", "1000",   "--out",  out,     "--quiet"};
}
std::ptrdiff_t lines_in(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return 0;
  const std::string text = text_of(path);
  return std::count(text.begin(), text.end(), '\n');
}
// Waits until a run that goes has more than so many lines; false where that takes longer than a minute.
bool has_more_lines(const fs::path& series, std::ptrdiff_t than) {
  for (int k = 0; k < 600 && lines_in(series) <= than; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return lines_in(series) > than;
}

TEST(StreamedRun, RowsComeWhileItGoesAndStayWhateverEndsIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
    SCOPED_TRACE(signal);
    const TemporaryDirectory files;
    const fs::path series = files.path() / "run/series.csv";
    Program program(long_kepler_to(files / "run"));
    ASSERT_TRUE(has_more_lines(series, 1));
    ASSERT_TRUE(has_more_lines(series, lines_in(series)));
    const std::string before = text_of(series);
    program.send(signal);
    const Outcome outcome = program.wait();
    const std::string text = text_of(series);
    EXPECT_TRUE(text.starts_with(before));
    if (signal == SIGKILL) continue;  // which may cut the write of a row in two
    EXPECT_TRUE(text.ends_with('\n'));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    const auto j = json_of(text_of(files / "run/summary.json"));
    EXPECT_EQ(j["status"], "interrupted");
    EXPECT_EQ(lines_in(series), j["completed"].get<std::ptrdiff_t>() / 1000 + 2);
    // Work is counted up to there, an evaluation a step.
    EXPECT_EQ(j["counts"]["steps"], j["completed"]);
    EXPECT_EQ(j["counts"]["right_hand_sides"], j["completed"]);
  }
}

TEST(StreamedRun, SaysWhereItsDirectoryVanishes) {
  const TemporaryDirectory files;
  Program program(long_kepler_to(files / "run"));
  ASSERT_TRUE(has_more_lines(files.path() / "run/series.csv", 1));
  fs::rename(files.path() / "run", files.path() / "elsewhere");
  const Outcome outcome = program.wait();
  const std::ptrdiff_t rows = lines_in(files.path() / "elsewhere/series.csv") - 1;
  expect_complaint(outcome, 1,
                   {"run/series.csv", "no longer there", std::to_string(rows) + " rows were written"},
                   "a directory that is moved");
}

// A program that does not say otherwise is ended by the signal of a file that becomes too long.
TEST(StreamedRun, OutlivesTheSignalOfAFileThatIsTooLong) {
  const TemporaryDirectory files;
  write(files / "limited", "#!/bin/sh\nulimit -f 32\nexec \"$@\"\n");
  fs::permissions(files.path() / "limited", fs::perms::owner_all);
  Circumstances limited;
  limited.program = files.path() / "limited";
  Arguments command{built_program()};
  const Arguments run = long_kepler_to(files / "run");
  command.insert(command.end(), run.begin(), run.end());
  expect_complaint(run_pfaff(command, limited), 1, {"series.csv: File too large; ", " rows were written"},
                   "ulimit -f");
}

TEST(StreamedRun, ALongerOneIsReplacedByForceAlone) {
  const TemporaryDirectory files;
  const auto pendulum = [&](const std::string& time) {
    return Arguments{"run", "pendulum", "rk4", "--step", "0.1",        "--time",
                     time,  "--every",  "1",   "--out",  files / "run"};
  };
  ASSERT_EQ(run_pfaff(pendulum("2")).status, 0);
  const std::string series = text_of(files / "run/series.csv");
  expect_complaint(run_pfaff(pendulum("1")), 2, {"another run that is longer, 21 rows to t = 2", "--force"},
                   "shorter");
  expect_complaint(run_pfaff(pendulum("3")), 2, {"another run; expected", "--force"}, "longer");
  fs::remove(files.path() / "run/config.toml");
  expect_complaint(run_pfaff(pendulum("1")), 2,
                   {"a run that is longer", "of which no config.toml says what it is", "--force"},
                   "of unknown settings");
  EXPECT_EQ(text_of(files / "run/series.csv"), series);
  EXPECT_EQ(run_pfaff(pendulum("1") + Arguments{"--force"}).status, 0);
  EXPECT_EQ(lines_in(files.path() / "run/series.csv"), 12);
  // Control: one of unknown settings that is no longer is replaced.
  fs::remove(files.path() / "run/config.toml");
  EXPECT_EQ(run_pfaff(pendulum("2")).status, 0);
}

// The motion of 1/(1 - t) ends at t = 1.
TEST(StreamedRun, IsMeasuredAsFarAsItCame) {
  const TemporaryDirectory files;
  write(files / "blow.toml",
        "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"-q^4/2\"\ninitial = [1, 1]\n");
  const Outcome failed = run_pfaff({"run", files / "blow.toml", "gauss", "--step", "0.01", "--time", "3",
                                    "--measure", "reversibility", "--out", files / "failed", "--json"});
  EXPECT_EQ(failed.status, 1) << failed.err;
  EXPECT_GT(lines_in(files.path() / "failed/measures/reversibility.csv"), 2);
  Program program(long_kepler_to(files / "run") + Arguments{"--measure", "reversibility"});
  ASSERT_TRUE(has_more_lines(files.path() / "run/series.csv", 1));
  program.send(SIGINT);
  expect_complaint(program.wait(), 1, {"interrupted at t = ", "nothing was measured"}, "an interrupted run");
  EXPECT_FALSE(fs::exists(files.path() / "run/measures"));
}

}  // namespace
