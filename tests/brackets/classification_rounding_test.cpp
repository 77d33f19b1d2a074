// Classification of constraints in doubles: units do not matter, and what is round-off counts for nothing.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/brackets/dirac/classification.hpp>

#include "golden_brackets.hpp"
#include "random_gram.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::as;
using pfaff::testing::RandomGram;
using Indices = std::vector<std::size_t>;

// The classes do not depend on the units of the constraints.
TEST(Classification, UnitsOfConstraintsDoNotMatter) {
  RandomGram random(4);
  int checked = 0;
  for (int instance = 0; instance < 50; ++instance) {
    const auto exact = random.of_rank(Symmetry::skew, 6, 4);
    Matrix<double> w = as<double>(exact);
    const auto plain = classify(w, Symmetry::skew);
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        w(i, j) *= std::ldexp(1.0, 30 * (static_cast<int>(i) % 3 - 1) + 30 * (static_cast<int>(j) % 3 - 1));
    const auto scaled = classify(w, Symmetry::skew);
    EXPECT_EQ(scaled.rank(), 4U);
    checked += scaled.order() == plain.order();
  }
  EXPECT_EQ(checked, 50);
}

// Brackets that are round-off of their own terms are zero only if the terms are known.
TEST(Classification, RoundOffOfTermsIsNoPivot) {
  Matrix<double> w(2, 2), sizes(2, 2);
  w(0, 1) = 3e-17;
  w(1, 0) = -3e-17;
  EXPECT_EQ(classify(w, Symmetry::skew).rank(), 2U);
  sizes(0, 1) = sizes(1, 0) = 1;
  EXPECT_EQ(classify(w, Symmetry::skew, Matrix<double>(0, 0), sizes).rank(), 0U);
}

// W = e e^T with e = (1, 0, 1), but for the round-off 3e-17 of terms of size 1 in the bracket of the first
// two. The pivot {1, 1} brings it to the bracket of the last two, which was exactly zero.
TEST(Classification, RoundOffGoesWhereAPivotBringsIt) {
  Matrix<double> w(3, 3), sizes(3, 3);
  w(0, 0) = w(0, 2) = w(2, 0) = w(2, 2) = 1;
  w(0, 1) = w(1, 0) = 3e-17;
  sizes(0, 1) = sizes(1, 0) = 1;
  EXPECT_EQ(classify(w, Symmetry::symmetric, Matrix<double>(0, 0), sizes).rank(), 1U);
  // Control: without the sizes of terms it is no round-off.
  EXPECT_EQ(classify(w, Symmetry::symmetric).rank(), 3U);
}

// Gradients that differ by e = 2^-27 in directions of their own are nearly parallel, so that one pass of
// orthogonalisation leaves the differences at angles that are off by the unit round-off over e. A row along
// the differences that is as long as the others, and depends on them exactly, then keeps a rest of that size.
TEST(Classification, NearlyParallelRowsAreMadeOrthogonalToRoundOff) {
  const double e = std::ldexp(1.0, -27), u = std::ldexp(1.0, -53);
  Matrix<double> rows(4, 4);
  for (std::size_t k = 0; k < 3; ++k) {
    rows(k, 0) = 1;
    rows(k, k + 1) = e;
  }
  rows(3, 1) = rows(3, 2) = 1;  // (first + second - 2 third)/e
  rows(3, 3) = -2;
  const auto found = independent_rows(rows, 64 * u);
  EXPECT_EQ(found.independent, (Indices{0, 1, 2}));
  ASSERT_EQ(found.dependent, Indices{3});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(found.combinations[0][k] * e, k < 2 ? -1 : 2, u / e)
        << k;  // the condition of the rows is 1/e
  // Control: what is off by more than round-off is independent.
  rows(3, 3) = -2 + 1e-12;
  rows(3, 0) = 1e-12;
  EXPECT_EQ(independent_rows(rows, 64 * u).independent, (Indices{0, 1, 2, 3}));
}
}  // namespace
