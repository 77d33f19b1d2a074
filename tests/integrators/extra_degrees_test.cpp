// The degrees beyond m that generating functions keep where they are not told: which they are, and that they
// cost less at equal error.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/system.hpp>

#include "methods.hpp"

namespace pfaff::testing {
namespace {

using States = std::vector<double>;

// Bits of one system that depends on time, and of one that does not.
States ends(const Assignments& parameters) {
  States all;
  for (const auto& [name, start] : {std::pair<const char*, States>{"damped-pendulum", {1, 0.5}},
                                    std::pair<const char*, States>{"lotka-volterra", {3, 1}}})
    for (const double x : after_steps<double>(*method_named("generating-function", parameters),
                                              systems().get(name, "system").make({}), 0.3, 5, start))
      all.push_back(x);
  return all;
}

Assignments with(Assignments parameters, const std::string& extra) {
  parameters.emplace_back("extra", extra);
  return parameters;
}

TEST(ExtraDegrees, OfTheSymmetricVariantAreThoseThatCostLeast) {
  const std::map<int, std::string> kept{{6, "2"}, {8, "4"}, {10, "2"}};
  for (int m = 2; m <= 16; m += 2) {
    const auto found = kept.find(m);
    const std::string extra = found == kept.end() ? "0" : found->second;
    for (const char* variant : {"auto", "S"}) {
      const Assignments scheme{{"order", std::to_string(m)}, {"variant", variant}};
      const States by_default = ends(scheme);
      EXPECT_EQ(by_default, ends(with(scheme, "auto"))) << m;
      for (const char* other : {"0", "2", "4"})
        EXPECT_EQ(by_default == ends(with(scheme, other)), other == extra) << m << " with " << other;
    }
  }
}

// Odd orders, the variant of su-qin and the forms that mix old and new coordinates are truncated at m, and so
// of order m and no more.
TEST(ExtraDegrees, OfOtherSchemesAreNone) {
  for (const Assignments& scheme :
       {Assignments{{"order", "5"}}, Assignments{{"order", "7"}},
        Assignments{{"order", "6"}, {"variant", "P"}}, Assignments{{"order", "8"}, {"variant", "P"}},
        Assignments{{"order", "8"}, {"form", "qhat-p"}}, Assignments{{"order", "6"}, {"form", "q-phat"}},
        Assignments{{"order", "8"}, {"form", "normal"}, {"normal", "0.2,0.1,-0.3,-0.2"}}}) {
    const States by_default = ends(scheme);
    EXPECT_EQ(by_default, ends(with(scheme, "0")));
    EXPECT_NE(by_default, ends(with(scheme, "2")));
  }
}

// The error of a run over 20 units of time, relative to the state at its end, and the right-hand sides that
// it takes.
struct Cost {
  double error, fields;
};
Cost cost_of(const Assignments& parameters, int steps) {
  const auto model = systems().get("lotka-volterra", "system").make({});
  const States start{3, 1};
  const States exact =
      after_steps<double>(*method_named("gauss-darboux", {{"stages", "8"}}), model, 20.0 / 400, 400, start);
  const auto method = method_named("generating-function", parameters);
  Integration<double> run(start_with(*method, model, start, 20.0 / steps, 0.0));
  run.steps(steps).expect_reached();
  const std::span<const double> z = run.state();
  return {std::hypot(z[0] - exact[0], z[1] - exact[1]) / std::hypot(exact[0], exact[1]),
          static_cast<double>(run.counters().fields)};
}

// The numbers of steps bring both to nearly the same error, the smaller of the two with the degrees beyond m.
TEST(ExtraDegrees, CostFewerRightHandSidesAtEqualError) {
  struct Pair {
    const char* order;
    int steps, steps_without;
  };
  for (const Pair& pair : {Pair{"6", 137, 239}, Pair{"8", 90, 181}, Pair{"10", 119, 157}}) {
    const Cost with_them = cost_of({{"order", pair.order}}, pair.steps);
    const Cost without = cost_of({{"order", pair.order}, {"extra", "0"}}, pair.steps_without);
    EXPECT_LT(with_them.error, without.error) << pair.order;
    EXPECT_LT(with_them.fields, without.fields) << pair.order;
  }
}

}  // namespace
}  // namespace pfaff::testing
