// The order conditions of Runge-Kutta methods by rooted trees.
#include <gtest/gtest.h>

#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/integrators/order_conditions/rooted_trees.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace {
using namespace pfaff;

Rational fraction(int a, int b) { return Rational(a) / Rational(b); }

// A tableau of fractions: the rows of the lower triangle of a, then b.
RungeKuttaTableau<Rational> lower_triangle(std::size_t s, const std::vector<Rational>& rows) {
  RungeKuttaTableau<Rational> tableau{std::vector<Rational>(s * s), std::vector<Rational>(s)};
  std::size_t k = 0;
  for (std::size_t i = 1; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) tableau.a[i * s + j] = rows[k++];
  for (std::size_t i = 0; i < s; ++i) tableau.b[i] = rows[k++];
  return tableau;
}

const RungeKuttaTableau<Rational>& classical() {
  static const auto tableau = lower_triangle(4, {fraction(1, 2), 0, fraction(1, 2), 0, 0, 1, fraction(1, 6),
                                                 fraction(1, 3), fraction(1, 3), fraction(1, 6)});
  return tableau;
}

// Dormand and Prince's method of order 5 (hairer-norsett-wanner1993, II.5, table 5.2).
const RungeKuttaTableau<Rational>& dormand_prince() {
  static const auto tableau = lower_triangle(7, {fraction(1, 5),
                                                 fraction(3, 40),
                                                 fraction(9, 40),
                                                 fraction(44, 45),
                                                 fraction(-56, 15),
                                                 fraction(32, 9),
                                                 fraction(19372, 6561),
                                                 fraction(-25360, 2187),
                                                 fraction(64448, 6561),
                                                 fraction(-212, 729),
                                                 fraction(9017, 3168),
                                                 fraction(-355, 33),
                                                 fraction(46732, 5247),
                                                 fraction(49, 176),
                                                 fraction(-5103, 18656),
                                                 fraction(35, 384),
                                                 0,
                                                 fraction(500, 1113),
                                                 fraction(125, 192),
                                                 fraction(-2187, 6784),
                                                 fraction(11, 84),
                                                 fraction(35, 384),
                                                 0,
                                                 fraction(500, 1113),
                                                 fraction(125, 192),
                                                 fraction(-2187, 6784),
                                                 fraction(11, 84),
                                                 0});
  return tableau;
}

RungeKuttaTableau<Quad> in_quad(const RungeKuttaTableau<Rational>& exact) {
  RungeKuttaTableau<Quad> tableau;
  for (const Rational& x : exact.a) tableau.a.push_back(Quad(x));
  for (const Rational& x : exact.b) tableau.b.push_back(Quad(x));
  return tableau;
}

RungeKuttaTableau<Quad> gauss(int stages) {
  const GaussCoefficients g = gauss_coefficients(stages);
  return {g.matrix, g.weights};
}

// The order in exact rationals, up to `most`.
int exact_order(const RungeKuttaTableau<Rational>& tableau, int most) {
  const auto weights = elementary_weights(tableau, most);
  int order = most;
  for (std::size_t k = 0; k < weights.size(); ++k)
    if (weights[k] * Rational(static_cast<int>(rooted_trees()[k].density)) != Rational(1))
      order = std::min(order, rooted_trees()[k].order - 1);
  return order;
}

int tree_order(const RungeKuttaTableau<Quad>& tableau, int most) {
  return order_shown(tree_conditions(tableau, most), precision_of_quad_coefficients);
}

TEST(RootedTrees, AreAsManyAsThereAre) {
  std::vector<int> counts(largest_tree);
  for (const RootedTree& tree : rooted_trees()) ++counts[static_cast<std::size_t>(tree.order) - 1];
  EXPECT_EQ(counts, (std::vector<int>{1, 1, 2, 4, 9, 20, 48, 115, 286, 719}));
}

TEST(RootedTrees, HaveTheirDensities) {
  const auto& trees = rooted_trees();
  EXPECT_EQ(to_string(trees[0]), "t");
  EXPECT_EQ(to_string(trees[1]), "[t]");
  std::vector<std::pair<std::string, std::int64_t>> of_order_4;
  for (const RootedTree& tree : trees)
    if (tree.order == 4) of_order_4.emplace_back(to_string(tree), tree.density);
  const std::vector<std::pair<std::string, std::int64_t>> expected{
      {"[t,t,t]", 4}, {"[[t],t]", 8}, {"[[t,t]]", 12}, {"[[[t]]]", 24}};
  EXPECT_EQ(of_order_4, expected);
  // The sum over trees of n!/(density * symmetry), the numbers of increasing labellings, is (n - 1)!. The
  // symmetry of a tree is found here from its text.
  std::function<long(const RootedTree&)> symmetry = [&](const RootedTree& tree) {
    long product = 1, run = 0;
    for (std::size_t k = 0; k < tree.children.size(); ++k) {
      run = k > 0 && tree.children[k] == tree.children[k - 1] ? run + 1 : 1;
      product *= run * symmetry(trees[tree.children[k]]);
    }
    return product;
  };
  std::vector<long> labellings(largest_tree), factorial{1};
  for (int n = 1; n <= largest_tree; ++n) factorial.push_back(factorial.back() * n);
  for (const RootedTree& tree : trees)
    labellings[static_cast<std::size_t>(tree.order) - 1] +=
        factorial[static_cast<std::size_t>(tree.order)] / (tree.density * symmetry(tree));
  for (std::size_t n = 1; n <= largest_tree; ++n) EXPECT_EQ(labellings[n - 1], factorial[n - 1]) << n;
}

TEST(RootedTrees, GiveTheKnownOrdersInExactFractions) {
  EXPECT_EQ(exact_order(classical(), 6), 4);
  EXPECT_EQ(exact_order(dormand_prince(), 7), 5);
  EXPECT_EQ(tree_order(in_quad(classical()), 6), 4);
  EXPECT_EQ(tree_order(in_quad(dormand_prince()), 7), 5);
}

TEST(RootedTrees, GiveTheOrderOfGaussMethods) {
  for (int s = 1; s <= 4; ++s) EXPECT_EQ(tree_order(gauss(s), 2 * s + 1), 2 * s) << s;
  EXPECT_EQ(tree_order(gauss(5), 10), 10);
}

TEST(RootedTrees, NameTheConditionThatAChangeOf1e9Violates) {
  for (const auto& [tableau, order] :
       {std::pair(in_quad(classical()), 4), std::pair(in_quad(dormand_prince()), 5), std::pair(gauss(3), 6)})
    for (std::size_t k = 0; k < tableau.b.size(); ++k) {
      RungeKuttaTableau<Quad> changed = tableau;
      changed.b[k] += Quad(1e-9);
      const auto conditions = tree_conditions(changed, order);
      const OrderCondition* first = first_violated(conditions, order, precision_of_quad_coefficients);
      ASSERT_NE(first, nullptr);
      EXPECT_EQ(first->name, "the tree t, Phi = 1/1");
      EXPECT_LT(abs(first->residual - Quad(1e-9)), Quad(1e-32));
    }
  RungeKuttaTableau<Quad> changed = in_quad(classical());
  changed.a[2 * 4 + 1] += Quad(1e-9);  // b3 a32 = 1/6: consistency is kept, the sum of b_i c_i is not
  const auto conditions = tree_conditions(changed, 4);
  const OrderCondition* first = first_violated(conditions, 4, precision_of_quad_coefficients);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->name, "the tree [t], Phi = 1/2");
  EXPECT_LT(abs(first->residual - Quad(1e-9) / Quad(3)), Quad(1e-32));
}

TEST(RootedTrees, SymplecticityAndSymmetryAreComputed) {
  const auto holds = [](const std::vector<OrderCondition>& conditions) {
    return first_violated(conditions, 0, precision_of_quad_coefficients) == nullptr;
  };
  for (int s = 1; s <= 5; ++s) {
    EXPECT_TRUE(holds(symplecticity_conditions(gauss(s))));
    EXPECT_TRUE(holds(symmetry_conditions(gauss(s))));
  }
  EXPECT_FALSE(holds(symplecticity_conditions(in_quad(classical()))));
  EXPECT_FALSE(holds(symmetry_conditions(in_quad(classical()))));
  const Quad half = Quad(1) / Quad(2);
  const RungeKuttaTableau<Quad> trapezoidal{{Quad(0), Quad(0), half, half}, {half, half}};
  EXPECT_FALSE(holds(symplecticity_conditions(trapezoidal)));  // conjugate to a symplectic method, not one
  EXPECT_TRUE(holds(symmetry_conditions(trapezoidal)));
}

}  // namespace
