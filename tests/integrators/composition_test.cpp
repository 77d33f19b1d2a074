// Weights of compositions fulfil their order conditions, which are generated here in a way independent of the
// library; and compositions handle the history and compensation of their base method rightly.
#include <gtest/gtest.h>

#include <functional>

#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/verify/check.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::after_steps;
using testing::method_named;
using testing::model_named;

// Some units of round-off, 1e-34, for each coefficient: a sum of products of weights, relative to the sum of
// their absolute values.
constexpr double weight_round_off = 1e-33;

// The coefficient of a word as a sum over the stages k_1 <= k_2 <= ... its letters may come from, each run of
// r letters from one stage with 1 / r!.
Quad counted(const std::vector<Quad>& weights, const Word& word) {
  const std::function<Quad(std::size_t, std::size_t, int)> from = [&](std::size_t letter, std::size_t stage,
                                                                      int run) {
    if (letter == word.size()) return Quad(1);
    Quad sum(0);
    for (std::size_t k = stage; k < weights.size(); ++k) {
      const int length = k == stage ? run + 1 : 1;
      Quad power(1);
      for (int i = 0; i < word[letter]; ++i) power *= weights[k];
      sum += power / Quad(length) * from(letter + 1, k, length);
    }
    return sum;
  };
  return from(0, 0, 0);
}

// Every word of odd letters, Lyndon or not, with this sum.
std::vector<Word> words_of(int weight) {
  if (weight == 0) return {{}};
  std::vector<Word> words;
  for (int letter = 1; letter <= weight; letter += 2)
    for (Word rest : words_of(weight - letter)) {
      rest.insert(rest.begin(), letter);
      words.push_back(rest);
    }
  return words;
}

double defect(const std::vector<Quad>& weights, const Word& word) {
  Quad exact(1);
  for (std::size_t k = 0; k < word.size(); ++k) exact = word[k] == 1 ? exact / Quad(int(k) + 1) : Quad(0);
  std::vector<Quad> sizes;
  for (const Quad& gamma : weights) sizes.push_back(abs(gamma));
  return static_cast<double>(abs(counted(weights, word) - exact) / std::max(Quad(1), counted(sizes, word)));
}
double largest_defect(const std::vector<Quad>& weights, int weight) {
  double largest = 0;
  for (const Word& word : words_of(weight)) largest = std::max(largest, defect(weights, word));
  return largest;
}

struct SchemeCase {
  const char* name;
  std::vector<Quad> weights;
  int order;
};
std::vector<SchemeCase> scheme_cases() {
  return {{"yoshida", yoshida_weights(4), 4},  {"yoshida", yoshida_weights(6), 6},
          {"yoshida", yoshida_weights(8), 8},  {"suzuki", suzuki_weights(4), 4},
          {"suzuki", suzuki_weights(6), 6},    {"kahan-li", kahan_li_weights(6), 6},
          {"kahan-li", kahan_li_weights(8), 8}};
}

TEST(CompositionWeights, FulfilEveryOrderConditionInQuad) {
  for (const SchemeCase& c : scheme_cases())
    for (int weight = 1; weight < c.order; ++weight)
      EXPECT_LE(largest_defect(c.weights, weight), weight_round_off)
          << c.name << ' ' << c.order << ' ' << weight;
}

TEST(CompositionWeights, FailTheNextOnes) {  // control: that order more is seen to be missing
  for (const SchemeCase& c : scheme_cases())
    EXPECT_GT(defect(c.weights, {c.order + 1}), 1e-9) << c.name << ' ' << c.order;
}

TEST(CompositionWeights, AreSymmetricAndAddUpToOne) {
  for (const SchemeCase& c : scheme_cases()) {
    for (std::size_t k = 0; k < c.weights.size(); ++k)
      EXPECT_EQ(c.weights[k], c.weights[c.weights.size() - 1 - k]) << c.name;
    EXPECT_EQ(c.weights.size() % 2, 1U);
  }
}

TEST(CompositionWeights, OfLowOrderAreTheClosedForms) {
  const Quad third = Quad(1) / Quad(3);
  const Quad jump = Quad(1) / (Quad(2) - pow(Quad(2), third)),
             fold = Quad(1) / (Quad(4) - pow(Quad(4), third));
  const auto yoshida = yoshida_weights(4), suzuki = suzuki_weights(4);
  ASSERT_EQ(yoshida.size(), 3U);
  ASSERT_EQ(suzuki.size(), 5U);
  EXPECT_LE(static_cast<double>(abs(yoshida[0] - jump)), weight_round_off);
  EXPECT_LE(static_cast<double>(abs(yoshida[1] + pow(Quad(2), third) * jump)), weight_round_off);
  EXPECT_LE(static_cast<double>(abs(suzuki[1] - fold)), weight_round_off);
  EXPECT_LE(static_cast<double>(abs(suzuki[2] - (Quad(1) - Quad(4) * fold))), weight_round_off);
  EXPECT_EQ(yoshida_weights(2), std::vector<Quad>{Quad(1)});
  EXPECT_EQ(yoshida_weights(10).size(), 81U);
  EXPECT_EQ(suzuki_weights(8).size(), 125U);
}

TEST(CompositionWeights, OfKahanAndLiArePublishedOnesInTheirLastDigit) {
  const auto near = [](Quad ours, const char* published) {
    Quad theirs;
    ASSERT_TRUE(parse(published, theirs));
    EXPECT_LE(static_cast<double>(abs(ours - theirs)), 1e-25) << published;
    EXPECT_NE(ours, theirs);  // 26 digits are not the solution in quad
  };
  const auto six = kahan_li_weights(6), eight = kahan_li_weights(8);
  ASSERT_EQ(six.size(), 9U);
  ASSERT_EQ(eight.size(), 17U);
  near(six[0], "0.39216144400731413927925056");
  near(six[4], "0.79854399093482996339895035");
  near(eight[0], "0.13020248308889008087881763");
  near(eight[8], "-0.60550853383003451169892108");
  EXPECT_THROW((void)kahan_li_weights(4), std::invalid_argument);
}

TEST(CompositionWeights, PublishedDigitsAloneAreSeen) {  // control: a change in the 26th digit
  auto weights = kahan_li_weights(8);
  weights[3] += Quad(1e-26);
  EXPECT_GT(largest_defect(weights, 1), 100 * weight_round_off);
}

TEST(CompositionWeights, IndependentConditionsAreAsManyAsThereShouldBe) {
  // hairer-lubich-wanner2006 V.3: 1, 2, 4, 8, 16 for symmetric compositions of symmetric methods.
  for (const auto& [order, count] : {std::pair{2, 1}, {4, 2}, {6, 4}, {8, 8}, {10, 16}})
    EXPECT_EQ(order_condition_words(order).size(), static_cast<std::size_t>(count));
  for (const Word& word : order_condition_words(8))
    EXPECT_LE(static_cast<double>(
                  abs(word_coefficient(suzuki_weights(4), word) - counted(suzuki_weights(4), word))),
              weight_round_off);
}

TEST(Composition, IsItsSubSteps) {
  // Three steps of the generating-function scheme of order 2 expanded at the mid-time, which is the midpoint
  // rule in the chart.
  const auto pendulum = model_named("damped-pendulum");
  const Quad h(0.1);
  const auto whole = after_steps<Quad>(*method_named("yoshida", {{"order", "4"}}), pendulum, h, 1);
  const auto base = method_named("generating-function", {{"order", "2"}, {"variant", "S"}, {"extra", "0"}});
  auto parts = testing::initial_state<Quad>(*pendulum);
  Quad t(0);
  for (const Quad& gamma : yoshida_weights(4)) {
    parts = after_steps<Quad>(*base, pendulum, gamma * h, 1, parts, t);
    t += gamma * h;
  }
  for (std::size_t k = 0; k < 2; ++k) EXPECT_LE(static_cast<double>(abs(whole[k] - parts[k])), 1e-32);
}

// Compensation that passes from sub-step to sub-step, in the chart and out of it: round-off of a long run is
// that of a few steps.
double round_off_of(const char* name, const char* system, const char* compensated, const Assignments& more) {
  Assignments parameters = more;
  parameters.emplace_back("compensated", compensated);
  const auto pendulum = model_named(system);
  const double h = 1.0 / 512;  // short enough for the implicit solve to end far below round-off
  const std::int64_t steps = 10000;
  const auto ours = after_steps<double>(*method_named(name, parameters), pendulum, h, steps);
  const auto exact = after_steps<Quad>(*method_named(name, parameters), pendulum, Quad(h), steps);
  double largest = 0;
  for (std::size_t k = 0; k < ours.size(); ++k)
    largest = std::max(largest, static_cast<double>(abs(Quad(ours[k]) - exact[k])));
  return largest;
}

TEST(Composition, HandsCompensationOn) {
  for (const char* name : {"suzuki-verlet", "suzuki"}) {
    const double kept = round_off_of(name, "pendulum", "yes", {{"order", "4"}});
    const double lost = round_off_of(name, "pendulum", "no", {{"order", "4"}});
    EXPECT_LE(kept, 0.2 * lost) << name << ' ' << kept << ' ' << lost;
  }
}

TEST(InDarbouxChart, CompensationSurvives) {
  const double kept = round_off_of("gauss-darboux", "pendulum", "yes", {{"stages", "3"}});
  const double lost = round_off_of("gauss-darboux", "pendulum", "no", {{"stages", "3"}});
  EXPECT_LE(kept, 0.2 * lost) << kept << ' ' << lost;
}

TEST(InDarbouxChart, IsTheMethodItselfInCanonicalCoordinates) {
  for (const char* name : {"kepler", "henon-heiles"}) {
    const auto system = model_named(name);
    EXPECT_EQ(after_steps<double>(*method_named("midpoint-darboux"), system, 0.05, 100),
              after_steps<double>(*method_named("implicit-midpoint"), system, 0.05, 100));
  }
}

std::int64_t iterations_of(const char* name, bool forgetting) {
  const auto pendulum = model_named("damped-pendulum");
  const auto method = method_named(name);
  Integration<double> run(start_with(*method, pendulum, {1, 0.5}, 0.02, 0.0));
  for (std::int64_t k = 0; k < 100; ++k) {
    if (forgetting) run.forget();
    run.steps(1).expect_reached();
  }
  return run.counters().iterations;
}

TEST(InDarbouxChart, HistorySavesIterations) {
  for (const char* name : {"gauss-darboux", "kahan-li", "suzuki"})
    EXPECT_LT(1.5 * static_cast<double>(iterations_of(name, false)),
              static_cast<double>(iterations_of(name, true)))
        << name;
}

TEST(InDarbouxChart, AStateChangedFromOutsideStartsAfresh) {
  const auto pendulum = model_named("damped-pendulum");
  for (const char* name : {"gauss-darboux", "kahan-li", "leap-frog"}) {
    const auto used = method_named(name)->stepper(pendulum, double()),
               fresh = method_named(name)->stepper(pendulum, double());
    std::vector<double> z{1, 0.5};
    std::int64_t completed = 0;
    used->advance(0.0, 0, 0.1, 7, z, completed);
    z[1] += 1e-3;
    std::vector<double> other = z;
    used->advance(0.0, 7, 0.1, 1, z, completed);
    fresh->advance(0.0, 7, 0.1, 1, other, completed);
    EXPECT_EQ(z, other) << name;
  }
}

TEST(InDarbouxChart, AChartOfFortyDecadesIsSolvedInEveryComponent) {
  // e^{nu t} grows to 1e43; the motion decays to 1e-22, where it must still be right.
  const auto oscillator = systems().get("damped-oscillator", "system").make({{"nu", "0.01"}});
  const auto z =
      after_steps<double>(*method_named("gauss-darboux", {{"stages", "5"}}), oscillator, 0.1, 100000);
  const Problem<double> problem(oscillator);
  std::vector<double> exact(2);
  problem.exact_solution(1e4, std::vector<double>{1, 0, 0}, exact);
  // Round-off of 1e5 steps: t itself is good to 1e-12 only, and the phase with it.
  const double size = std::hypot(exact[0], exact[1]);
  EXPECT_LT(size, 1e-21);
  EXPECT_LE(std::hypot(z[0] - exact[0], z[1] - exact[1]), 1e-10 * size);
}

TEST(InDarbouxChart, OverflowIsAStatus) {
  const auto oscillator = systems().get("damped-oscillator", "system").make({{"nu", "10"}});
  for (const char* name : {"gauss-darboux", "kahan-li"}) {
    const auto stepper = method_named(name)->stepper(oscillator, double());
    // e^{nu t} passes the largest double, 1.8e308, at t = 70.98.
    std::vector<double> z{1, 0.5}, kept = z;
    std::int64_t completed = 0, all = 0;
    EXPECT_EQ(stepper->advance(70.9, 0, 0.01, 100, z, completed), Status::non_finite) << name;
    EXPECT_GT(completed, 0) << name;
    const auto again = method_named(name)->stepper(oscillator, double());
    EXPECT_EQ(again->advance(70.9, 0, 0.01, completed, kept, all), Status::converged) << name;
    EXPECT_EQ(z, kept) << name;  // the state of the last step that was completed
  }
}

}  // namespace
}  // namespace pfaff
