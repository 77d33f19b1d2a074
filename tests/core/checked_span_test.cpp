// The spans of formulas while they are recorded: every element and part past the end is refused, and formulas
// that stay inside are recorded as with plain spans. For the scalars of steps the spans are the language's
// own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace {
using namespace pfaff;

static_assert(std::is_same_v<In<double>, std::span<const double>>);
static_assert(std::is_same_v<Out<Quad>, std::span<Quad>>);

TEST(CheckedSpan, ElementsInsideAreThoseOfTheSpan) {
  std::array<int, 3> numbers{1, 2, 3};
  const CheckedSpan<int> span(numbers);
  EXPECT_EQ(span[0], 1);
  EXPECT_EQ(span.front(), 1);
  EXPECT_EQ(span.back(), 3);
  EXPECT_THAT(std::vector<int>(span.subspan(1).begin(), span.subspan(1).end()), ::testing::ElementsAre(2, 3));
  EXPECT_EQ(span.subspan(3).size(), 0U);
  EXPECT_EQ(span.first(2).back(), 2);
  EXPECT_EQ(span.last(2).front(), 2);
  span[2] = 7;
  const CheckedSpan<const int> read = span;
  EXPECT_EQ(read[2], 7);
  const std::span<const int> plain = read;
  EXPECT_EQ(plain.data(), numbers.data());
}

TEST(CheckedSpan, WhatLiesOutsideIsRefused) {
  std::array<int, 3> numbers{1, 2, 3};
  const CheckedSpan<int> span(numbers), none;
  EXPECT_THROW((void)span[3], std::out_of_range);
  EXPECT_THROW((void)span[static_cast<std::size_t>(-1)], std::out_of_range);
  EXPECT_THROW((void)none.front(), std::out_of_range);
  EXPECT_THROW((void)none.back(), std::out_of_range);
  EXPECT_THROW((void)span.first(4), std::out_of_range);
  EXPECT_THROW((void)span.last(4), std::out_of_range);
  EXPECT_THROW((void)span.subspan(4), std::out_of_range);
  EXPECT_THROW((void)span.subspan(1, 3), std::out_of_range);
  EXPECT_THROW((void)span.subspan(2, static_cast<std::size_t>(-2)), std::out_of_range);
  EXPECT_THROW((void)span.first(2)[2], std::out_of_range);  // inside the array, outside the part
  try {
    (void)span[3];
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "asks for element [3] of an argument with 3 elements");
  }
}

TEST(CheckedSpan, RecordedFormulasAreChecked) {
  const auto reads = [](std::size_t k) {
    return [k](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[0] = z[k]; };
  };
  EXPECT_EQ(record(2, 1, reads(1)).outputs.size(), 1U);
  EXPECT_THROW((void)record(2, 1, reads(2)), std::out_of_range);
  const auto writes = [](std::size_t k) {
    return [k](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[k] = z[0]; };
  };
  EXPECT_EQ(record(2, 1, writes(0)).outputs.size(), 1U);
  EXPECT_THROW((void)record(2, 1, writes(1)), std::out_of_range);
}

}  // namespace
