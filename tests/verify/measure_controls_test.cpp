// What is said of measures whose controls do not hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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

// RK4 has four right-hand sides a step.
MeasureControl of_rk4(double expected, bool fault = false) {
  const MeasureControl run = MeasureControl::of("harmonic-oscillator", "rk4", "0.1", 10);
  return fault ? run.does_not_give("rhs_per_step", expected, 0.5) : run.gives("rhs_per_step", expected, 0.5);
}

TEST(MeasureControls, HoldWhereTheNumbersAreRight) {
  for (const Check& check : check_measure(WithControls("cost", {of_rk4(4), of_rk4(4.25), of_rk4(2, true)})))
    EXPECT_TRUE(good(check)) << check.reason;
}

TEST(MeasureControls, SayWhichNumberWasFound) {
  const auto checks = check_measure(WithControls("cost", {of_rk4(3), of_rk4(4), of_rk4(4, true)}));
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_EQ(checks[0].result, CheckResult::fail);
  EXPECT_EQ(checks[0].measured, 1);
  EXPECT_EQ(checks[0].reason, "rhs_per_step by rk4, 10 steps of 0.1: it gives 4, expected 3");
  EXPECT_TRUE(good(checks[1]));
  EXPECT_EQ(checks[2].result, CheckResult::fail);
  EXPECT_THAT(checks[2].reason, HasSubstr("it gives 4 as if the method kept it"));
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
  EXPECT_THAT(checks[2].reason, HasSubstr("states 2 answers and 0 faults"));
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
