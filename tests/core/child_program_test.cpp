// Programs that are started: what they write and how they end, what they get of the environment, and that
// they and what they started end with their time.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/process/child_program.hpp>

#include "../processes.hpp"
#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Kind = ChildEnding::Kind;

ChildProgram shell(const std::string& script) { return {.words = {"sh", "-c", script}}; }

TEST(ChildProgram, SaysHowItEndedAndWhatItWrote) {
  const ChildEnding fine = run_program(shell("echo out; echo err >&2"));
  EXPECT_TRUE(fine.succeeded());
  EXPECT_EQ(fine.output, "out\nerr\n");
  EXPECT_EQ(run_program(shell("exit 3")).in_words(), "ended with status 3");
  EXPECT_EQ(run_program(shell("kill -KILL $$")).in_words(), "was ended by: Killed");
  const ChildEnding missing = run_program({.words = {"/nowhere/program"}});
  EXPECT_EQ(missing.kind, Kind::not_started);
  EXPECT_EQ(missing.in_words(), "could not be run: No such file or directory");
  // More than a pipe holds.
  EXPECT_EQ(run_program(shell("head -c 300000 /dev/zero")).output.size(), 300000U);
}

// Words are given as they are: there is no shell in between.
TEST(ChildProgram, WordsAreNotInterpreted) {
  EXPECT_EQ(run_program({.words = {"printf", "%s", "a b; $(exit 1) '\"*"}}).output, "a b; $(exit 1) '\"*");
}

TEST(ChildProgram, GetsTheEnvironmentAndNoOpenFiles) {
  setenv("PFAFF_ONE", "1", 1);
  setenv("PFAFF_TWO", "2", 1);
  ChildProgram program = shell("echo \"$PFAFF_ONE/$PFAFF_TWO/$PFAFF_THREE\"; pwd; read x; echo \"read $?\"");
  program.without = {"PFAFF_TWO"};
  program.with = {"PFAFF_THREE=3", "PFAFF_ONE=one"};
  program.directory = "/";
  EXPECT_EQ(run_program(program).output, "one//3\n/\nread 1\n");
  unsetenv("PFAFF_ONE");
  unsetenv("PFAFF_TWO");
  const TemporaryDirectory files;
  const int inherited = open((files / "file").c_str(), O_WRONLY | O_CREAT, 0600);  // not closed on exec
  ASSERT_GT(inherited, 2);
  EXPECT_EQ(run_program(shell("ls /proc/self/fd | wc -l")).output,
            run_program(shell("ls /proc/self/fd 9</dev/null 9<&- | wc -l")).output);
  EXPECT_EQ(run_program(shell("test -e /proc/$$/fd/" + std::to_string(inherited) + " || echo closed")).output,
            "closed\n");
  close(inherited);
}

TEST(ChildProgram, EndsWithItsTimeAndTakesWhatItStartedAlong) {
  const TemporaryDirectory files;
  for (const char* script : {"echo $$ >number; sleep 1000", "sleep 1000 & echo $! >number; wait",
                             "echo $$ >number; exec >/dev/null 2>&1; sleep 1000"}) {
    ChildProgram program = shell(script);
    program.directory = files.path();
    program.limit = std::chrono::milliseconds(300);
    EXPECT_EQ(run_program(program).kind, Kind::timed_out) << script;
    EXPECT_TRUE(gone(process_in(files / "number"))) << script;
  }
  // What is left behind by a program that ends holds its output, for which nobody waits.
  ChildProgram program = shell("sleep 1000 & echo $! >number; exit 5");
  program.directory = files.path();
  program.limit = std::chrono::seconds(100);
  const ChildEnding ending = run_program(program);
  EXPECT_EQ(ending.kind, Kind::exited);
  EXPECT_EQ(ending.status, 5);
  EXPECT_TRUE(gone(process_in(files / "number")));
}

// As where somebody who waits for a compiler presses Ctrl-C.
TEST(ChildProgram, EndsWithAllThatItStartedWhereTheBudgetIsStopped) {
  std::atomic<bool> stop{false};
  const Budget budget({}, &stop);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW((void)run_program(shell("sleep 30 & wait")), BudgetSpent);
  later.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}
}  // namespace
