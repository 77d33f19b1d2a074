// Faults of plug-ins that load (tests/app/plugins/faulty.cpp): the program ends with one line that names the
// plug-in and what is wrong with it, never by a signal.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

const std::string faulty = test_plugin("faulty"), throws_late = test_plugin("throws-late");

Arguments faulty_run(const std::string& system, const std::string& integrator, const Arguments& more = {}) {
  return Arguments{"run",          "--plugin", faulty,   "--out", "-",      "--system", system,
                   "--integrator", integrator, "--step", "0.125", "--time", "1"} +
         more;
}

TEST(PluginFaults, AnElementPastTheEndOfAnArgument) {
  expect_refused(faulty_run("reads-past", "rk4"),
                 {"system reads-past", "kinetic(t, p)", "element [1] of an argument with 1 element"});
  expect_refused(faulty_run("reads-far-away", "rk4"),
                 {"system reads-far-away", "field(t, z, rate)", "[18446744073709551615]", "with 2 elements"});
  expect_refused(faulty_run("writes-far-away", "rk4"),
                 {"system writes-far-away", "field(t, z, rate)", "element [100000000]"});
  // What stands behind the argument here is a number of the same tape.
  expect_refused(
      faulty_run("reads-its-neighbour", "rk4"),
      {"system reads-its-neighbour", "exact_solution(elapsed, t0, z0, z)", "element [2]", "2 elements"});
}

// What a run that printed rows has besides them.
Outcome behind_rows(Outcome outcome) {
  EXPECT_TRUE(outcome.out.starts_with("t [s],q [m],p [") && outcome.out.ends_with("\n")) << outcome.out;
  outcome.out.clear();
  return outcome;
}

TEST(PluginFaults, WhatAFormulaThrows) {
  expect_refused(faulty_run("throws-while-recorded", "rk4"),
                 {"system throws-while-recorded", "field(t, z, rate)", "exception of type", "Odd"});
  expect_refused({"describe", "--plugin", faulty, "throws-while-recorded"}, {"throws-while-recorded", "Odd"});
  const Outcome verified =
      run_pfaff({"verify", "--plugin", faulty, "throws-while-recorded", "canonical", "lie-poisson"});
  EXPECT_EQ(verified.status, 1) << verified.err;
  EXPECT_EQ(verified.err, "");
  EXPECT_NE(verified.out.find("NOT OK: 1 of "), std::string::npos) << verified.out;
  expect_complaint(
      behind_rows(run_pfaff(faulty_run("throws-when-compiled", "rk4"))), 1,
      {"integrator rk4", "system throws-when-compiled", "after t = 0.25", "no formula after a quarter"},
      "a compiled formula");
}

TEST(PluginFaults, WhatAStepThrows) {
  const auto run = [](const Arguments& more) {
    return run_pfaff(Arguments{"run", "--plugin", throws_late, "--out", "-", "--system",
                               "harmonic-oscillator", "--integrator", "throws-late", "--step", "0.125"} +
                     more);
  };
  expect_complaint(behind_rows(run({"--time", "1"})), 1,
                   {"integrator throws-late", "system harmonic-oscillator", "after t = 0.5", "Odd"},
                   "a step");
  expect_complaint(behind_rows(run({"--time", "1", "--precision", "quad"})), 1,
                   {"integrator throws-late", "after t = 0.5"}, "a step in quad");
  // What one method throws is told of it, and another one is judged.
  const Outcome verified = run_pfaff(
      {"verify", "--plugin", throws_late, "throws-late", "throws-of-models", "symplectic-euler", "--json"});
  EXPECT_EQ(verified.status, 1);
  EXPECT_EQ(verified.err, "");
  const auto found = nlohmann::json::parse(verified.out);
  int thrown = 0, judged = 0, of_models = 0;
  for (const auto& check : found["checks"]) {
    of_models += check["plugin"] == "throws-of-models" && check["result"] == "fail" &&
                         check["reason"] == "integrator throws-of-models: no word of any model"
                     ? 1
                     : 0;
    const bool of_it = check["plugin"].get<std::string>().starts_with("throws-");
    thrown += of_it && check["reason"].get<std::string>().find("Odd") != std::string::npos ? 1 : 0;
    judged += !of_it && check["result"] == "pass" ? 1 : 0;
  }
  EXPECT_GT(thrown, 0);
  EXPECT_GT(judged, 0);
  EXPECT_EQ(of_models, 1);
  expect_refused({"run", "--plugin", throws_late, "kepler", "throws-of-models", "--step", "0.1", "--time",
                  "1", "--out", "-"},
                 {"integrator throws-of-models", "no word of any model"});
  // The control: up to there the same method runs.
  const Outcome outcome = run({"--time", "0.375"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// An escape sequence in a title would be obeyed by the terminal that shows it.
TEST(PluginFaults, ControlCharactersAreShownNotObeyed) {
  for (const Arguments& command :
       {Arguments{"list", "systems"}, Arguments{"list", "--markdown"}, Arguments{"describe", "coloured"}}) {
    const Outcome outcome = run_pfaff(command + Arguments{"--plugin", faulty});
    SCOPED_TRACE(joined(command));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\uFFFD[31mred\uFFFD[0m, \uFFFD\uFFFD2J and \uFFFD more"), std::string::npos);
    for (const char c : outcome.out)
      EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != '\x7F'));
    EXPECT_EQ(outcome.out.find("\xC2\x9B"), std::string::npos);
  }
  const Outcome json = run_pfaff({"list", "systems", "--json", "--plugin", faulty});
  EXPECT_EQ(json.status, 0) << json.err;
  EXPECT_NE(json.out.find("2J and \uFFFD more"), std::string::npos);
  (void)json_of(json.out);
  expect_refused({"run", "--out", "-", "--system", "\033]0;title\007"}, {"missing: --integrator"});
  const Outcome named = run_pfaff({"describe", "\033]0;title\007"});
  EXPECT_EQ(named.err.find('\033'), std::string::npos) << named.err;
  EXPECT_NE(named.err.find("'\uFFFD]0;title\uFFFD'"), std::string::npos) << named.err;
}

TEST(PluginFaults, AReferenceWithoutAKey) {
  expect_refused({"cite", "--plugin", faulty, "uncited"}, {"system uncited", "'nobody (1)'", "no key"});
  EXPECT_EQ(run_pfaff({"cite", "--plugin", faulty, "coloured"}).status, 0);
}

TEST(PluginFaults, AnInitialStateOfTheWrongLength) {
  expect_refused(faulty_run("too-long", "rk4"),
                 {"system too-long", "initial state of 3 numbers", "expected 2"});
  EXPECT_EQ(run_pfaff(faulty_run("too-long", "rk4", {"--set", "initial=1,0"})).status, 0);
}

}  // namespace
