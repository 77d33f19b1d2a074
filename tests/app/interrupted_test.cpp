// Ctrl-C and SIGTERM end every command that works for long, soon and in one line that says what was done by
// then.
#include <chrono>
#include <regex>
#include <thread>

#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// Sends a signal to the command when it has worked for a while. How long it takes to end is not measured:
// what does not end at all is killed by the alarm of the program.
Outcome interrupted(const Arguments& arguments, int signal,
                    std::chrono::milliseconds when = std::chrono::milliseconds(1500)) {
  Program program(arguments);
  std::this_thread::sleep_for(when);
  EXPECT_FALSE(program.ended()) << joined(arguments);
  program.send(signal);
  return program.wait();
}

// The same, later where nothing was done by then, as under sanitizers.
Outcome interrupted_at_work(const Arguments& arguments, int signal = SIGINT,
                            std::chrono::milliseconds when = std::chrono::milliseconds(1500)) {
  Outcome outcome;
  for (; when < std::chrono::minutes(1); when *= 4) {
    outcome = interrupted(arguments, signal, when);
    const auto says = [&](const char* what) { return outcome.err.find(what) != std::string::npos; };
    if (!says("no group") && !says("before anything was made")) break;
  }
  return outcome;
}

TEST(Interrupted, CommandsEndAndSayWhatWasDone) {
  const std::vector<std::pair<Arguments, std::string>> commands{
      {{"falsify", "gauss", "--budget", "600"}, "random systems"},
      {{"tune", "henon-heiles", "--step", "0.1", "--order", "4", "--stages", "9", "--starts", "1000000"},
       "starts of a search"},
      {{"reproduce", "--json"}, "papers were reproduced"}};
  int signal = SIGINT;
  for (const auto& [command, said] : commands) {
    // All papers are reproduced in a second and a half on a fast machine.
    expect_complaint(interrupted_at_work(command, signal, std::chrono::milliseconds(500)), 1,
                     {"interrupted: ", said}, joined(command));
    signal = signal == SIGINT ? SIGTERM : SIGINT;
  }
}

TEST(Interrupted, VerificationShowsTheChecksThatWereMade) {
  const Outcome text = interrupted_at_work({"verify", "gauss", "--full"});
  EXPECT_EQ(text.status, 1);
  EXPECT_TRUE(std::regex_match(text.err,
                               std::regex(R"(pfaff: interrupted: \d+ of \d+ groups of checks were made\n)")))
      << text.err;
  EXPECT_NE(text.out.find("worst (allowed)"), std::string::npos) << text.out;
  const nlohmann::json made = json_of(interrupted_at_work({"verify", "gauss", "--full", "--json"}).out);
  EXPECT_FALSE(made["ok"].get<bool>());
  EXPECT_NE(made["verdict"].get<std::string>().find("groups of checks were made"), std::string::npos);
  EXPECT_GT(made["counts"]["pass"].get<int>(), 0);
}

// The trial run that finds out how many samples are kept is as long as the run itself.
TEST(Interrupted, ARunWhoseMethodChoosesItsStepsKeepsItsSamples) {
  const TemporaryDirectory files;
  const Arguments run{"run",    "kepler", "odeint-dopri5", "--tolerance", "1e-10",
                      "--time", "1e8",    "--json",        "--out",       files / "run"};
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = interrupted(run, signal);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted at t = "), std::string::npos) << outcome.err;
    EXPECT_EQ(json_of(outcome.out)["status"], "interrupted");
    EXPECT_GE(rows_of(text_of(files / "run/series.csv")).size(), 2U);
  }
}

// A reference solution over so long a time takes longer than anybody waits.
TEST(Interrupted, AReferenceSolutionEnds) {
  const TemporaryDirectory files;
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = interrupted({"run", "henon-heiles", "rk4", "--step", "1", "--time", "1e5",
                                         "--reference", "solution", "--out", files / "run"},
                                        signal);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  }
}

}  // namespace
