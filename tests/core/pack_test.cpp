// Pack: every function gives in every lane what the standard library gives, and a formula gives the same in
// packs as in doubles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>

namespace {
using namespace pfaff;

template <int W>
Pack<W> lane_numbers() {
  Pack<W> x;
  for (int lane = 0; lane < W; ++lane) x.set(static_cast<std::size_t>(lane), 0.3 + 0.7 * lane);
  return x;
}
// Where a function of packs differs from one of doubles: how many lanes.
template <int W, class F, class G>
int different(const F& of_pack, const G& of_double) {
  const Pack<W> x = lane_numbers<W>(), y = of_pack(x);
  int count = 0;
  for (std::size_t lane = 0; lane < W; ++lane) count += y[lane] == of_double(x[lane]) ? 0 : 1;
  return count;
}

template <int W>
void functions_are_those_of_the_lanes() {
  const auto both = [](const auto& f) { return different<W>(f, f); };
  EXPECT_EQ(both([](const auto& x) { return sqrt(x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return exp(x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return log(x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return sin(x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return cos(x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return pow(x, Real::fraction(7, 3)); }), 0);
  EXPECT_EQ(both([](const auto& x) { return pow(x, Real(-2)); }), 0);
  EXPECT_EQ(both([](const auto& x) { return select(x - 1, x * 2, -x); }), 0);
  EXPECT_EQ(both([](const auto& x) { return 0.1_r * x / (1 + sqrt(x) * exp(-x)); }), 0);
  // Control: another function differs in every lane.
  EXPECT_EQ(different<W>([](const auto& x) { return sin(x); }, [](double x) { return std::cos(x); }), W);
}

// A number of either sign, of either zero, infinite, and one that is none.
template <int W>
void roots_and_sizes_of_special_numbers() {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> numbers{-2.5, 2.5, -0.0, 0.0, -infinity, infinity, std::nan(""), -1e-310};
  for (std::size_t first = 0; first < numbers.size(); ++first) {
    Pack<W> x;
    for (std::size_t lane = 0; lane < W; ++lane) x.set(lane, numbers[(first + lane) % numbers.size()]);
    const Pack<W> size = abs(x), root = sqrt(x);
    for (std::size_t lane = 0; lane < W; ++lane) {
      EXPECT_EQ(std::signbit(size[lane]), false);
      EXPECT_TRUE(size[lane] == std::abs(x[lane]) || (std::isnan(x[lane]) && std::isnan(size[lane])));
      EXPECT_TRUE(root[lane] == std::sqrt(x[lane]) ||
                  (std::isnan(std::sqrt(x[lane])) && std::isnan(root[lane])));
      EXPECT_EQ(std::signbit(root[lane]) && x[lane] == 0, std::signbit(x[lane]) && x[lane] == 0);
    }
  }
}
TEST(Pack, RootsAndSizesOfSpecialNumbers) {
  roots_and_sizes_of_special_numbers<1>();
  roots_and_sizes_of_special_numbers<2>();
  roots_and_sizes_of_special_numbers<4>();
  roots_and_sizes_of_special_numbers<8>();
}

template <int W>
void halves_are_the_lanes() {
  const Pack<W> x = lane_numbers<W>();
  const Pack<W / 2> lower = x.lower(), upper = x.upper();
  for (std::size_t lane = 0; lane < W / 2; ++lane) {
    EXPECT_EQ(lower[lane], x[lane]);
    EXPECT_EQ(upper[lane], x[W / 2 + lane]);
  }
}
TEST(Pack, HalvesAreTheLanes) {
  halves_are_the_lanes<2>();
  halves_are_the_lanes<4>();
  halves_are_the_lanes<8>();
}

// Zeros of both signs are different numbers, and a NaN is the same as itself.
TEST(Pack, FunctionsOfCopiesAreComputedOnce) {
  Pack<8> x;
  const std::vector<double> numbers{1, 2, 2, 0.0, -0.0, std::nan(""), std::nan(""), 2};
  for (std::size_t lane = 0; lane < 8; ++lane) x.set(lane, numbers[lane]);
  std::vector<double> asked;
  const Pack<8> y = x.each([&](double number) {
    asked.push_back(number);
    return -number;
  });
  EXPECT_EQ(asked.size(), 6U);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    EXPECT_EQ(std::signbit(y[lane]), !std::signbit(x[lane]));
    EXPECT_TRUE(y[lane] == -x[lane] || lane == 5 || lane == 6);
  }
}

TEST(Pack, FunctionsAreThoseOfTheLanes) {
  functions_are_those_of_the_lanes<1>();
  functions_are_those_of_the_lanes<2>();
  functions_are_those_of_the_lanes<4>();
  functions_are_those_of_the_lanes<8>();
}

}  // namespace
