// What is said of measures whose controls do not hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <pfaff/runs/measure.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {
namespace {
using ::testing::HasSubstr;

// A registered measure with other controls.
class WithControls final : public MeasurePlugin {
 public:
  WithControls(const char* measure, std::vector<MeasureControl> controls)
      : MeasurePlugin(measures().get(measure, "measure").descriptor(),
                      measures().get(measure, "measure").parameters(), typeid(WithControls),
                      std::source_location::current()),
        controls_(std::move(controls)) {}
  [[nodiscard]] std::unique_ptr<MeasureInstance> make(const Assignments& set) const override {
    return measures().get(name(), "measure").make(set);
  }
  [[nodiscard]] std::vector<MeasureControl> controls() const override { return controls_; }

 private:
  std::vector<MeasureControl> controls_;
};

// RK4 has four right-hand sides a step, leap-frog one.
MeasureControl of(const char* method, const char* system = "harmonic-oscillator") {
  return MeasureControl::of(system, method, "0.1", 10);
}
MeasureControl of_rk4(double expected) { return of("rk4").gives("rhs_per_step", expected, 0.5); }
MeasureControl beside(double expected) { return of("rk4", "kepler").gives("rhs_per_step", expected, 0.5); }
MeasureControl fault(double expected) {
  return of("leap-frog", "kepler").does_not_give("rhs_per_step", expected, 0.5);
}
// What is said of the controls together, or empty.
std::string said_of(std::vector<MeasureControl> controls) {
  const Check stated = check_measure(WithControls("cost", std::move(controls))).back();
  EXPECT_EQ(good(stated), stated.reason.empty());
  return stated.reason;
}

TEST(MeasureControls, HoldWhereTheNumbersAreRight) {
  const auto checks = check_measure(WithControls("cost", {of_rk4(4), beside(4.25), fault(4)}));
  EXPECT_EQ(checks.size(), 6U);  // answers in quad too
  for (const Check& check : checks) EXPECT_TRUE(good(check)) << check.reason;
}

TEST(MeasureControls, SayWhichNumberWasFound) {
  const auto checks = check_measure(WithControls("cost", {of_rk4(3), beside(5), fault(1.25)}));
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_EQ(checks[0].result, CheckResult::fail);
  EXPECT_EQ(checks[0].measured, 1);
  EXPECT_EQ(checks[0].reason, "rhs_per_step by rk4, 10 steps of 0.1: it gives 4, expected 3");
  EXPECT_EQ(checks[2].result, CheckResult::fail);
  EXPECT_THAT(checks[2].reason, HasSubstr(" as if the method kept it"));
  EXPECT_TRUE(good(checks[3]));
}

TEST(MeasureControls, SayWhyTheyCouldNotBeRun) {
  MeasureControl misnamed = of_rk4(4), unknown = of_rk4(4);
  misnamed.column = "rhs";
  unknown.system = "harmonic-oscilator";
  const auto checks = check_measure(WithControls("cost", {misnamed, unknown}));
  ASSERT_EQ(checks.size(), 3U);
  for (const Check& check : checks) {
    EXPECT_EQ(check.result, CheckResult::fail);
    EXPECT_TRUE(std::isnan(check.measured));
  }
  EXPECT_THAT(checks[0].reason,
              HasSubstr("rhs by rk4, 10 steps of 0.1: its table has no column of numbers 'rhs'"));
  EXPECT_THAT(checks[1].reason, HasSubstr("did you mean 'harmonic-oscillator'?"));
  EXPECT_THAT(checks[2].reason, HasSubstr("states 2 different answers and 0 faults"));
}

// An answer that every number is, or that is stated twice, and a fault that no number could be tell nothing.
TEST(MeasureControls, HaveToSaySomething) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(),
                   all = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said_of({of_rk4(4), beside(4), fault(4)}), "");
  EXPECT_THAT(said_of({of_rk4(4), of_rk4(4), fault(4)}), HasSubstr("states 1 different answers"));
  EXPECT_THAT(said_of({of_rk4(4), beside(4).gives("rhs_per_step", 4, 1e300), fault(4)}),
              HasSubstr("expected runs of which the measure says different things"));
  // A measure that says 4 of everything, and a fault that is far from that.
  EXPECT_THAT(said_of({of_rk4(4), beside(4), of("rk4").does_not_give("rhs_per_step", 1e9, 0.5)}),
              HasSubstr("expected runs of which the measure says different things"));
  MeasureControl no_steps = of_rk4(4);
  no_steps.steps = 0;
  for (const MeasureControl& control : {fault(none), fault(4).does_not_give("rhs_per_step", 4, -1),
                                        of_rk4(4).gives("rhs_per_step", 4, all), of_rk4(none), no_steps}) {
    const Check check = check_measure(WithControls("cost", {control})).front();
    EXPECT_FALSE(good(check));
    EXPECT_THAT(check.reason, HasSubstr("states no number with an error that is allowed"));
  }
}

// From (0, 1) the oscillator is at (sin t, cos t); five stretches have eight digits.
TEST(MeasureControls, BeginAtTheStateThatIsNamed) {
  MeasureControl control = MeasureControl::of("harmonic-oscillator", "implicit-midpoint", "0.1", 500)
                               .gives("exact_x", std::sin(50.0), 5e-8);
  control.initial = {"0", "1"};
  EXPECT_TRUE(good(check_measure(WithControls("motion", {control})).front()));
  control.initial.clear();
  EXPECT_FALSE(good(check_measure(WithControls("motion", {control})).front()));
}

}  // namespace
}  // namespace pfaff
