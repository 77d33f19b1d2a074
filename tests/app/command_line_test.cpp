// Command lines that contradict themselves are refused in one line, with exit status 2 and nothing written;
// help has to arrive; what does not fit into memory is said.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments pendulum_with(const Arguments& more) {
  return Arguments{"run",    "--out", "-",      "--system", "damped-pendulum", "--integrator", "rk4",
                   "--step", "0.1",   "--time", "1"} +
         more;
}

TEST(CommandLine, AParameterIsSetOnce) {
  expect_refused(pendulum_with({"--set", "nu=0.1", "--set", "nu=0.2"}), {"'nu'", "damped-pendulum", "twice"});
  expect_refused(pendulum_with({"--set", "nu=0.1", "--set", "system.nu=0.1"}), {"'nu'", "twice"});
  expect_refused(pendulum_with({"--set", "initial=1,0", "--set", "initial=1,0"}), {"'initial'", "twice"});
  expect_refused({"evaluate", "--system", "damped-pendulum", "--set", "nu=0.1", "--set", "nu=0.1"},
                 {"'nu'", "twice"});
  const Arguments composed{"run",         "--out",  "-",   "--system", "kepler", "--integrator",
                           "composition", "--step", "0.1", "--time",   "1"};
  expect_refused(composed + Arguments{"--set", "base=verlet(compensated=no, compensated=yes)"},
                 {"'compensated'", "twice"});
  std::string nested = "verlet";
  for (int k = 0; k < 5000; ++k) nested = "composition(base=" + nested + ")";
  expect_refused(composed + Arguments{"--set", "base=" + nested}, {"'base'", "at most 8 plug-ins"});
  // A setting of a plug-in that is set by name is no second one of the parameter itself.
  EXPECT_EQ(
      run_pfaff(composed + Arguments{"--set", "base=verlet(compensated=no)", "--set", "base.compensated=yes"})
          .status,
      0);
}

TEST(CommandLine, OptionsThatExcludeEachOther) {
  const TemporaryDirectory files;
  write(files / "config.toml",
        "schema = 1\nsystem = \"damped-pendulum\"\nintegrator = \"rk4\"\ntime = \"1\"\n");
  for (const std::string flag : {"--project-initial", "--allow-inconsistent"}) {
    expect_refused({"run", "--out", "-", "--config", files / "config.toml", flag},
                   {"--config holds the whole run"});
    expect_refused(pendulum_with({flag}), {flag, "damped-pendulum", "no constraints"});
  }
  expect_refused({"run", "--out", "-", "--system", "damped-pendulum", "--integrator", "odeint-dopri5",
                  "--tolerance", "1e-6", "--time", "1", "--every", "2"},
                 {"--every", "--tolerance"});
}

TEST(CommandLine, AnOptionIsNoValue) {
  const Arguments run{"run", "--system", "damped-pendulum", "--integrator", "rk4", "--time", "1"};
  expect_refused(run + Arguments{"--out", "-h"}, {"--out", "expected a value", "'-h'"});
  expect_refused(run + Arguments{"--out", "--help"}, {"--out", "expected a value", "'--help'"});
  expect_refused(run + Arguments{"--out", "--step", "0.1"}, {"--out", "expected a value", "'--step'"});
  expect_refused({"compare", "--out", "-h"}, {"--out", "'-h'"});
  expect_refused({"list", "--plugin", "-h"}, {"--plugin", "'-h'"});
  // Controls: a negative number is a value, and help where no value is missing is help.
  expect_refused(pendulum_with({"--set", "nu=-1"}), {"'nu'"});
  EXPECT_EQ(run_pfaff({"run", "--out", "-", "--step", "-1", "-h"}).status, 0);
  EXPECT_EQ(run_pfaff({"run", "--json", "-h"}).status, 0);
}

TEST(CommandLine, HelpHasToArrive) {
  Circumstances full;
  full.standard_output = "/dev/full";
  for (const Arguments& command :
       {Arguments{"--help"}, Arguments{"-h"}, Arguments{"run", "--help"}, Arguments{"--version"}}) {
    expect_complaint(run_pfaff(command, full), 1, {"cannot write to standard output"}, joined(command));
    EXPECT_EQ(run_pfaff(command).status, 0);
  }
}

// Two million rows take more bytes than there are; none of them is kept.
TEST(CommandLine, ALongSeriesNeedsNoMemory) {
  if (has_address_sanitizer())
    GTEST_SKIP() << "the address sanitizer reserves more addresses than any such limit allows";
  Circumstances little;
  little.memory = rlim_t{320} << 20U;
  const Arguments long_run{
      "run",  "--out",   "-", "--system", "harmonic-oscillator", "--integrator", "rk4", "--step",
      "1e-6", "--every", "1", "--time"};
  little.standard_output = "/dev/null";
  EXPECT_EQ(run_pfaff(long_run + Arguments{"2"}, little).status, 0);
}

TEST(CommandLine, StatesAreWrittenOnce) {
  const TemporaryDirectory files;
  const auto refused = [&](const std::string& content, const Arguments& fragments) {
    write(files / "state.json", content);
    expect_refused(pendulum_with({"--state", files / "state.json"}), Arguments{"state.json"} + fragments);
  };
  refused(R"({"t": 0, "t": 1, "z": [1, 0]})", {"'t'", "twice"});
  refused(R"({"z": [1, 0], "z": [1, 1]})", {"'z'", "twice"});
  refused(R"({"q": [1, 0], "p": []})", {"as many numbers in q as in p", "2 and 0"});
}

TEST(CommandLine, NestingHasALimit) {
  const TemporaryDirectory files;
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  write(files / "state.json", "{\"z\": " + deep + "}");
  expect_refused(pendulum_with({"--state", files / "state.json"}),
                 {"state.json", "lists inside one another"});
  write(files / "model.json", "{\"dimension\": " + deep + "}");
  expect_refused({"evaluate", "--system", "bead-rod", "--set", "model=" + (files / "model.json")},
                 {"model.json", "at most 64 lists"});
  write(files / "config.toml", "schema = " + deep + "\n");
  expect_refused({"run", "--out", "-", "--config", files / "config.toml"}, {"config.toml:1"});
}

TEST(CommandLine, ConfigurationsSayWhereTheyAreWrong) {
  const TemporaryDirectory files;
  const std::string good =
      "schema = 1\nsystem = \"damped-pendulum\"\nintegrator = \"rk4\"\ntime = \"1\"\nstep = \"0.1\"\n";
  const auto refused = [&](const std::string& content, const Arguments& fragments) {
    write(files / "config.toml", content);
    expect_refused({"run", "--out", "-", "--config", files / "config.toml"}, fragments);
  };
  refused(good + "precision = \"qud\"\n", {"config.toml, line 6", "'precision'", "did you mean 'quad'?"});
  refused(good + "allow_inconsistent = \"perhaps\"\n", {"line 6", "'allow_inconsistent'", "'perhaps'"});
  refused(good + "initial = []\n", {"config.toml", "'initial'", "empty list"});
  refused(good + "initial = [1]\n", {"expected 2 numbers, got 1"});
  refused(good + "initial = [1, 0]\n[set]\ninitial = \"1,0\"\n", {"'initial'", "twice"});
  refused(good + "[set]\nnu = 0.1\n\"system.nu\" = 0.2\n", {"'nu'", "twice"});
}

}  // namespace
