// The test of a bracket: what it claims, by Google Mock's matchers. Copy to tests/brackets/<name>_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pfaff/brackets/conformance/matchers.hpp>

#include "../bracket.cpp"

namespace {
const BracketSamples samples{.centre = {1, -2, 3}};

TEST(LogCanonical, IsPoisson) {
  EXPECT_THAT(LogCanonical{}, IsSkew(samples));
  EXPECT_THAT(LogCanonical{}, ObeysLeibniz(samples));
  EXPECT_THAT(LogCanonical{}, ObeysJacobi(samples));
}
}  // namespace
