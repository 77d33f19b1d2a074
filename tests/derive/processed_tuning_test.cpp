// Processed splittings that are tuned: the series behind them against other mathematics, the order of what is
// found, and what it gains.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/derive/tuning/palindromes.hpp>
#include <pfaff/derive/tuning/processor.hpp>

#include "splittings.hpp"

namespace pfaff::testing {
namespace {

WordSeries<Quad> random_lie_series(const Words& words, int from, int to, std::mt19937_64& random) {
  WordSeries<Quad> sum(words);
  for (int degree = from; degree <= to; ++degree)
    for (const std::size_t word : words.lyndon(degree)) {
      WordSeries<Quad> term = bracketing<Quad>(words, word);
      term *= Quad(uniform(random) - 0.5);
      sum += term;
    }
  return sum;
}

Quad largest_difference(WordSeries<Quad> a, const WordSeries<Quad>& b) {
  a -= b;
  Quad largest(0);
  for (std::size_t w = 0; w < a.words().size(); ++w) largest = std::max(largest, abs(a[w]));
  return largest;
}

std::vector<PartialFlow> random_palindrome(int stages, std::mt19937_64& random) {
  std::vector<Quad> x;
  for (int k = 0; k <= stages; ++k) x.emplace_back(uniform(random) - 0.3);
  return palindrome(x, stages);
}

// The largest error of the energy over so many steps of a kernel between `pre` and its inverse, which is
// applied to copies: what it costs does not depend on the steps.
double energy_error(const Model& model, const std::vector<PartialFlow>& pre,
                    const std::vector<PartialFlow>& kernel, double h, int steps) {
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad());
  Replay<Quad> kinetic(model.tape(Formula::kinetic)), potential(model.tape(Formula::potential));
  const auto energy = [&](const std::vector<Quad>& state) {
    Quad t(0), v(0);
    kinetic(Quad(0), state.data() + state.size() / 2, &t);
    potential(Quad(0), state.data(), &v);
    return t + v;
  };
  const Quad before = energy(z);
  double largest = 0;
  z = step(model, pre, Quad(h), z);
  for (int k = 0; k < steps; ++k) {
    z = step(model, kernel, Quad(h), z);
    const Quad error = energy(step(model, inverse(pre), Quad(h), z)) - before;
    largest = std::max(largest, std::abs(static_cast<double>(error)));
  }
  return largest;
}

// exp(ad q) x = log(exp(q) exp(x) exp(-q)); with -q it is something else.
TEST(ProcessedTuning, TransformedLogarithmIsThatOfTheTransformedProduct) {
  const Words words({1, 1}, 7);
  std::mt19937_64 random(1);
  const auto q = random_lie_series(words, 2, 6, random), x = random_lie_series(words, 1, 7, random);
  WordSeries<Quad> back = q;
  back *= Quad(-1);
  const auto product = exponential(q) * exponential(x) * exponential(back);
  // Some hundred terms of size 1 at most.
  EXPECT_LT(largest_difference(transformed(q, x), logarithm(product)), Quad(1e-31));
  EXPECT_GT(largest_difference(transformed(back, x), logarithm(product)), Quad(1e-3));
}

// Of Strang's splitting -[A, [A, B]]/24 and [[A, B], B]/12 are left; [[A, B], A + B] is the difference of the
// two brackets, so that their sum 1/24 is what no processor removes.
TEST(ProcessedTuning, WhatNoProcessorRemovesOfStrangsSplitting) {
  const Words words({1, 1}, 7);
  const auto lifted = KernelSeries<double>(words, 4).of(strang());
  ASSERT_EQ(lifted.conditions.size(), 3U);
  EXPECT_EQ(lifted.conditions[0], 0);
  EXPECT_EQ(lifted.conditions[1], 0);
  EXPECT_NEAR(std::abs(lifted.conditions[2]), 1.0 / 24, 1e-16);
}

// The same conditions as those that tables are checked by, which multiply exponentials instead.
TEST(ProcessedTuning, ConditionsAreThoseOfTheEffectiveOrder) {
  std::mt19937_64 random(2);
  const Words words({1, 1}, 6);
  const KernelSeries<Quad> series(words, 6);
  for (int repetition = 0; repetition < 3; ++repetition) {
    const auto kernel = random_palindrome(6, random);
    std::vector<Quad> expected;
    for (const OrderCondition& condition : effective_conditions(kernel, 6))
      if (condition.order % 2 == 1) expected.push_back(condition.residual);
    const auto found = series.of(kernel);
    ASSERT_EQ(found.conditions.size(), expected.size());
    ASSERT_EQ(found.conditions.size(), 2U + 1U + 3U);
    Quad off(0);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_LT(abs(found.conditions[k] - expected[k]), Quad(1e-31)) << k;
      off = std::max(off, abs(expected[k]));
    }
    EXPECT_GT(off, Quad(1e-3));  // none of them is of that order
  }
  // A method of order 4 is a kernel of effective order 4 and needs no processor.
  const auto lifted = KernelSeries<Quad>(words, 4).of(triple_jump());
  for (const Quad& residual : lifted.conditions) EXPECT_LT(abs(residual), Quad(1e-32));
  EXPECT_LT(largest_difference(lifted.processor, WordSeries<Quad>::one(words)), Quad(1e-32));
}

TEST(ProcessedTuning, BracketsWithTheSumAreAllThatAProcessorRemoves) {
  const SplittingLogarithm logarithm(4, Degrees::all);
  const ShadowTerms terms(*system("quadrupole-boson"), logarithm, 0.1,
                          states_along_the_motion(system("quadrupole-boson"), 50));
  const Irremovable irremovable(logarithm, terms);
  const Words& words = logarithm.words();
  std::mt19937_64 random(3);
  WordSeries<Quad> whole(words);
  for (const std::size_t letter : {0U, 1U}) whole[words.extended(0, letter)] = Quad(1);
  const auto rounded = [&](const WordSeries<Quad>& series) {
    WordSeries<double> result(words);
    for (std::size_t w = 0; w < words.size(); ++w) result[w] = static_cast<double>(series[w]);
    return result;
  };
  const auto removable = rounded(commutator(random_lie_series(words, 4, 6, random), whole));
  const double all = terms.of(logarithm.brackets(removable));
  // Directions below 1e-7 of what they are summed from are not removed.
  EXPECT_LT(norm_of(irremovable.of(removable)), 1e-6 * all);
  // The control: of any other series something is left, which no removable one makes smaller.
  auto other = rounded(random_lie_series(words, 5, 7, random));
  const double left = norm_of(irremovable.of(other));
  EXPECT_GT(left, 1e-3 * terms.of(logarithm.brackets(other)));
  for (int k = 0; k < 10; ++k) {
    EXPECT_GE(terms.of(logarithm.brackets(other)), left);
    other += rounded(commutator(random_lie_series(words, 4, 6, random), whole));
  }
}

TEST(ProcessedTuning, HasItsOrderByTheProcessorAndGainsByIt) {
  const auto model = system("henon-heiles");
  const SplittingLogarithm logarithm(4, Degrees::all);
  const double h = 0.6;
  const ShadowTerms terms(*model, logarithm, h, states_along_the_motion(model, 50));
  const TuningSettings settings{.order = 4, .stages = 4, .processor = 5, .starts = 2};
  const TunedSplitting tuned = tuned_splitting(logarithm, terms, settings);
  ASSERT_EQ(tuned.flows.size(), 9U);
  ASSERT_EQ(tuned.pre.size(), 10U);
  const Quad precision = precision_of_quad_coefficients;
  const auto whole = processed_step(tuned.pre, tuned.flows);
  EXPECT_EQ(first_violated(splitting_conditions(whole, 4), 4, precision), nullptr);
  EXPECT_NE(first_violated(splitting_conditions(whole, 5), 5, precision), nullptr);
  EXPECT_EQ(first_violated(effective_conditions(tuned.flows, 4), 4, precision), nullptr);
  // Controls: without the processor the order is 2, and each number that is changed is missed.
  EXPECT_EQ(order_shown(splitting_conditions(tuned.flows, 4), precision), 2);
  for (std::size_t k = 0; k < tuned.flows.size(); ++k) {
    auto changed = tuned.flows;
    changed[k].length += Quad(1e-9);
    EXPECT_NE(first_violated(effective_conditions(changed, 4), 4, precision), nullptr) << k;
  }
  for (std::size_t k = 0; k < tuned.pre.size(); ++k) {
    auto changed = tuned.pre;
    changed[k].length += Quad(1e-9);
    EXPECT_NE(first_violated(splitting_conditions(processed_step(changed, tuned.flows), 4), 4, precision),
              nullptr)
        << k;
  }
  EXPECT_EQ(tuned.error, terms.of(logarithm.of(whole).brackets));
  EXPECT_GE(tuned.error, tuned.error_of_kernel);
  // The palindrome of as many forces that is tuned alone has one free number.
  const SplittingLogarithm odd(4);
  const ShadowTerms odd_terms(*model, odd, h, states_along_the_motion(model, 50));
  const TunedSplitting alone = tuned_splitting(odd, odd_terms, {.order = 4, .stages = 4, .starts = 8});
  EXPECT_LT(tuned.error, alone.error / 3);
  const double error = energy_error(*model, tuned.pre, tuned.flows, h, 200);
  EXPECT_LT(error, energy_error(*model, {}, alone.flows, h, 200) / 3);
  // The kernel without its processor is a method of order 2.
  EXPECT_GT(energy_error(*model, {}, tuned.flows, h, 200), 10 * error);
  // The same seed gives the same method.
  EXPECT_EQ(tuned_splitting(logarithm, terms, settings).pre[0].length, tuned.pre[0].length);
}

TEST(ProcessedTuning, Refusals) {
  EXPECT_EQ(free_coefficients({.order = 4, .stages = 3, .processor = 1}), 1);
  EXPECT_EQ(free_coefficients({.order = 4, .stages = 2, .processor = 1}), 0);
  EXPECT_EQ(free_coefficients({.order = 6, .stages = 6, .processor = 1}), 1);
  EXPECT_EQ(fewest_kicks_of_a_processor(2), 2);
  EXPECT_EQ(fewest_kicks_of_a_processor(4), 3);
  EXPECT_EQ(fewest_kicks_of_a_processor(6), 8);
  EXPECT_NO_THROW(check({.order = 4, .stages = 3, .processor = 3}));
  EXPECT_THROW(check({.order = 4, .stages = 2, .processor = 3}), InputError);
  EXPECT_THROW(check({.order = 4, .stages = 3, .processor = 2}), InputError);
  EXPECT_THROW(check({.order = 4, .stages = 6, .processor = -1}), InputError);
}

}  // namespace
}  // namespace pfaff::testing
