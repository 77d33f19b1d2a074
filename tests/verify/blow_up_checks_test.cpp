// Methods on motions that end, in finite time or in a singular point: what the motion does not allow to judge
// is not judged, what it does is, and no method is to blame.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <pfaff/runs/motion.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check_budget.hpp>

#include "../temporary_directory.hpp"
#include "judged.hpp"

namespace pfaff {
namespace {
using testing::bad;
using testing::TemporaryDirectory;

struct EndingMotion {
  std::string name, text, judged_without;  // a claim that some method cannot be judged by on it
};
const std::vector<EndingMotion>& motions_that_end() {
  static const std::vector<EndingMotion> list{
      {"saddle",
       "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2 + p^3/6\"\n"
       "potential = \"q^2/2 + q^3/5 - cos(q)/4\"\n",
       "order"},
      {"square", "coordinates = [\"x\"]\ninitial = [1]\nfield = [\"x^2\"]\n", "tolerance"},
      {"quartic",
       "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2\"\npotential = \"-q^4\"\n",
       "tolerance"},
      {"collision",
       "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2\"\npotential = \"-1/q\"\n",
       "order"},
      // Lane and Emden's equation of index 5 in s = t + 1/10: backwards it meets the centre, s = 0.
      {"lane-emden",
       "coordinates = [\"y\", \"v\"]\ninitial = [1, 0]\nfield = [\"v\", \"-2*v/(t + 1/10) - y^5\"]\n",
       "tolerance, backwards"}};
  return list;
}

// Methods of one step and with history, with fixed and with chosen steps, and one that claims the rounding of
// long runs.
struct Named {
  std::string name;
  Assignments set;
};
const std::vector<Named>& methods() {
  static const std::vector<Named> list{{"rk4", {}},
                                       {"gauss", {{"stages", "6"}}},
                                       {"leap-frog", {}},
                                       {"extrapolation", {}},
                                       {"odeint-dopri5", {}}};
  return list;
}

TEST(BlowUpChecks, NoMethodIsToBlameForTheEndOfAMotion) {
  const TemporaryDirectory files;
  for (const EndingMotion& motion : motions_that_end()) {
    const std::string file = files / (motion.name + ".toml");
    std::ofstream(file) << motion.text;
    const auto model = system_named(file).make({});
    bool ended = false;
    for (const Named& named : methods()) {
      SCOPED_TRACE(named.name + " on " + motion.name);
      const auto method = integrators().get(named.name, "integrator").make(named.set);
      if (!method->refuses(*model).empty()) continue;
      const std::vector<Check> checks = check_method(*method, named.set, motion.name, model);
      EXPECT_EQ(bad(checks), testing::Names{});
      for (const Check& check : checks) {
        if (!unjudged(check) || check.reason.find("the solution was found up to t = ") == std::string::npos)
          continue;
        ended = ended || check.claim == motion.judged_without;
      }
      EXPECT_GT(std::count_if(checks.begin(), checks.end(),
                              [](const Check& check) { return check.result == CheckResult::pass; }),
                1);
    }
    EXPECT_TRUE(ended) << motion.name;
  }
}

// Negative control: a method that is wrong is found out on them, too.
TEST(BlowUpChecks, AWrongMethodFailsOnThemToo) {
  const TemporaryDirectory files;
  for (const EndingMotion& motion : motions_that_end()) {
    const std::string file = files / (motion.name + ".toml");
    std::ofstream(file) << motion.text;
    const auto model = system_named(file).make({});
    const auto wrong =
        integrators().get("rk4", "integrator").make({})->with_changed_coefficient(0, Quad(1e-3));
    EXPECT_NE(bad(check_method(*wrong, {}, motion.name, model)), testing::Names{}) << motion.name;
  }
}

}  // namespace
}  // namespace pfaff
