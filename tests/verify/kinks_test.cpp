// Fields with kinks, behind which the equations of an implicit step have several solutions and errors have
// other orders: methods are judged by their steps beside them.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

#include "judged.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::bad;
using pfaff::testing::Names;

struct DryFriction {  // an oscillator on a rough table, on which it comes to rest off its equilibrium
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0] - select(z[1], T(1), T(-1)) / T(5);
  }
};
struct Valley {  // H = p^2/2 + |q|
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -select(z[0], T(1), T(-1));
  }
};

template <class S>
std::shared_ptr<const Model> from(Real q, Real p) {
  return make_model({.name = "kinked", .title = "", .reference = "", .initial = {std::move(q), std::move(p)}},
                    S{});
}

Names blamed(const std::string& method, const std::shared_ptr<const Model>& on) {
  return bad(check_method(*integrators().get(method, "integrator").make({}), {}, "kinked", on));
}

TEST(Kinks, SoundMethodsAreNotBlamedForThem) {
  for (const auto& model :
       {from<DryFriction>(1, 0), from<DryFriction>(0.5_r, 0.3_r), from<DryFriction>(0.5_r, -0.01_r),
        from<DryFriction>(-1, 0.02_r), from<DryFriction>(0.02_r, 0.5_r)}) {
    EXPECT_EQ(blamed("gauss", model), Names());
    EXPECT_EQ(blamed("implicit-midpoint", model), Names());
  }
  // The kink comes after .0014, which all but the shortest steps lead over.
  EXPECT_EQ(blamed("extrapolation", from<Valley>(0.001_r, -0.7_r)), Names());
}

// From here the motion meets a jump after -.003, and none forwards.
TEST(Kinks, AnOrderIsJudgedForwardsWhereTheyLieBehind) {
  const auto method = integrators().get("extrapolation", "integrator").make({});
  const auto checks = check_method(*method, {}, "kinked", from<DryFriction>(-0.5_r, 0.001_r));
  const auto order =
      std::find_if(checks.begin(), checks.end(), [](const Check& c) { return c.claim == "order"; });
  ASSERT_NE(order, checks.end());
  EXPECT_EQ(order->result, CheckResult::pass) << order->reason;
}

// The classical method, which says that it is symmetric, and that it is of order 5.
struct Boasting : pfaff::testing::Classical<false> {};

TEST(Kinks, FalseClaimsAreFoundBesideThem) {
  static const Method<Boasting> boasting{
      {.name = "boasting", .title = "", .reference = "", .order = 5, .preserves = {Claim::symmetric}}};
  for (const auto& model : {from<DryFriction>(0.5_r, 0.3_r), from<DryFriction>(0.5_r, -0.01_r)}) {
    const Names names = bad(check_method(*boasting.make({}), {}, "kinked", model));
    for (const char* claim : {"order", "symmetric", "symmetric along a run"})
      EXPECT_NE(std::find(names.begin(), names.end(), claim), names.end()) << claim;
  }
}

}  // namespace
