// Runs are never lost: whenever a run is killed, its directory is taken by the next one, which leaves the
// same bytes as a run that nobody disturbed; a run that is interrupted keeps its samples; and two processes
// never work in one directory.
#include <algorithm>
#include <chrono>
#include <thread>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;
using Clock = std::chrono::steady_clock;
const std::vector<const char*> names{"config.toml", "series.csv", "summary.json"};

Arguments killed_run_to(const std::string& out, const std::string& time) {
  return {"run",    "--out", out,      "--system", "damped-pendulum", "--integrator", "rk4",
          "--step", "0.1",   "--time", time,       "--json"};
}
// A run of ten thousand steps that takes a twentieth of a second: nothing is classified at its end, because
// the system has no invariants, and so most of its time is spent in steps.
Arguments spring_to(const std::string& out, const std::string& time = "100") {
  const std::string plugin = test_plugin("spring-1");
  return {"run",    "--out", out,      "--system", "test-spring", "--integrator", "verlet",
          "--step", "0.01",  "--time", time,       "--json",      "--plugin",     plugin};
}

// 200 kills, evenly spread from the start of the program to its end; 40 with the sanitizers, where each run
// takes five times as long. Every fifth of them is followed by a whole run; after the others the next kill
// falls on what the one before has left.
TEST(KilledRun, LeavesADirectoryThatIsTakenUp) {
  const TemporaryDirectory files;
  const Arguments run = spring_to(files / "run");
  std::vector<Clock::duration> durations;
  const auto run_whole = [&](const Arguments& arguments) {
    const auto begin = Clock::now();
    const Outcome outcome = run_pfaff(arguments);
    durations.push_back(Clock::now() - begin);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  // A machine may be busy with other work at one time and not at another: what counts are the last few runs.
  const auto duration = [&] {
    std::vector<Clock::duration> last(durations.end() - std::min<std::ptrdiff_t>(5, std::ssize(durations)),
                                      durations.end());
    std::sort(last.begin(), last.end());
    return last[last.size() / 2];
  };
  const auto expect_whole = [&] {
    for (const char* name : names)
      ASSERT_EQ(text_of(files.path() / "run" / name), text_of(files.path() / "whole" / name)) << name;
    std::size_t entries = 0;
    for (const auto& entry : fs::directory_iterator(files.path() / "run")) entries += entry.exists() ? 1 : 0;
    EXPECT_EQ(entries, names.size()) << "something is left over";
    fs::remove_all(files.path() / "run");
  };
  for (int k = 0; k < 3; ++k) {
    fs::remove_all(files.path() / "whole");
    run_whole(spring_to(files / "whole"));
  }
  const int kills = has_address_sanitizer() ? 40 : 200;
  constexpr int in_a_row = 5;
  int before_the_end = 0, with_files = 0;
  for (int kill = 0; kill < kills; ++kill) {
    // Moments in an order that mixes early and late ones: 77 has no common divisor with either number.
    const auto moment = duration() * ((kill * 77) % kills) / kills;
    bool ended = false;
    {
      Program program(run);
      std::this_thread::sleep_for(moment);
      ended = program.ended();
      program.kill();
      (void)program.wait();
    }
    before_the_end += ended ? 0 : 1;
    with_files += fs::exists(files.path() / "run/config.toml") ? 1 : 0;
    if (kill % in_a_row == in_a_row - 1) run_whole(run);
    if (ended || kill % in_a_row == in_a_row - 1) expect_whole();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(before_the_end, kills / 2);
  RecordProperty("before_the_end", before_the_end);
  RecordProperty("with_files", with_files);
}

// Every state that the writing of three files can leave, one after the other.
TEST(KilledRun, HalfWrittenFilesAreNotTaken) {
  const TemporaryDirectory files;
  const Arguments run = spring_to(files / "run", "0.2");
  ASSERT_EQ(run_pfaff(run).status, 0);
  std::vector<std::string> whole;
  for (const char* name : names) whole.push_back(text_of(files.path() / "run" / name));
  for (std::size_t written = 0; written < names.size(); ++written)
    for (const std::size_t part :
         {std::size_t{0}, std::size_t{1}, whole[written].size() / 2, whole[written].size() - 1}) {
      for (const bool renamed : {false, true}) {
        SCOPED_TRACE(std::string(names[written]) + ", " + std::to_string(part) + " bytes");
        fs::remove_all(files.path() / "run");
        fs::create_directory(files.path() / "run");
        for (std::size_t k = 0; k < written; ++k) write(files.path() / "run" / names[k], whole[k]);
        write(files / ("run/" + std::string(names[written]) + (renamed ? "" : ".part")),
              whole[written].substr(0, part));
        write(files / "run/.lock", "process 1 on nowhere");
        const Outcome outcome = run_pfaff(run);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        for (std::size_t k = 0; k < names.size(); ++k)
          EXPECT_EQ(text_of(files.path() / "run" / names[k]), whole[k]) << names[k];
      }
    }
}

// Returns half a second after the program has begun to work in the directory.
void wait_for_lock(const Program& program, const fs::path& directory) {
  while (!program.ended() && !fs::exists(directory / ".lock"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
}

TEST(InterruptedRun, KeepsItsSamplesAndSaysSo) {
  const TemporaryDirectory files;
  const Arguments run = killed_run_to(files / "run", "1e8") + Arguments{"--every", "100"};
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(run);
    wait_for_lock(program, files.path() / "run");
    ASSERT_FALSE(program.ended());
    program.send(signal);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    for (const char* said : {"interrupted at t = ", "(step ", "completed samples are kept"})
      EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    const auto j = json_of(outcome.out);
    EXPECT_EQ(j["status"], "interrupted");
    EXPECT_EQ(text_of(files / "run/summary.json"), outcome.out);
    EXPECT_EQ(static_cast<int>(rows_of(text_of(files / "run/series.csv")).size()) - 2,
              j["completed"].get<int>() / 100);
  }
  // The samples are those of a run that nobody interrupts.
  const auto part = rows_of(text_of(files / "run/series.csv"));
  ASSERT_GE(part.size(), 3U);
  ASSERT_EQ(run_pfaff(killed_run_to(files / "whole", "10") + Arguments{"--every", "100"}).status, 0);
  const auto whole = rows_of(text_of(files / "whole/series.csv"));
  ASSERT_GE(whole.size(), 3U);
  for (std::size_t column = 0; column < 4; ++column) EXPECT_EQ(part[2][column], whole[2][column]);
  // An interrupted run is not the run that was asked for: the next one begins anew.
  Program again(run);
  wait_for_lock(again, files.path() / "run");
  EXPECT_FALSE(again.ended());
  again.send(SIGINT);
  EXPECT_EQ(again.wait().status, 1);
}

TEST(TwoProcesses, TheSecondSaysWhoIsThere) {
  const TemporaryDirectory files;
  write(files / "test.toml",
        "schema = 1\ntitle = \"A test\"\n[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n[[case]]\n"
        "name = \"long\"\nsystem = \"damped-pendulum\"\ntime = \"1e6\"\nsteps = [\"0.01\"]\n"
        "precision = \"quad\"\nreference = \"none\"\n");
  for (const Arguments& command : {killed_run_to(files / "out", "1e9"),
                                   Arguments{"compare", files / "test.toml", "--out", files / "out"}}) {
    Program first(command);
    wait_for_lock(first, files.path() / "out");
    ASSERT_FALSE(first.ended());
    expect_complaint(run_pfaff(command), 2,
                     {files / "out", "is in use by process " + std::to_string(first.id()),
                      "pfaff " + command[0], "since 20"},
                     joined(command));
    first.kill();
    (void)first.wait();
    // The lock of a process that was killed holds nobody back.
    EXPECT_TRUE(fs::exists(files.path() / "out/.lock"));
    Program next(command);
    wait_for_lock(next, files.path() / "out");
    EXPECT_FALSE(next.ended());
    next.kill();
    (void)next.wait();
    fs::remove_all(files.path() / "out");
  }
}

}  // namespace
