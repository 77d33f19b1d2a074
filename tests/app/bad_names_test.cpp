// Names that do not exist are refused: with one line that offers the nearest one, exit status 2, and nothing
// written.
#include <regex>

#include "command.hpp"

namespace {

using namespace pfaff::testing;

const std::vector<std::string> pendulum_run{
    "run",    "--out", "-",      "--system", "damped-pendulum", "--integrator", "rk4",
    "--step", "0.1",   "--time", "1"};

TEST(BadNames, Commands) {
  expect_refused(
      {}, {"a command is missing", "list", "describe", "cite", "run", "compare", "reproduce", "verify"});
  expect_refused({"lst"}, {"unknown command 'lst'", "did you mean 'list'?"});
  expect_refused({"verfy", "rk4"}, {"unknown command 'verfy'", "did you mean 'verify'?"});
  expect_refused({"xyzzy"}, {"unknown command 'xyzzy'", "expected one of", "compare"});
  expect_refused({"--json", "list"}, {"expected a command before '--json'", "see pfaff --help"});
}

TEST(BadNames, OfAnotherKindAndInOtherLetters) {
  const auto run = [](const char* system, const char* integrator) {
    return Arguments{"run", system, integrator, "--step", "0.1", "--time", "0.1", "--out", "-"};
  };
  expect_refused(run("gauss", "kepler"), {"'gauss' is an integrator; expected a system"});
  expect_refused(run("kepler", "pendulum"), {"'pendulum' is a system; expected an integrator"});
  EXPECT_EQ(run_pfaff(run("Kepler", "VERLET")).out, run_pfaff(run("kepler", "verlet")).out);
  for (const auto& [as_typed, as_named] :
       {std::pair<Arguments, Arguments>{{"describe", "Dirac"}, {"describe", "dirac"}},
        {{"cite", "Verlet"}, {"cite", "verlet"}},
        {{"verify", "Lie-Poisson", "--quiet"}, {"verify", "lie-poisson", "--quiet"}},
        {{"falsify", "RK4", "--claim", "symplectic", "--system", "Pendulum", "--quiet"},
         {"falsify", "rk4", "--claim", "symplectic", "--system", "pendulum", "--quiet"}},
        {{"derive", "N-Pendulum", "--method", "ldl", "--emit", "sympy"},
         {"derive", "n-pendulum", "--method", "ldl", "--emit", "sympy"}}}) {
    const Outcome typed = run_pfaff(as_typed), named = run_pfaff(as_named);
    EXPECT_EQ(typed.status, named.status) << joined(as_typed) << typed.err;
    EXPECT_EQ(typed.err, "") << joined(as_typed);
    EXPECT_EQ(typed.out, named.out) << joined(as_typed);
  }
  expect_refused({"falsify", "pendulum"}, {"'pendulum' is a system; expected an integrator"});
  expect_refused({"derive", "gauss", "--method", "ldl"}, {"'gauss' is an integrator; expected a system"});
  // What is not near is not meant; what a name ends in may be.
  expect_refused(run("kepler", "stormer-verlet"), {"such as verlet, "});
  expect_refused({"run", "--scheme", "verlet"}, {"unknown option '--scheme'; expected one of"});
}

TEST(BadNames, ARefusalSaysWhatToDo) {
  const auto run = [](const char* system, const char* integrator, const char* how) {
    return Arguments{"run", system, integrator, how, "0.1", "--time", "0.1", "--out", "-"};
  };
  expect_refused(run("n-pendulum", "verlet", "--step"),
                 {"verlet needs separable", "methods that fit: ", "rattle"});
  expect_refused(run("kepler", "gauss", "--tolerance"), {"or one of extrapolation, ", "taylor"});
  expect_refused(run("n-pendulum-angles", "verlet", "--step"),
                 {"verlet needs separable", "energies that are written apart make a system separable",
                  "methods that fit: ", "gauss"});
  expect_refused({"run", "kepler", "verlet", "--step", "0.1", "--time", "0", "--out", "-"},
                 {"--time: expected a duration other than 0, got '0'"});
  // What lies outside of a range is told what the parameter is, and what else there is.
  const auto with = [&](const char* system, const char* setting) {
    return run(system, "gauss", "--step") + Arguments{"--set", setting};
  };
  expect_refused(with("kepler", "eccentricity=1.2"),
                 {"expected a number in 0 .. 0.95, got '1.2'", "any other start is set by initial="});
  expect_refused(with("sphere-particle", "mass=0"),
                 {"expected a number in 0.001 .. 1000 kg, got '0' (mass of the particle)"});
  expect_refused({"falsify", "rk4", "--budget", "-1"}, {"--budget: expected a number > 0, got '-1'"});
  expect_refused({"falsify", "rk4", "--out", "nowhere"},
                 {"--out: expected a directory that exists, got 'nowhere'"});
}

// The options in the first column of the page on what Pfaff does not do yet.
std::vector<std::string> options_of_the_page() {
  std::vector<std::string> options;
  std::istringstream lines(text_of(PFAFF_GOLDEN "/../../docs/not-yet.md"));
  const std::regex option("`(--[a-z]+)`");
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| **")) continue;
    const std::string wanted = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator k(wanted.begin(), wanted.end(), option), end; k != end; ++k)
      options.push_back((*k)[1]);
  }
  return options;
}

TEST(BadNames, Options) {
  expect_refused({"list", "--jsn"}, {"unknown option '--jsn'", "did you mean '--json'?", "pfaff list"});
  expect_refused(pendulum_run + std::vector<std::string>{"--presision", "quad"},
                 {"unknown option '--presision'", "did you mean '--precision'?"});
  expect_refused(pendulum_run + std::vector<std::string>{"--presision=quad"},
                 {"did you mean '--precision'?"});
  // Said before anything that is missing because of it.
  const std::vector<std::string> options = options_of_the_page();
  EXPECT_GE(options.size(), 8U);
  for (const std::string& option : options)
    expect_refused({"run", "kepler", "verlet", option, "x"},
                   {option + ": Pfaff does not do this yet; docs/not-yet.md says what to do instead"});
  // The page names this one too, beside what to do.
  expect_refused({"falsify", "rk4", "--compile"}, {"unknown option '--compile'"});
  expect_refused({"run", "--sytem", "kepler"}, {"unknown option '--sytem'", "did you mean '--system'?"});
  expect_refused({"run", "--ot", "-"}, {"unknown option '--ot'", "did you mean '--out'?"});
  expect_refused({"compare", "kepler", "--quik"}, {"did you mean '--quick'?"});
  expect_refused({"compare", "kepler", "--timing", "0"}, {"--timing"});
  expect_refused(pendulum_run + std::vector<std::string>{"more"}, {"more", "not expected"});
  expect_refused(pendulum_run + std::vector<std::string>{"--precision"}, {"--precision"});
  expect_refused(pendulum_run + std::vector<std::string>{"--step", "0.2"}, {"--step"});
}

TEST(BadNames, SystemsAndMethods) {
  expect_refused({"run", "--out", "-", "--system", "damped-pendulm", "--integrator", "rk4", "--time", "1",
                  "--step", "0.1"},
                 {"unknown system 'damped-pendulm'", "did you mean 'damped-pendulum'?"});
  expect_refused({"run", "--out", "-", "--system", "damped-pendulum", "--integrator", "rk5", "--time", "1",
                  "--step", "0.1"},
                 {"unknown integrator 'rk5'", "did you mean 'rk4'?"});
  expect_refused(pendulum_run + std::vector<std::string>{"--precision", "qad"},
                 {"unknown precision 'qad'", "did you mean 'quad'?"});
}

TEST(BadNames, Parameters) {
  const auto with = [](const std::string& setting) {
    return pendulum_run + std::vector<std::string>{"--set", setting};
  };
  expect_refused(with("mu=0.3"), {"unknown parameter 'mu'", "did you mean 'nu'?", "damped-pendulum", "rk4"});
  expect_refused(with("system.mu=0.3"), {"unknown parameter 'mu'", "did you mean 'nu'?", "damped-pendulum"});
  expect_refused(with("integrator.compensate=no"), {"did you mean 'compensated'?", "rk4"});
  expect_refused(with("sytem.nu=0.3"), {"unknown parameter 'sytem.nu'", "did you mean 'system.nu'?"});
  expect_refused(with("intial=1,2"), {"unknown parameter 'intial'", "did you mean 'initial'?"});
  expect_refused(with("order=4"), {"unknown parameter 'order'", "nu"});
}

TEST(BadNames, EverythingElse) {
  expect_refused({"list", "sytems"}, {"unknown kind 'sytems'", "did you mean 'systems'?"});
  expect_refused({"describe", "verlot"}, {"unknown name 'verlot'", "did you mean 'verlet'?"});
  expect_refused({"describe"}, {"missing: name (see pfaff describe --help)"});
  expect_refused({"derive"}, {"missing: system, --method (see pfaff derive --help)"});
  expect_refused({"derive", "kepler"}, {"missing: --method (see pfaff derive --help)"});
  expect_refused({"tune"}, {"missing: system, --step (see pfaff tune --help)"});
  expect_refused({"cite", "su-qn"}, {"unknown name 'su-qn'", "did you mean 'su-qin'?"});
  expect_refused({"cite", "verlet", "keplr"}, {"unknown name 'keplr'", "did you mean 'kepler'?"});
  expect_refused({"compare", "damped-oscilator"},
                 {"unknown experiment 'damped-oscilator'", "did you mean 'damped-oscillator'?"});
  expect_refused({"compare"}, {"expected the name of an experiment, or --all"});
  expect_refused({"compare", "kepler", "--all"}, {"expected the name of an experiment, or --all"});
  expect_refused({"compare", "missing.toml"}, {"cannot read missing.toml"});
  expect_refused({"reproduce", "su-qn"}, {"unknown paper 'su-qn'", "did you mean 'su-qin'?"});
  expect_refused({"reproduce", "su-qin", "--section", "7"}, {"unknown section '7'", "5"});
  expect_refused({"verify", "rk5"}, {"unknown name 'rk5'", "did you mean 'rk4'?"});
  expect_refused({"verify", "rk4", "contrls"}, {"unknown name 'contrls'", "did you mean 'controls'?"});
  expect_refused({"list", "--plugin", "missing.so"}, {"missing.so"});
}

TEST(BadNames, AMethodThatDoesNotFitNamesBothSides) {
  expect_refused(
      {"run", "--out", "-", "--system", "damped-pendulum", "--integrator", "verlet", "--time", "1", "--step",
       "0.1"},
      {"verlet needs separable; damped-pendulum offers vector-field, conformal, structure, birkhoffian"});
  expect_refused({"run", "--out", "run", "--system", "free-rigid-body", "--integrator", "generating-function",
                  "--time", "1", "--step", "0.1"},
                 {"generating-function needs darboux-chart; free-rigid-body offers vector-field"});
}

}  // namespace
