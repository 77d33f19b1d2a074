// States that are none: refused before work where it begins, and said in the exit status where they are
// shown.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

// The field is finite at all of these states, and the energy is beyond the range of doubles.
TEST(InitialState, AnInvariantThatOverflowsIsRefused) {
  const TemporaryDirectory files;
  write(files / "quartic.toml",
        "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"q^4/4\"\ninitial = [1, 0]\n"
        "invariants = { total = \"p^2/2 + q^4/4\" }\n");
  write(files / "named.toml",
        "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"q^2/2\"\ninitial = [1, 0]\n"
        "invariants = { big = { of = \"exp(1000*q)\", behaviour = \"free\" } }\n");
  const auto run = [](const std::string& system, const std::string& initial, const std::string& out) {
    return Arguments{"run",    "--system", system,  "--integrator",       "rk4",   "--step", "0.1",
                     "--time", "0.1",      "--set", "initial=" + initial, "--out", out};
  };
  expect_refused(run(files / "quartic.toml", "1,1e200", "run"),
                 {"initial state of quartic", "the invariant total is not finite"});
  expect_refused(run(files / "quartic.toml", "1e90,0", "run"), {"the invariant total is not finite there"});
  expect_refused(run(files / "named.toml", "1,0", "run"), {"the invariant big is not finite there"});
  expect_refused(run("pendulum", "0,1e160", "run"), {"initial state of pendulum", "is not finite there"});
  // Controls: what is finite is run; quad has a wider range, in which the state is one to begin with.
  EXPECT_EQ(run_pfaff(run(files / "quartic.toml", "1,1", files / "a")).status, 0);
  const Outcome in_quad =
      run_pfaff(run(files / "named.toml", "1,0", files / "b") + Arguments{"--precision", "quad"});
  EXPECT_NE(in_quad.status, 2) << in_quad.err;
  EXPECT_TRUE(fs::exists(files / "b/series.csv"));
}

TEST(Evaluate, ASingularStateIsAFailure) {
  const TemporaryDirectory files;
  write(files / "root.toml", "coordinates = [\"x\"]\nfield = [\"sqrt(x)\"]\ninitial = [1]\n");
  for (const auto& [system, initial, said] :
       {std::tuple{std::string("kepler"), "0,0,1,0", "the state of kepler"},
        std::tuple{std::string("lotka-volterra"), "-1,2", "the state of lotka-volterra"},
        std::tuple{files / "root.toml", "-1", "the state of root"}})
    for (const bool json : {false, true}) {
      Arguments command{"evaluate", system, "--set", std::string("initial=") + initial};
      if (json) command.emplace_back("--json");
      const Outcome outcome = run_pfaff(command);
      EXPECT_EQ(outcome.status, 1) << joined(command);
      EXPECT_FALSE(outcome.out.empty()) << "what is known is shown";
      EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find('\n') + 1, outcome.err.size()) << outcome.err;
    }
  EXPECT_EQ(run_pfaff({"evaluate", files / "root.toml"}).status, 0);
}

}  // namespace
