// pfaff derive: what it prints, its exit status, and what it refuses.
#include "command.hpp"

namespace {
using namespace pfaff::testing;

TEST(Derive, CountsAsJson) {
  const Outcome outcome =
      run_pfaff({"derive", "chain-molecule", "--method", "ldl", "--emit", "counts", "--set", "beads=13",
                 "--set", "epsilon=0", "--set", "charge=0", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const auto j = json_of(outcome.out);
  EXPECT_EQ(j.size(), 7U);
  EXPECT_EQ(j["schema"], 1);
  EXPECT_EQ(j["system"], "chain-molecule");
  EXPECT_EQ(j["method"], "ldl");
  EXPECT_EQ(j["equations"], 78);
  EXPECT_LE(j["operations"].get<int>(), 135 * 12);
  EXPECT_GT(j["nodes"].get<int>(), j["operations"].get<int>());
  EXPECT_GT(j["seconds"].get<double>(), 0);
}

TEST(Derive, CountsAsText) {
  const Outcome outcome = run_pfaff({"derive", "n-pendulum", "--method", "minors", "--set", "bobs=2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("operations"), std::string::npos);
  EXPECT_NE(outcome.out.find("m0"), std::string::npos) << outcome.out;
}

TEST(Derive, ParametersAreSymbolsAndGeneratingFunctionsHaveAnOrder) {
  const Outcome outcome = run_pfaff({"derive", "damped-oscillator", "--method", "generating-function",
                                     "--set", "order=2", "--emit", "sympy"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* said : {"parameters = (\"nu\",)", "\"phi1\", \"phi2\")"})
    EXPECT_NE(outcome.out.find(said), std::string::npos) << outcome.out;
}

TEST(Derive, RefusesWhatDoesNotFit) {
  const auto refused = [](const std::vector<std::string>& arguments, const std::string& why) {
    const Outcome outcome = run_pfaff(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  refused({"derive", "humanoid", "--method", "minor"}, "did you mean 'minors'?");
  refused({"derive", "humanoid", "--method", "minors"}, "methods that fit: ldl");
  refused({"derive", "humanoid", "--method", "ldl", "--emit", "count"}, "'counts'");
  refused({"derive", "humanoid", "--method", "ldl", "--set", "friction-form=stoke"},
          "did you mean 'stokes'?");
  refused({"derive", "humanoid", "--method", "ldl", "--set", "initial=1"}, "do not depend on a state");
  refused({"derive", "kepler", "--method", "generating-function", "--set", "order=0"},
          "order: expected a whole number in 1 .. 12");
  refused({"derive", "n-pendulum", "--method", "recursion", "--set", "bobs=2", "--set",
           "elimination=rod0,rod1,rod0~,rod1~"},
          "an order that works: rod0,rod0~,rod1,rod1~");
  refused({"derive", "humanid", "--method", "ldl"}, "did you mean 'humanoid'?");
}

// A small experiment of the kind `derivation`: what it leaves, that it resumes, and a finding that is false.
TEST(Derive, IsComparedByAnExperiment) {
  const TemporaryDirectory files;
  write(files / "growth.toml", R"(schema = 1
kind = "derivation"
title = "A test"
reference = ["nguyen-turski"]
system = "n-pendulum"
parameter = "bobs"
fit_from = 1
[[derive]]
method = "ldl"
sizes = [1, 2, 3, 4]
exponent_below = 0.5
[[derive]]
method = "minors"
sizes = [2]
)");
  const std::vector<std::string> command{"compare", files / "growth.toml", "--json", "--out", files / "out"};
  const Outcome outcome = run_pfaff(command);
  EXPECT_EQ(outcome.status, 1) << "operations grow like K";
  EXPECT_NE(outcome.err.find("operations of ldl grow like K^"), std::string::npos) << outcome.err;
  const auto j = json_of(outcome.out)["experiments"][0];
  EXPECT_EQ(j["runs"], 5);
  EXPECT_EQ(j["resumed"], 0);
  EXPECT_EQ(j["findings"][0]["holds"], false);
  for (const char* name : {"experiment.json", "cost.csv", "fits.csv", "report.html",
                           "runs/ldl-4/summary.json", "figures/growth_operations.svg"})
    EXPECT_TRUE(fs::exists(files.path() / "out" / name)) << name;
  const std::string results = text_of(files / "out/results.csv");
  EXPECT_EQ(results.substr(0, results.find('\n')),
            "method,size,constraints,equations,operations,nodes,tree_operations");
  const auto counts = json_of(run_pfaff({"derive", "n-pendulum", "--method", "ldl", "--set", "bobs=4",
                                         "--set", "friction-form=none", "--json"})
                                  .out);
  EXPECT_NE(results.find("ldl,4,4,16," + counts["operations"].dump() + "," + counts["nodes"].dump() + ","),
            std::string::npos)
      << results << counts;
  const auto again = json_of(run_pfaff(command + std::vector<std::string>{"--no-report"}).out);
  EXPECT_EQ(again["experiments"][0]["resumed"], 5);
  EXPECT_FALSE(again["experiments"][0].contains("report"));
  EXPECT_EQ(text_of(files / "out/results.csv"), results);
}

}  // namespace
