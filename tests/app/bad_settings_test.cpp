// Settings of a run that make no sense are refused: with one line that says what was expected, exit status 2,
// and nothing written.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

Arguments refused_run(const std::string& system, const std::string& integrator, const Arguments& more) {
  return Arguments{"run", "--out", "run", "--system", system, "--integrator", integrator} + more;
}
Arguments refused_pendulum(const Arguments& more) { return refused_run("damped-pendulum", "rk4", more); }
Arguments set(const std::string& setting) {
  return refused_pendulum({"--step", "0.1", "--time", "1", "--set", setting});
}

TEST(BadSettings, Parameters) {
  expect_refused(set("nu=abc"), {"'nu'", "damped-pendulum", "0 .. 10 1/s", "'abc'"});
  expect_refused(set("nu="), {"'nu'", "0 .. 10 1/s", "''"});
  expect_refused(set("nu=11"), {"'nu'", "0 .. 10 1/s", "'11'"});
  expect_refused(set("nu=-0.1"), {"'nu'", "0 .. 10 1/s", "'-0.1'"});
  expect_refused(set("nu=nan"), {"'nu'", "'nan'"});
  expect_refused(set("nu=inf"), {"'nu'", "'inf'"});
  expect_refused(set("nu"), {"--set", "KEY=VALUE", "'nu'"});
  expect_refused(set("=0.3"), {"--set", "KEY=VALUE", "'=0.3'"});
  const auto generating = [](const std::string& a, const std::string& b) {
    return refused_run("damped-pendulum", "generating-function",
                       {"--step", "0.1", "--time", "1", "--set", a, "--set", b});
  };
  expect_refused(generating("order=3.5", "variant=P"), {"'order'", "an integer in 1 .. 40", "'3.5'"});
  expect_refused(generating("order=0", "variant=P"), {"'order'", "1 .. 40", "'0'"});
  expect_refused(generating("order=99999999999999999999", "variant=P"), {"'order'", "1 .. 40"});
  expect_refused(generating("order=2", "variant=Q"), {"'variant'", "P|S", "'Q'"});
  expect_refused(generating("order=3", "variant=S"), {"variant S", "even order", "order 3"});
}

TEST(BadSettings, FormsOfGeneratingFunctions) {
  const auto refused = [](const Arguments& settings, const Arguments& fragments) {
    Arguments arguments{"--step", "0.1", "--time", "1"};
    for (const std::string& setting : settings) arguments = arguments + Arguments{"--set", setting};
    expect_refused(refused_run("damped-pendulum", "generating-function", arguments), fragments);
  };
  refused({"form=normal"}, {"form normal", "matrix", "normal=0.3,0.2,-0.4,-0.3"});
  refused({"normal=1,0,0,-1"}, {"form midpoint", "expected form normal"});
  refused({"form=normal", "normal=1,0,0"}, {"3 entries", "damped-pendulum takes 4"});
  refused({"form=normal", "normal=1,0,0,1"}, {"not in sp(2)", "J V + V^T J is 2", "expected 0"});
  refused({"form=normal", "normal=1,x,0,1"}, {"'normal'", "numbers separated by commas", "'1,x,0,1'"});
  refused({"form=normal", "normal=1,,0,1"}, {"'normal'", "numbers separated by commas"});
  refused({"form=normal", "normal=1000,0,0,-1000"}, {"'normal'", "-100 .. 100"});
  refused({"form=symmetric"}, {"'form'", "midpoint|qhat-p|q-phat|normal"});
  refused({"extra=3"}, {"'extra'", "auto|0|2|4|6|8", "'3'"});
  refused({"variant=S", "form=qhat-p"}, {"variant S", "form midpoint"});
}

// A step beyond what can be solved ends the run; what would have worked is said.
TEST(BadSettings, AStepTooLargeNamesOneThatWorks) {
  const TemporaryDirectory files;
  const Outcome outcome =
      run_pfaff({"run", "--system", "damped-pendulum", "--integrator", "generating-function", "--set",
                 "order=8", "--set", "extra=0", "--step", "8", "--time", "16", "--out", files / "run"});
  EXPECT_EQ(outcome.status, 1);
  for (const char* said : {"at t = 0", "from there a step of 3.6", "completed samples are kept"})
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
}

TEST(BadSettings, InitialState) {
  expect_refused(set("initial=1"), {"initial state of damped-pendulum", "expected 2 numbers, got 1"});
  expect_refused(set("initial=1,2,3"), {"expected 2 numbers, got 3"});
  expect_refused(set("initial=1,2,"), {"expected 2 numbers, got 3"});
  expect_refused(set("initial="), {"initial state of damped-pendulum", "expected 2 numbers"});
  expect_refused(set("initial=nan,1"), {"initial r of damped-pendulum", "finite", "'nan'"});
  expect_refused(set("initial=1,inf"), {"initial p of damped-pendulum", "finite", "'inf'"});
  expect_refused(set("initial=1,-1e999"), {"initial p", "finite", "'-1e999'"});
  expect_refused(set("initial=1,two"), {"initial p", "'two'"});
  expect_refused(set("initial=1,0x10"), {"initial p", "'0x10'"});
  expect_refused(set("initial=1/0,1"), {"initial r", "'1/0'"});
  expect_refused(set("initial=1;2"), {"expected 2 numbers, got 1"});
}

TEST(BadSettings, AStateWhereTheFieldIsNotFinite) {
  expect_refused(
      refused_run("kepler", "verlet", {"--step", "0.1", "--time", "1", "--set", "initial=0,0,1,0"}),
      {"initial state of kepler", "not finite"});
}

TEST(BadSettings, StateFile) {
  const TemporaryDirectory files;
  const auto refused = [&](const std::string& content, const Arguments& fragments) {
    write(files / "state.json", content);
    expect_refused(refused_pendulum({"--step", "0.1", "--time", "1", "--state", files / "state.json"}),
                   Arguments{"state.json"} + fragments);
  };
  refused(R"({"t": 0, "z": [1, 0], "zz": 1})", {"unknown key 'zz'", "did you mean 'z'?"});
  refused(R"({"t": 0})", {"expected z, q and p, or q and v"});
  refused(R"({"q": [1]})", {"expected z, q and p, or q and v"});
  refused(R"({"z": [1, 0], "q": [1], "p": [0]})", {"expected z, q and p, or q and v"});
  refused(R"({"z": 1})", {"expected a list of numbers"});
  refused(R"({"z": []})", {"expected numbers, got an empty list"});
  refused(R"({"z": [1, null]})", {"expected numbers or decimal strings"});
  refused(R"({"t": [0], "z": [1, 0]})", {"expected numbers or decimal strings"});
  refused("[1, 0]", {"expected a JSON object"});
  const auto with_state = refused_pendulum({"--step", "0.1", "--time", "1", "--state", files / "state.json"});
  write(files / "state.json", R"({"z": [1, 0, 2]})");
  expect_refused(with_state, {"expected 2 numbers, got 3"});
  write(files / "state.json", R"({"z": ["1", "nan"]})");
  expect_refused(with_state, {"initial p", "'nan'"});
  write(files / "state.json", R"({"t": "x", "z": [1, 0]})");
  expect_refused(with_state, {"initial time", "'x'"});
  write(files / "state.json", R"({"z": [1, 0]})");
  expect_refused(with_state + Arguments{"--set", "initial=1,0"}, {"--state", "--set initial", "exclude"});
  expect_refused(refused_pendulum({"--step", "0.1", "--time", "1", "--state", files / "missing.json"}),
                 {"cannot read", "missing.json"});
  expect_refused(refused_pendulum({"--step", "0.1", "--time", "1", "--state", files.path().string()}),
                 {"cannot read"});
}

TEST(BadSettings, Step) {
  expect_refused(refused_pendulum({"--time", "1"}), {"missing: --step, or --tolerance"});
  for (const std::string bad : {"0", "-0.1", "0/1"})
    expect_refused(refused_pendulum({"--time", "1", "--step", bad}),
                   {"--step: expected a number > 0", "'" + bad + "'"});
  for (const std::string bad : {"nan", "inf", "1e999", "h", "0.1s", "1/2/3"})
    expect_refused(refused_pendulum({"--time", "1", "--step", bad}),
                   {"--step: expected a finite", "'" + bad + "'"});
  expect_refused(refused_pendulum({"--time", "1", "--step", "2"}),
                 {"--step: expected at most the duration 1", "'2'"});
  expect_refused(refused_pendulum({"--time", "1", "--step", "1e-30"}),
                 {"--step: 1e-30 is too small", "--max-steps"});
  expect_refused(refused_pendulum({"--time", "1e5", "--step", "1e-6"}),
                 {"--step: 1e-6 is too little beside the time 100000", "t + h is off"});
}

TEST(BadSettings, Time) {
  expect_refused(refused_pendulum({"--step", "0.1"}), {"missing: --time, the duration of the run"});
  expect_refused(refused_pendulum({"--step", "0.1", "--time", "0"}),
                 {"--time: expected a duration other than 0", "'0'"});
  expect_refused(refused_pendulum({"--step", "-0.1", "--time", "1"}),
                 {"--step: expected a number > 0 beside the duration 1", "'-0.1'", "--time < 0"});
  for (const std::string bad : {"nan", "inf", "ten"})
    expect_refused(refused_pendulum({"--step", "0.1", "--time", bad}),
                   {"--time: expected a finite", "'" + bad + "'"});
}

TEST(BadSettings, Tolerance) {
  expect_refused(refused_pendulum({"--time", "1", "--tolerance", "1e-6"}),
                 {"rk4 takes fixed steps only", "--step"});
  const auto dopri = [](const Arguments& more) {
    return refused_run("damped-pendulum", "odeint-dopri5", Arguments{"--time", "1"} + more);
  };
  expect_refused(dopri({"--tolerance", "1e-6", "--step", "0.1"}),
                 {"--step and --tolerance exclude each other"});
  for (const std::string bad : {"0", "-1e-6", "2"})
    expect_refused(dopri({"--tolerance", bad}),
                   {"--tolerance: expected a number in (0, 1]", "'" + bad + "'"});
  expect_refused(dopri({"--tolerance", "small"}), {"--tolerance: expected a finite", "'small'"});
  expect_refused(dopri({"--tolerance", "1e-6", "--absolute", "1,2,3"}), {"--absolute: expected one number"});
  expect_refused(dopri({"--tolerance", "1e-6", "--set", "initial=0,0"}), {"at rest in zero", "--absolute"});
}

TEST(BadSettings, QuadNeedsCoefficientsInQuad) {
  for (const std::string method : {"odeint-dopri5", "odeint-rk4"})
    expect_refused(
        refused_run("damped-pendulum", method, {"--time", "1", "--step", "0.1", "--precision", "quad"}),
        {method, "double only", "--precision double"});
}

TEST(BadSettings, Every) {
  for (const std::string bad : {"0", "-1", "1.5", "x", "1000000000000000000000"})
    expect_refused(refused_pendulum({"--time", "1", "--step", "0.1", "--every", bad}),
                   {"--every: expected a whole number of steps > 0", "'" + bad + "'"});
}

TEST(BadSettings, WhatIsMissing) {
  const std::string every =
      "missing: --system (see pfaff list systems); --integrator (see pfaff list integrators); "
      "--step, or --tolerance; --time, the duration of the run; --out, ";
  expect_refused({"run"}, {every});
  expect_refused({"run", "--out", ""}, {every});
  expect_refused({"run", "kepler", "verlet", "--config", "run/config.toml"}, {"missing: --out, "});
  expect_refused({"run", "--out", "run", "--system", "kepler"},
                 {"missing: --integrator (see pfaff list integrators); --step"});
}

TEST(BadSettings, ConfigFile) {
  const TemporaryDirectory files;
  const std::string good =
      "schema = 1\nsystem = \"damped-pendulum\"\nintegrator = \"rk4\"\ntime = \"1\"\nstep = \"0.1\"\n";
  const auto refused = [&](const std::string& content, const Arguments& fragments,
                           const Arguments& more = {}) {
    write(files / "config.toml", content);
    expect_refused(Arguments{"run", "--out", "run", "--config", files / "config.toml"} + more, fragments);
  };
  refused(good + "stpe = 1\n", {"config.toml", "unknown key 'stpe'", "did you mean 'step'?"});
  refused(good + "every = 0\n", {"config.toml", "'every'", "whole number of steps > 0", "'0'"});
  refused(good + "initial = 1\n", {"config.toml", "'initial'", "expected a list"});
  refused(good + "set = 1\n", {"config.toml", "'set'", "expected a table"});
  refused(good + "[set]\nmu = 1\n", {"unknown parameter 'mu'", "did you mean 'nu'?"});
  refused("schema = 2\n", {"'schema'", "expected 1, got 2"});
  refused("schema = 1\n", {"'system' is missing"});
  refused(good + "t0 = \n", {"config.toml:6"});
  for (const Arguments& beside :
       {Arguments{"--step", "0.2"}, Arguments{"--precision", "quad"}, Arguments{"--every", "2"},
        Arguments{"--set", "nu=1"}, Arguments{"--state", "s.json"}, Arguments{"--system", "kepler"}})
    refused(good, {"--config holds the whole run"}, beside);
}

}  // namespace
