// Parameters are read from text and checked against their range; a bad value is refused in one line that says
// what was expected.
#include <gtest/gtest.h>

#include <pfaff/core/registry/parameter.hpp>

namespace {
using namespace pfaff;

struct Settings {
  Real nu = 0.3_r;
  int stages = 2;
  std::string form = "midpoint";
  bool compensated = true;
  static std::vector<Parameter> parameters() {
    return {parameter(&Settings::nu, "nu", "1/s", 0, 10, "damping rate"),
            parameter(&Settings::stages, "stages", "", 1, 32, "number of stages"),
            parameter(&Settings::form, "form", {"midpoint", "qhat-p"}, "kind of generating function"),
            parameter(&Settings::compensated, "compensated", "compensated summation")};
  }
};

void assign(Settings& sample, const Assignments& assignments) {
  assign_all(Settings::parameters(), &sample, assignments, "system sample");
}

// The message that refuses the assignment; empty when it is accepted, in which case the test fails.
std::string refusal(const std::string& key, const std::string& text) {
  Settings sample;
  try {
    assign(sample, {{key, text}});
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line: " << error.what();
    // Nothing was changed.
    EXPECT_TRUE(sample.nu == 0.3_r);
    EXPECT_EQ(sample.stages, 2);
    EXPECT_EQ(sample.form, "midpoint");
    EXPECT_TRUE(sample.compensated);
    return error.what();
  }
  ADD_FAILURE() << key << "=" << text << " was accepted";
  return {};
}

TEST(Parameter, TakesTextExactly) {
  Settings sample;
  assign(sample, {{"nu", "0.1"}, {"stages", "32"}, {"form", "qhat-p"}, {"compensated", "no"}});
  EXPECT_TRUE(sample.nu.is_fraction());
  EXPECT_TRUE(sample.nu == Real::fraction(1, 10));
  EXPECT_EQ(sample.stages, 32);
  EXPECT_EQ(sample.form, "qhat-p");
  EXPECT_FALSE(sample.compensated);
  // Ends of the range are inside; fractions are numbers; the last of several settings counts.
  assign(sample, {{"nu", "0"}, {"nu", "10"}, {"nu", "1/3"}, {"stages", "1"}});
  EXPECT_TRUE(sample.nu == Real::fraction(1, 3));
  EXPECT_EQ(sample.stages, 1);
}

// A default is a value like any other, unless another one takes its place.
TEST(Parameter, RefusesDefaultsOutsideTheirOwnRange) {
  const auto refused = [](const auto& change, const Assignments& assignments) -> std::string {
    Settings sample;
    change(sample);
    try {
      assign(sample, assignments);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  const auto fast = [](Settings& s) { s.nu = 11_r; };
  EXPECT_EQ(refused(fast, {}),
            "parameter 'nu' of system sample: expected a number in 0 .. 10 1/s, got its default value '11' "
            "(damping rate)");
  EXPECT_EQ(refused(fast, {{"nu", "10"}}), "");
  EXPECT_NE(refused([](Settings& s) { s.stages = 0; }, {}), "");
  EXPECT_NE(refused([](Settings& s) { s.form = "trapezoid"; }, {{"nu", "1"}}), "");
  EXPECT_EQ(refused([](Settings& s) { s.nu = 10_r; }, {}), "");
}

TEST(Parameter, RefusesWhatIsOutOfRange) {
  EXPECT_EQ(refusal("nu", "11"),
            "parameter 'nu' of system sample: expected a number in 0 .. 10 1/s, got '11' (damping rate)");
  EXPECT_EQ(
      refusal("nu", "-1e-300"),
      "parameter 'nu' of system sample: expected a number in 0 .. 10 1/s, got '-1e-300' (damping rate)");
  EXPECT_EQ(
      refusal("stages", "0"),
      "parameter 'stages' of system sample: expected an integer in 1 .. 32, got '0' (number of stages)");
  EXPECT_EQ(
      refusal("stages", "33"),
      "parameter 'stages' of system sample: expected an integer in 1 .. 32, got '33' (number of stages)");
  EXPECT_EQ(refusal("form", "midpint"),
            "parameter 'form' of system sample: expected midpoint|qhat-p, got 'midpint'");
}

TEST(Parameter, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "abc", "1e", "0x1", "nan", "inf", " 1", "1 ", "1/0", "1,5"})
    EXPECT_NE(refusal("nu", text).find("expected a number"), std::string::npos);
  for (const char* text : {"", "2.5", "1e1", "2 ", " 2", "+2", "two", "99999999999999999999"})
    EXPECT_NE(refusal("stages", text).find("expected an integer"), std::string::npos);
  for (const char* text : {"", "true", "1", "Yes"})
    EXPECT_NE(refusal("compensated", text).find("expected yes|no"), std::string::npos);
}

TEST(Parameter, UnknownNamesGetTheNearest) {
  EXPECT_EQ(refusal("stagse", "2"), "unknown parameter 'stagse'; did you mean 'stages'? (of system sample)");
  EXPECT_EQ(
      refusal("temperature", "2"),
      "unknown parameter 'temperature'; expected one of: nu, stages, form, compensated (of system sample)");
}

TEST(Parameter, ResolvedGivesWhatAssignTakes) {
  Settings sample;
  assign(sample, {{"nu", "2/7"}, {"compensated", "no"}});
  const Assignments values = resolved(Settings::parameters(), &sample);
  EXPECT_EQ(values,
            (Assignments{{"nu", "2/7"}, {"stages", "2"}, {"form", "midpoint"}, {"compensated", "no"}}));
  Settings copy;
  assign(copy, values);
  EXPECT_EQ(resolved(Settings::parameters(), &copy), values);
  EXPECT_TRUE(copy.nu == Real::fraction(2, 7));
  // A plug-in without parameters has none.
  struct Plain {};
  EXPECT_TRUE(parameters_of<Plain>().empty());
}

TEST(Parameter, RangesAreWrittenShort) {
  const auto p = Settings::parameters();
  EXPECT_EQ(range_of(p[0]), "0 .. 10 1/s");
  EXPECT_EQ(range_of(p[1]), "1 .. 32");
  EXPECT_EQ(range_of(p[2]), "midpoint|qhat-p");
  EXPECT_EQ(range_of(p[3]), "yes|no");
}

}  // namespace
