// Patterns of symmetric matrices: which structure a pattern is recognized as, and in what order its rows are
// eliminated.
#include <gtest/gtest.h>

#include <chrono>

#include "structured_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

TEST(SymmetricPattern, KnowsEveryStructure) {
  std::mt19937_64 random(31);
  for (const Sample& sample : samples(random)) {
    EXPECT_EQ(sample.pattern->structure(), sample.structure)
        << sample.name << " is " << to_string(sample.pattern->structure());
    // Every row once.
    auto order = sample.pattern->plan().order;
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(order[k], k);
  }
  EXPECT_EQ(SymmetricPattern(0, {}).structure(), MatrixStructure::diagonal);
  EXPECT_EQ(SymmetricPattern(1, {}).structure(), MatrixStructure::diagonal);
}

TEST(SymmetricPattern, CouplingsAreSortedAndMerged) {
  const SymmetricPattern pattern(4, {{3, 1}, {0, 1}, {1, 3}, {1, 0}, {2, 3}});
  EXPECT_EQ(pattern.couplings(), (Couplings{{0, 1}, {1, 3}, {2, 3}}));
  EXPECT_EQ(pattern.coupling(3, 1), 1U);
  EXPECT_EQ(pattern.coupling(1, 3), 1U);
  EXPECT_EQ(pattern.coupling(0, 2), SymmetricPattern::npos);
  EXPECT_EQ(pattern.coupling(2, 2), SymmetricPattern::npos);
}

TEST(SymmetricPattern, RefusesCouplingsOfNoTwoRows) {
  const auto message = [](const Couplings& couplings) -> std::string {
    try {
      const SymmetricPattern pattern(4, couplings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({{0, 1}, {2, 2}}),
            "pattern of 4 rows: coupling (2, 2) does not join two different rows of it");
  EXPECT_EQ(message({{4, 1}}), "pattern of 4 rows: coupling (4, 1) does not join two different rows of it");
  EXPECT_EQ(message({{3, 1}}), "accepted");
}

// The order of a shuffled chain or ring follows it.
TEST(SymmetricPattern, FollowsAChainWhereverItsRowsAre) {
  std::mt19937_64 random(32);
  for (const std::size_t rows : {2, 3, 10, 57}) {
    for (const bool closed : {false, true}) {
      if (closed && rows < 3) continue;
      const SymmetricPattern pattern(rows, shuffled(rows, closed ? ring(rows) : chain(rows), random));
      const EliminationPlan& plan = pattern.plan();
      for (std::size_t k = 0; k < rows; ++k) {
        if (k + 1 == rows && !closed) {
          EXPECT_EQ(plan.link[k], pattern.couplings().size());
        } else {
          EXPECT_EQ(plan.link[k], pattern.coupling(plan.order[k], plan.order[(k + 1) % rows]));
        }
      }
      EXPECT_EQ(pattern.fill(), closed ? rows - 3 : 0);
    }
  }
  EXPECT_TRUE(SymmetricPattern::path(9).plan().natural);
  EXPECT_FALSE(SymmetricPattern(3, {{0, 2}, {2, 1}}).plan().natural);
}

// Fill by definition: the couplings that appear when rows are eliminated in this order.
std::size_t fill_of(std::size_t rows, const Couplings& couplings, const std::vector<std::size_t>& order) {
  std::vector<char> coupled(rows * rows), gone(rows);
  for (const auto& [i, j] : couplings) coupled[i * rows + j] = coupled[j * rows + i] = 1;
  std::size_t fill = 0;
  for (const std::size_t k : order) {
    gone[k] = 1;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = i + 1; j < rows; ++j)
        if (gone[i] == 0 && gone[j] == 0 && coupled[k * rows + i] != 0 && coupled[k * rows + j] != 0 &&
            coupled[i * rows + j] == 0) {
          coupled[i * rows + j] = coupled[j * rows + i] = 1;
          ++fill;
        }
  }
  return fill;
}
std::vector<std::size_t> order_of(const SymmetricPattern& pattern) {
  return {pattern.plan().order.begin(), pattern.plan().order.end()};
}

// Of all graphs of six rows (a random thousand): an order without fill is found exactly when trying all
// orders finds one.
TEST(SymmetricPattern, FindsAnOrderWithoutFillWhereThereIsOne) {
  std::mt19937_64 random(33);
  const std::size_t rows = 6;
  int without = 0, with = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Couplings couplings;
    const unsigned long density = 1 + random() % 4;
    for (const auto& coupling : complete(rows))
      if (random() % 5 < density) couplings.push_back(coupling);
    std::vector<std::size_t> order(rows);
    std::iota(order.begin(), order.end(), std::size_t(0));
    bool exists = false;
    do exists = fill_of(rows, couplings, order) == 0;
    while (!exists && std::next_permutation(order.begin(), order.end()));
    const SymmetricPattern pattern(rows, couplings);
    ASSERT_EQ(pattern.fill() == 0, exists) << trial;
    if (!pattern.plan().row.empty()) {
      EXPECT_EQ(fill_of(rows, couplings, order_of(pattern)), pattern.fill()) << trial;
    }
    ++(exists ? without : with);
  }
  EXPECT_GT(without, 100);
  EXPECT_GT(with, 100);
}

TEST(SymmetricPattern, MinimumDegreeFillsLessThanTheOrderGiven) {
  const std::size_t width = 12;
  const SymmetricPattern pattern(width * width, lattice(width, width));
  EXPECT_EQ(pattern.structure(), MatrixStructure::sparse);
  const std::size_t fill = fill_of(pattern.rows(), pattern.couplings(), order_of(pattern));
  EXPECT_EQ(pattern.fill(), fill);
  // Control: row by row the band fills up, (width - 1)^2 couplings for every row of the lattice but one.
  std::vector<std::size_t> natural(pattern.rows());
  std::iota(natural.begin(), natural.end(), std::size_t(0));
  const std::size_t band = fill_of(pattern.rows(), pattern.couplings(), natural);
  EXPECT_EQ(band, (width - 1) * (width - 1) * (width - 1));
  EXPECT_LT(2 * fill, band);
}

// Set-up in linear time: 10^5 rows, where quadratic time would be minutes.
TEST(SymmetricPattern, LongChainsAndLargeTreesAreSetUpInLinearTime) {
  std::mt19937_64 random(34);
  const std::size_t rows = 100000;
  const Couplings open = shuffled(rows, chain(rows), random), closed = shuffled(rows, ring(rows), random),
                  tree = shuffled(rows, random_tree_of_rods(rows, 5, random), random);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(SymmetricPattern(rows, open).structure(), MatrixStructure::tridiagonal);
  EXPECT_EQ(SymmetricPattern(rows, closed).structure(), MatrixStructure::cyclic);
  EXPECT_EQ(SymmetricPattern(rows, tree).structure(), MatrixStructure::tree);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 10);
}

}  // namespace
