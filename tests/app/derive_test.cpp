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
  refused({"derive", "humanid", "--method", "ldl"}, "did you mean 'humanoid'?");
}

}  // namespace
