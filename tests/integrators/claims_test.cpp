// Every method makes claims and has controls. The claims themselves are measured by `pfaff verify`.
#include <gtest/gtest.h>

#include <pfaff/core/bracket.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {
namespace {

TEST(Claims, EveryMethodHasAnOrderAndAStructureClaimOrNone) {
  for (const MethodPlugin* plugin : integrators().all()) {
    const auto method = plugin->make({});
    bool tried = false;
    for (const SystemPlugin* system : systems().all()) {
      const auto model = motion_for(*method, system->make({}));
      if (!method->refuses(*model).empty()) continue;
      tried = true;
      EXPECT_GT(method->order(*model), 0) << plugin->name();
      EXPECT_FALSE(method->preserves(*model).empty()) << plugin->name();
    }
    EXPECT_TRUE(tried) << plugin->name() << " fits no system";
  }
}

TEST(Claims, EveryMethodOfOursHasAChangedCoefficientControl) {
  for (const MethodPlugin* plugin : integrators().all()) {
    if (plugin->descriptor().double_coefficients) continue;
    if (plugin->name() == "taylor") continue;  // no numbers define it: its coefficients are the solution's
    EXPECT_GT(plugin->make({})->coefficient_count(), 0U) << plugin->name();
  }
}

TEST(Claims, MeasuredOrdersOnTheDampedPendulumInQuad) {
  const auto model = systems().get("damped-pendulum", "").make({{"nu", "0.3"}});
  for (int order = 1; order <= 10; ++order) {
    const auto method = integrators()
                            .get("generating-function", "")
                            .make({{"order", std::to_string(order)}, {"variant", "P"}, {"extra", "0"}});
    EXPECT_NEAR(measure_order(*method, model).slope, order, 0.1);
  }
}

}  // namespace
}  // namespace pfaff
