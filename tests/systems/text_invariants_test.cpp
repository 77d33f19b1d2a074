// Invariants, parts and constraints that make no sense, under names that are too long for the memory of a
// string itself, which holds 15 characters: GCC 12 freed them twice where what follows a name throws.
#include <gtest/gtest.h>

#include "written_models.hpp"

namespace {
using namespace pfaff;

// The message for a spring with one more line.
std::string told_of(const std::string& line) {
  return pfaff::testing::refusal_written(
      "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"q^2/2\"\n" + line + "\n");
}
void expect_told(const std::string& line, const std::string& expected) {
  EXPECT_EQ(told_of(line).find(expected), 0U)
      << line << "\ngave: " << told_of(line) << "\nnot:  " << expected;
}

TEST(TextInvariants, TheRightOnesAreAccepted) {
  EXPECT_EQ(told_of(R"(invariants = { angular-momentum-of-it = "q^2 + p^2" })"), "accepted");
  EXPECT_EQ(
      told_of(
          R"(invariants = { angular-momentum-of-it = { of = "q^2 + p^2", unit = "kg m^2/s per second" } })"),
      "accepted");
}

TEST(TextInvariants, AWrongExpression) {
  expect_told(R"(invariants = { angular-momentum = "q+" })", "model.toml:4:38: ");
  expect_told(R"(invariants = { angular-momentum-of-the-whole = "q*(p" })", "model.toml:4:");
  expect_told(
      R"(invariants = { angular-momentum-of-the-whole = { of = "q p", unit = "kg m^2/s per second" } })",
      "model.toml:4:");
  expect_told(R"(invariants = { short = "q+" })", "model.toml:4:27: ");
}

TEST(TextInvariants, AMissingExpressionOrAWrongType) {
  const std::string what = "invariant 'angular-momentum-of-the-whole'";
  expect_told(R"(invariants = { angular-momentum-of-the-whole = { unit = "kg m^2/s per second" } })",
              "model.toml:4:48: " + what + ": the key 'of' is missing");
  for (const char* value :
       {"true", "[\"q\"]", "{ of = true, unit = \"kg m^2/s per second\" }", "{ of = [\"q\"] }"})
    expect_told(std::string("invariants = { angular-momentum-of-the-whole = ") + value + " }",
                "model.toml:4:");
  for (const char* more :
       {"unit = 1", "unit = \"a, unit, of, a, list\"", "quadratic = \"yes\"", "behaviour = 3",
        "behaviour = \"conserved-for-ever-and-ever\"", "colour = \"red\""})
    expect_told(
        std::string("invariants = { angular-momentum-of-the-whole = { of = \"q^2 + p^2\", ") + more + " } }",
        "model.toml:4:");
}

// The neighbours: other lists in which a name stands before what may be wrong.
TEST(TextInvariants, OtherNamesBeforeWhatIsWrong) {
  expect_told(R"(parts = [{ name = "the-whole-of-the-motion", change = ["h*p +", 0] }])", "model.toml:4:");
  expect_told(R"(parts = [{ name = "the-whole-of-the-motion", change = true }])", "model.toml:4:");
  expect_told(R"(holonomic = { length-of-the-whole-rod = "q +" })", "model.toml:4:");
  expect_told(R"(velocity_constraints = [{ name = "blade-of-the-whole-sleigh", row = ["q +"] }])",
              "model.toml:4:");
  expect_told(R"(parameters = { stiffness-of-the-whole-spring = { value = "1 +" } })", "model.toml:4:");
  expect_told(R"(let = { stiffness_of_the_whole_spring = "1 +" })", "model.toml:4:");
}

}  // namespace
