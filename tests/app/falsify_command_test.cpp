// pfaff falsify: what it prints, its exit status, and what it refuses.
#include <set>

#include "command.hpp"

namespace {
using namespace pfaff::testing;

nlohmann::json falsified(const std::vector<std::string>& arguments, int status) {
  std::vector<std::string> all{"falsify", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run_pfaff(all);
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j["ok"], status == 0);
  return j;
}

TEST(Falsify, ClaimOfAMethodThatDoesNotMakeIt) {
  const auto j = falsified({"rk4", "--claim", "symplectic"}, 1);
  ASSERT_EQ(j["results"].size(), 1U);
  const auto& result = j["results"][0];
  EXPECT_EQ(result["method"], "rk4");
  EXPECT_EQ(result["claim"], "symplectic");
  EXPECT_EQ(result["claimed"], false);
  EXPECT_EQ(result["result"], "falsified");
  const auto& found = result["counterexample"];
  EXPECT_EQ(found["system"], "rk4-not-symplectic");
  EXPECT_EQ(found["dimension"], 2);
  EXPECT_GT(found["residuals"][0].get<double>(), 1e-10);
  EXPECT_NE(found["model"].get<std::string>().find("\nname = \"rk4-not-symplectic\"\n"), std::string::npos);
  EXPECT_NE(found["command"].get<std::string>().find("--system rk4-not-symplectic.toml"), std::string::npos);
  // The same seed gives the same system.
  EXPECT_EQ(falsified({"rk4", "--claim", "symplectic", "--seed", "1"}, 1), j);
}

TEST(Falsify, ClaimsThatHold) {
  const auto j = falsified({"verlet", "--systems", "20"}, 0);
  std::set<std::string> claims;
  for (const auto& result : j["results"]) {
    EXPECT_EQ(result["result"], "held") << result;
    EXPECT_GT(result["tried"], 0);
    claims.insert(result["claim"].get<std::string>());
  }
  EXPECT_EQ(claims, (std::set<std::string>{"symplectic", "symmetric", "reversible"}));
}

TEST(Falsify, NoClaims) {
  const auto j = falsified({"rk4"}, 0);  // nothing is false where nothing is said
  EXPECT_TRUE(j["results"].empty());
  EXPECT_NE(run_pfaff({"falsify", "rk4"}).out.find("nothing is claimed that could be falsified"),
            std::string::npos);
}

// A method is to blame for nothing where the motion begins off its constraints, or the system is not what it
// states.
TEST(Falsify, SystemsThatAreThemselvesWrongAreRefused) {
  const TemporaryDirectory files;
  const auto refused = [&](const std::string& text, const char* method, const char* claim, const char* said) {
    write(files / "model.toml", text);
    expect_complaint(run_pfaff({"falsify", method, "--claim", claim, "--system", files / "model.toml"}), 2,
                     {said}, said);
  };
  const std::string sphere =
      "coordinates = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\"]\n"
      "hamiltonian = \"(px^2 + py^2 + pz^2)/2 + z\"\n"
      "holonomic = { sphere = \"x^2 + y^2 + z^2 - 1\" }\n";
  refused(sphere + "initial = [\"3/5\", 0, \"-4/5\", 1, 1, 0]\n", "rk4", "constraints",
          "sphere~ is off by 1.2");
  write(files / "model.toml", sphere + "initial = [\"3/5\", 0, \"-4/5\", 0, 1, 0]\n");
  EXPECT_EQ(run_pfaff({"falsify", "rk4", "--claim", "constraints", "--system", files / "model.toml"}).status,
            1);
  const std::string form =
      "coordinates = [\"a\", \"b\"]\ninitial = [0.3, 0.2]\nstructure = [[\"0\", \"1 + t\"], "
      "[\"-1 - t\", \"0\"]]\ncovector = [\"a\", \"b\"]\n";
  refused(form, "midpoint-darboux", "K-symplectic", "is itself not what it states: self-adjoint: rate of K");
  refused("coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nhamiltonian = \"p^2/2 + q^4/4\"\n", "verlet",
          "energy", "verlet needs separable");
}

// Where no step can be taken nothing was measured.
TEST(Falsify, WhatCannotBeJudgedIsNotOk) {
  const Outcome outcome =
      run_pfaff({"falsify", "gauss", "--claim", "symplectic", "--system", "henon-heiles", "--step", "1e9"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("NOT OK: not judged: the step did not converge"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find("in double"), std::string::npos) << outcome.out;
}

TEST(Falsify, Text) {
  const Outcome outcome = run_pfaff({"falsify", "verlet", "--systems", "5"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("held"), std::string::npos);
  EXPECT_NE(outcome.out.find("seed 1: 0 falsified"), std::string::npos) << outcome.out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(Falsify, OneSystem) {
  EXPECT_GT(falsified({"rk4", "--claim", "symplectic", "--system", "pendulum"}, 1)["exponent"], 4);
  EXPECT_EQ(falsified({"verlet", "--claim", "symplectic", "--system", "pendulum"}, 0)["reason"],
            "the residual is that of rounding");
  // About rounding itself: the plain update rounds more than what a step adds.
  const std::vector<std::string> rounding{"gauss", "--claim", "unbiased-round-off", "--system",
                                          "harmonic-oscillator"};
  EXPECT_EQ(falsified(rounding, 0)["reason"], "the rounding is a random walk");
  std::vector<std::string> plain = rounding;
  plain.insert(plain.end(), {"--set", "compensated=no"});
  EXPECT_GT(falsified(plain, 1)["residuals"][0], 1.3);
}

TEST(Falsify, WritesOverNothing) {
  const TemporaryDirectory files;
  const auto search = [&](const std::string& budget) {
    return run_pfaff({"falsify", "rk4", "--claim", "symplectic", "--systems", "200", "--budget", budget,
                      "--out", files.path().string()});
  };
  const std::string file = files / "rk4-not-symplectic.toml";
  write(file, "mine");
  expect_complaint(search("1000000"), 2, {"--out", "rk4-not-symplectic.toml", "exists already"}, "a file");
  EXPECT_EQ(text_of(file), "mine");
  fs::rename(file, files / "victim");
  fs::create_symlink(files / "victim", file);
  expect_complaint(search("1000000"), 2, {"--out", "exists already"}, "a link");
  EXPECT_EQ(text_of(files / "victim"), "mine");
  fs::remove(file);
  EXPECT_EQ(search("60").status, 1);
  EXPECT_NE(text_of(file).find("coordinates"), std::string::npos);
}

TEST(Falsify, Refusals) {
  const auto refused = [](std::vector<std::string> arguments, const std::string& said) {
    arguments.insert(arguments.begin(), "falsify");
    const Outcome outcome = run_pfaff(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused({}, "expected the name of an integrator or --all");
  refused({"rk4", "--all"}, "expected the name of an integrator or --all");
  refused({"rk5"}, "did you mean 'rk4'?");
  refused({"rk4", "--claim", "simplectic"}, "did you mean 'symplectic'?");
  refused({"gauss", "--set", "stags=2"}, "stags");
  refused({"--all", "--set", "stages=2"}, "--set: with --all");
  refused({"rk4", "--budget", "0"}, "--budget");
  refused({"rk4", "--systems", "0"}, "--systems");
  refused({"rk4", "--seed", "x"}, "--seed");
  refused({"rk4", "--claim", "energy", "--out", "nowhere/at/all"}, "--out");
  refused({"rk4", "--system", "pendulum"}, "--claim");
  refused({"rk4", "--claim", "casimirs", "--system", "pendulum"}, "is not in the scope of casimirs");
  refused({"rk4", "--claim", "energy", "--system", "pendulm"}, "did you mean 'pendulum'?");
  refused({"rk4", "--claim", "energy", "--system", "pendulum", "--step", "0"}, "--step: expected");
  refused({"rk4", "--claim", "energy", "--system", "pendulum", "--step", "h"}, "--step: expected");
}

}  // namespace
