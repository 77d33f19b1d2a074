// The order conditions of splittings, compositions and processed methods by Lie words.
#include <gtest/gtest.h>

#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace {
using namespace pfaff;

std::vector<std::size_t> conditions_by_degree(const std::vector<OrderCondition>& conditions, int largest) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(largest));
  for (const OrderCondition& c : conditions) ++counts[static_cast<std::size_t>(c.order) - 1];
  return counts;
}

Quad third() { return Quad(1) / Quad(3); }
Quad gamma_4() { return Quad(1) / (Quad(2) - pow(Quad(2), third())); }

// Drift, kick, drift ... with the lengths in turn.
std::vector<PartialFlow> flows(const std::vector<Quad>& lengths, std::size_t first = 0) {
  std::vector<PartialFlow> list;
  for (std::size_t k = 0; k < lengths.size(); ++k) list.push_back({(first + k) % 2, lengths[k]});
  return list;
}

// Stoermer-Verlet with the weights of a composition.
std::vector<PartialFlow> composed_verlet(const std::vector<Quad>& weights) {
  std::vector<PartialFlow> list;
  for (const Quad& w : weights)
    for (const auto& [part, length] :
         {std::pair(0U, w / Quad(2)), std::pair(1U, w), std::pair(0U, w / Quad(2))})
      list.push_back({part, length});
  return list;
}

int word_order(const std::vector<OrderCondition>& conditions) {
  return order_shown(conditions, precision_of_quad_coefficients);
}

TEST(Words, LyndonWordsAreAsManyAsThereAre) {
  const Words two({1, 1}, 10);
  std::vector<std::size_t> counts;
  for (int degree = 1; degree <= 10; ++degree) counts.push_back(two.lyndon(degree).size());
  EXPECT_EQ(counts, (std::vector<std::size_t>{2, 1, 2, 3, 6, 9, 18, 30, 56, 99}));
}

TEST(Words, ExponentialAndLogarithmAreInverseInExactFractions) {
  const Words words({1, 1, 2}, 6);
  WordSeries<Rational> x(words);
  for (std::size_t w = 1; w < words.size(); ++w)
    x[w] = Rational(static_cast<int>(w * w % 11) - 5) / Rational(static_cast<int>(w % 7) + 1);
  const WordSeries<Rational> back = logarithm(exponential(x));
  for (std::size_t w = 0; w < words.size(); ++w) EXPECT_EQ(back[w], x[w]);
}

TEST(Words, TheThreeWaysToAnExponentialAgreeInExactFractions) {
  const Words words({1, 1, 3}, 7);
  const std::vector<Rational> lengths{Rational(2) / Rational(3), Rational(-5), Rational(1) / Rational(7)};
  auto start = WordSeries<Rational>::one(words);
  start.times_exponential(1, Rational(1) / Rational(2));
  WordSeries<Rational> exponent(words);
  for (std::size_t letter = 0; letter < 3; ++letter) exponent[words.extended(0, letter)] = lengths[letter];
  WordSeries<Rational> product = start * exponential(exponent), stepped = start;
  stepped.times_exponential_of_sum(lengths);
  for (std::size_t w = 0; w < words.size(); ++w) EXPECT_EQ(stepped[w], product[w]);
  WordSeries<Rational> letter(words);
  letter[words.extended(0, 2)] = lengths[2];
  product = start * exponential(letter);
  start.times_exponential(2, lengths[2]);
  for (std::size_t w = 0; w < words.size(); ++w) EXPECT_EQ(start[w], product[w]);
}

TEST(Words, TheFormulaOfBakerCampbellAndHausdorff) {
  // log(e^A e^B) = A + B + [A,B]/2 + [A,[A,B]]/12 + [B,[B,A]]/12 + [B,[A,[B,A]]]/24 ... In words: AB has the
  // coefficient 1/2, AAB 1/12, ABB 1/12, AABB 1/24, and AAAB and ABBB have none.
  const Words words({1, 1}, 4);
  auto product = WordSeries<Rational>::one(words);
  product.times_exponential(0, Rational(1));
  product.times_exponential(1, Rational(1));
  const auto log = logarithm(product);
  const auto at = [&](const std::vector<std::size_t>& word) { return log[words.find(word)]; };
  EXPECT_EQ(at({0}), Rational(1));
  EXPECT_EQ(at({0, 1}), Rational(1) / Rational(2));
  EXPECT_EQ(at({0, 0, 1}), Rational(1) / Rational(12));
  EXPECT_EQ(at({0, 1, 1}), Rational(1) / Rational(12));
  EXPECT_EQ(at({0, 0, 1, 1}), Rational(1) / Rational(24));
  EXPECT_EQ(at({0, 0, 0, 1}), Rational(0));
  EXPECT_EQ(at({0, 1, 1, 1}), Rational(0));
}

TEST(Words, BracketingsOfLyndonWordsAreIndependent) {
  // The coefficients of Lyndon words in their bracketings are a triangle with ones on the diagonal.
  const Words words({1, 1}, 7);
  for (int degree = 1; degree <= 7; ++degree) {
    const auto lyndon = words.lyndon(degree);
    for (std::size_t k = 0; k < lyndon.size(); ++k) {
      const auto bracket = bracketing<Rational>(words, lyndon[k]);
      EXPECT_EQ(bracket[lyndon[k]], Rational(1));
      for (const std::size_t smaller : lyndon)
        if (words.spelt(smaller) < words.spelt(lyndon[k])) {
          EXPECT_EQ(bracket[smaller], Rational(0));
        }
    }
  }
}

TEST(WordConditions, AreAsManyAsThereAre) {
  const auto verlet = flows({Quad(0.5), Quad(1), Quad(0.5)});
  EXPECT_EQ(conditions_by_degree(splitting_conditions(verlet, 10), 10),
            (std::vector<std::size_t>{2, 1, 2, 3, 6, 9, 18, 30, 56, 99}));
  EXPECT_EQ(conditions_by_degree(splitting_conditions(verlet, 10, Parts::quadratic_kinetic), 10),
            (std::vector<std::size_t>{2, 1, 2, 2, 4, 5, 10, 14, 25, 39}));
  EXPECT_EQ(conditions_by_degree(composition_conditions({Quad(1)}, 10), 10),
            (std::vector<std::size_t>{1, 0, 1, 1, 2, 2, 4, 5, 8, 11}));
  // A processor of degree n - 1 removes as many conditions of degree n as there are elements of degree n - 1
  // but for A + B, which does nothing.
  EXPECT_EQ(conditions_by_degree(effective_conditions(verlet, 7), 7),
            (std::vector<std::size_t>{2, 0, 1, 1, 3, 3, 9}));
}

TEST(WordConditions, GiveTheKnownOrdersOfSplittings) {
  EXPECT_EQ(word_order(splitting_conditions(flows({Quad(1), Quad(1)}), 4)), 1);
  EXPECT_EQ(word_order(splitting_conditions(flows({Quad(0.5), Quad(1), Quad(0.5)}), 4)), 2);
  // ruth1983, of order 3
  const std::vector<Quad> ruth{Quad(1),           Quad(-1) / Quad(24), Quad(-2) * third(),
                               Quad(3) / Quad(4), Quad(2) * third(),   Quad(7) / Quad(24)};
  EXPECT_EQ(word_order(splitting_conditions(flows(ruth), 5)), 3);
  EXPECT_EQ(word_order(splitting_conditions(composed_verlet(yoshida_weights(4)), 6)), 4);
  EXPECT_EQ(word_order(splitting_conditions(composed_verlet(suzuki_weights(4)), 6)), 4);
  EXPECT_EQ(word_order(splitting_conditions(composed_verlet(kahan_li_weights(6)), 8)), 6);
}

TEST(WordConditions, GiveTheKnownOrdersOfCompositions) {
  EXPECT_EQ(word_order(composition_conditions(yoshida_weights(4), 6)), 4);
  EXPECT_EQ(word_order(composition_conditions(yoshida_weights(8), 10)), 8);
  EXPECT_EQ(word_order(composition_conditions(suzuki_weights(6), 8)), 6);
  EXPECT_EQ(word_order(composition_conditions(kahan_li_weights(6), 8)), 6);
  EXPECT_EQ(word_order(composition_conditions(kahan_li_weights(8), 10)), 8);
}

// McLachlan and Atela's four kicks and drifts (mclachlan-atela1992), in their nineteen digits: of order 4
// where kinetic energies are quadratic and of order 3 else.
TEST(WordConditions, ThoseOfNystroemAreFewer) {
  const auto number = [](const char* text) {
    Quad x;
    EXPECT_TRUE(parse(text, x));
    return x;
  };
  const auto method = flows(
      {number("0.1344961992774310892"), number("0.5153528374311229364"), number("-0.2248198030794208058"),
       number("-0.085782019412973646"), number("0.7563200005156682911"), number("0.4415830236164665242"),
       number("0.3340036032863214255"), number("0.1288461583653841854")},
      1);
  const Quad digits(1e-16);
  EXPECT_EQ(order_shown(splitting_conditions(method, 5), digits), 3);
  EXPECT_EQ(order_shown(splitting_conditions(method, 5, Parts::quadratic_kinetic), digits), 4);
}

TEST(WordConditions, NameTheConditionThatAChangeOf1e9Violates) {
  auto weights = yoshida_weights(4);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    auto changed = weights;
    changed[k] += Quad(1e-9);
    const auto conditions = composition_conditions(changed, 4);
    const OrderCondition* first = first_violated(conditions, 4, precision_of_quad_coefficients);
    ASSERT_NE(first, nullptr);
    EXPECT_EQ(first->name, "the Lie word Y1 = 1");
    EXPECT_LT(abs(first->residual - Quad(1e-9)), Quad(1e-32));
  }
  // Consistent still, but with the cubes off: 3 (g1^2 - g2^2) 1e-9, as the derivative says.
  auto changed = weights;
  changed[0] += Quad(1e-9);
  changed[1] -= Quad(1e-9);
  const auto conditions = composition_conditions(changed, 4);
  const OrderCondition* first = first_violated(conditions, 4, precision_of_quad_coefficients);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->name, "the Lie word Y3 = 0");
  const Quad expected = Quad(3e-9) * (weights[0] * weights[0] - weights[1] * weights[1]);
  EXPECT_LT(abs(first->residual - expected), Quad(1e-16));  // the second order of the change
}

TEST(WordConditions, AProcessedMethodHasTheOrderOfItsKernelAtMost) {
  // Symplectic Euler is Stoermer-Verlet processed by half a drift, so that its effective order is 2, not 3.
  const auto euler = flows({Quad(1), Quad(1)});
  EXPECT_EQ(word_order(splitting_conditions(euler, 4)), 1);
  EXPECT_EQ(word_order(effective_conditions(euler, 4)), 2);
  // The same of a method of order 4, conjugated by a drift and a kick.
  std::vector<PartialFlow> pre{{0, Quad(0.3)}, {1, Quad(-0.2)}}, whole = pre;
  for (const PartialFlow& flow : composed_verlet(yoshida_weights(4))) whole.push_back(flow);
  for (const PartialFlow& flow : inverse(pre)) whole.push_back(flow);
  EXPECT_EQ(word_order(splitting_conditions(whole, 5)), 1);
  EXPECT_EQ(word_order(effective_conditions(whole, 6)), 4);
  // A consistent kernel that nothing can lift: its part of degree 3 is no bracket with A + B.
  EXPECT_EQ(word_order(effective_conditions(flows({Quad(0.5), Quad(1), Quad(0.5)}), 4)), 2);
  EXPECT_EQ(gamma_4(), yoshida_weights(4).front());
}

}  // namespace
