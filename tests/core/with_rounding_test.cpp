// Numbers that carry a bound of their rounding error: the bound holds for the true error, and is not far
// above it.
#include <gtest/gtest.h>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "random_formula.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::RandomFormula;

// Formulas of every operation: the double result is within its bound of the quad result. To first order only,
// so that it is asked of bounds that stay small; a bound that is off by more than a million is no use.
TEST(WithRounding, BoundsTheErrorOfRandomFormulas) {
  int compared = 0, tight = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const RandomFormula formula{seed, 4, 3, 40};
    const auto tape = std::make_shared<const Tape>(
        record(4, 3, [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
          formula(t, z, out);
        }));
    Replay<Quad> exact(tape);
    Replay<WithRounding<double>> bounded(tape);
    const std::vector<double> z{0.3, -0.7, 1.1, 0.4};
    const std::vector<Quad> quads(z.begin(), z.end());
    const std::vector<WithRounding<double>> numbers(z.begin(), z.end());
    std::vector<Quad> expected(3);
    std::vector<WithRounding<double>> found(3);
    exact(Quad(0.25), quads.data(), expected.data());
    bounded(WithRounding<double>(0.25), numbers.data(), found.data());
    for (std::size_t k = 0; k < 3; ++k) {
      const double bound = found[k].error * unit_roundoff<double>();
      if (!(bound < 1e-10)) continue;
      const auto error = static_cast<double>(abs(Quad(found[k].value) - expected[k]));
      // Library functions are good to one unit in the last place, two roundings.
      ASSERT_LE(error, 2 * bound) << "seed " << seed << " output " << k;
      ++compared;
      tight += bound <= 1e-16 || error >= bound * 1e-6;
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(tight, compared / 2);
}

TEST(WithRounding, RoundOffOfTermsIsNotSignificant) {
  using W = WithRounding<double>;
  const W third = W(1) / W(3);
  EXPECT_FALSE((third + third + third - W(1)).significant());
  EXPECT_FALSE((W(Real::parse("0.1").value()) * W(3) - W(Real::parse("0.3").value())).significant());
  EXPECT_TRUE((third - W(0.3333)).significant());
  EXPECT_TRUE(W(1e-300).significant());
  EXPECT_FALSE(W(0).significant());
}
}  // namespace
