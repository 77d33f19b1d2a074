// Pack: every function gives in every lane what the standard library gives, and a formula gives the same in
// packs as in doubles.
#include <gtest/gtest.h>

#include <cmath>

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

TEST(Pack, FunctionsAreThoseOfTheLanes) {
  functions_are_those_of_the_lanes<1>();
  functions_are_those_of_the_lanes<2>();
  functions_are_those_of_the_lanes<4>();
  functions_are_those_of_the_lanes<8>();
}

}  // namespace
