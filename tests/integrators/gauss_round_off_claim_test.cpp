// Which motions registered Gauss claims an unbiased round-off of.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

#include "../formula_values.hpp"

namespace pfaff {
namespace {

// p' is nothing but the force, q' is not linear in p: the steps are of first order.
struct RelativisticOscillator {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return sqrt(1 + p[0] * p[0]);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};

bool claimed(const Model& model, const Assignments& parameters) {
  const std::vector<Claim> claims = integrators().get("gauss", "").make(parameters)->preserves(model);
  return std::find(claims.begin(), claims.end(), Claim::unbiased_round_off) != claims.end();
}

TEST(GaussRoundOffClaim, IsOfStepsOfSecondOrder) {
  static const System<RelativisticOscillator> relativistic{
      {.name = "relativistic-oscillator", .title = "", .reference = "", .initial = {1, 0}}};
  EXPECT_TRUE(claimed(*testing::model_named("pendulum"), {{"stages", "6"}}));
  EXPECT_TRUE(claimed(*testing::model_named("kepler"), {{"stages", "6"}}));
  EXPECT_FALSE(claimed(*testing::model_named("pendulum"), {{"stages", "5"}}));
  EXPECT_FALSE(claimed(*testing::model_named("pendulum"), {{"stages", "6"}, {"compensated", "no"}}));
  EXPECT_FALSE(claimed(*relativistic.make({}), {{"stages", "6"}}));
  EXPECT_FALSE(claimed(*testing::model_named("free-rigid-body"), {{"stages", "6"}}));
}

}  // namespace
}  // namespace pfaff
