// Tuned splittings: their logarithms and shadow terms against other mathematics, and what they gain.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/derive/tuning/tuned_splitting.hpp>

#include "splittings.hpp"

namespace pfaff::testing {
namespace {

// The logarithm of Strang's splitting is A + B - [A, [A, B]]/24 + [[A, B], B]/12 + ... in this order of the
// flows, and the words A A B and A B B are Lyndon's.
TEST(Tuning, LogarithmOfStrangsSplitting) {
  const SplittingLogarithm logarithm(2);
  const auto found = logarithm.of(strang());
  for (const double x : found.conditions) EXPECT_EQ(x, 0);
  ASSERT_EQ(found.brackets.size(), 2U + 6U);
  EXPECT_NEAR(found.brackets[0], -1.0 / 24, 1e-16);
  EXPECT_NEAR(std::abs(found.brackets[1]), 1.0 / 12, 1e-16);
}

// On the oscillator with H = (q^2 + p^2)/2 a step of Strang's splitting that begins with a drift is the flow
// of the shadow energy (c p^2 + q^2/c) a/(2 h) with cos a = 1 - h^2/2 and c = sqrt(1 - h^2/4). Its field
// differs from that of H by c a/h - 1 in q' and a/(c h) - 1 in p'.
TEST(Tuning, ShadowTermsOfTheOscillatorAreKnown) {
  const auto model = system("harmonic-oscillator");
  const SplittingLogarithm logarithm(2);
  const double h = 0.2;
  // Positions and momenta are of one size on these states, so that all count alike.
  const ShadowTerms terms(*model, logarithm, h, {{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const double angle = std::acos(1 - h * h / 2), c = std::sqrt(1 - h * h / 4);
  const double exact = std::hypot(c * angle / h - 1, angle / (c * h) - 1) / std::sqrt(2.0);
  std::vector<double> brackets = logarithm.of(strang()).brackets;
  // What is left out is of order h^6, with a factor below 1/50.
  const double left_out = std::pow(h, 6) / 50;
  EXPECT_NEAR(terms.of(brackets), exact, left_out);
  // The control: without the brackets of degree 5 the difference is larger.
  std::fill(brackets.begin() + 2, brackets.end(), 0);
  EXPECT_GT(std::abs(terms.of(brackets) - exact), left_out);
}

// The error of one step from a state is h times the shadow's field there, to leading order; the norm is that
// of the form at a single state.
TEST(Tuning, ShadowTermsAreTheErrorOfAStep) {
  for (const char* name : {"henon-heiles", "pendulum", "quadrupole-boson"}) {
    const auto model = system(name);
    std::vector<Quad> z;
    std::vector<double> state;
    for (const Real& x : model->initial()) {
      z.push_back(x.quad() + Quad(0.05));
      state.push_back(static_cast<double>(z.back()));
    }
    const SplittingLogarithm logarithm(4);
    const double h = 1.0 / 64;
    const ShadowTerms terms(*model, logarithm, h, {state});
    const double form = terms.of(logarithm.of(triple_jump()).brackets);
    // A step of the flow, by so many small ones that their error is nothing beside it.
    std::vector<Quad> exact = z;
    constexpr int parts = 64;
    for (int k = 0; k < parts; ++k) exact = step(*model, triple_jump(), Quad(h) / Quad(parts), exact);
    const std::vector<Quad> one = step(*model, triple_jump(), Quad(h), z);
    std::vector<double> rate(z.size());
    Problem<double>(model).field(0, state, rate);
    double error = 0, own = 0, positions = 0, momenta = 0;
    const std::size_t half = z.size() / 2;
    for (std::size_t i = 0; i < z.size(); ++i) (i < half ? positions : momenta) += state[i] * state[i];
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double weight = i < half ? 1 / positions : 1 / momenta;
      const auto off = static_cast<double>(one[i] - exact[i]) / h;
      error += weight * off * off;
      own += weight * rate[i] * rate[i];
    }
    // To leading order in h: the step's error and its field differ by a term of order h.
    EXPECT_NEAR(std::sqrt(error / own) / form, 1, 0.1) << name;
  }
}

TEST(Tuning, ConditionsHoldToRoundOffOfQuadAndTermsAreSmaller) {
  const auto model = system("henon-heiles");
  const SplittingLogarithm logarithm(4);
  const ShadowTerms terms(*model, logarithm, 0.6, states_along_the_motion(model, 50));
  const TunedSplitting tuned = tuned_splitting(logarithm, terms, {.order = 4, .stages = 5, .starts = 8});
  EXPECT_EQ(tuned.flows.size(), 11U);
  EXPECT_EQ(first_violated(splitting_conditions(tuned.flows, 4), 4, precision_of_quad_coefficients), nullptr);
  EXPECT_NE(first_violated(splitting_conditions(tuned.flows, 5), 5, precision_of_quad_coefficients), nullptr);
  for (std::size_t k = 0; k < tuned.flows.size(); ++k)
    EXPECT_EQ(tuned.flows[k].length, tuned.flows[tuned.flows.size() - 1 - k].length);
  EXPECT_EQ(tuned.error, terms.of(logarithm.of(tuned.flows).brackets));
  // Suzuki's five steps of Strang's splitting have as many forces.
  const Quad outer = Quad(1) / (Quad(4) - pow(Quad(4), Real::fraction(1, 3))),
             inner = Quad(1) - Quad(4) * outer;
  std::vector<PartialFlow> suzuki;
  for (const Quad& part : {outer, outer, inner, outer, outer})
    suzuki.insert(suzuki.end(), {{0, part / Quad(2)}, {1, part}, {0, part / Quad(2)}});
  EXPECT_LT(tuned.error, terms.of(logarithm.of(suzuki).brackets) / 10);
  // The same seed gives the same splitting.
  EXPECT_EQ(tuned_splitting(logarithm, terms, {.order = 4, .stages = 5, .starts = 8}).flows[0].length,
            tuned.flows[0].length);
}

// Of degrees 1, 3 and 5 there are 2, 2 and 6 conditions, of which two of degree 5 are about brackets that
// vanish for quadratic kinetic energies.
TEST(Tuning, QuadraticKineticEnergiesNeedFewerConditions) {
  const auto conditions = [](Parts parts) {
    return SplittingLogarithm(6, Degrees::odd, parts).of(triple_jump()).conditions;
  };
  const auto general = conditions(Parts::general), quadratic = conditions(Parts::quadratic_kinetic);
  EXPECT_EQ(general.size(), 10U);
  ASSERT_EQ(quadratic.size(), 8U);
  // They are those that tables are checked by.
  std::vector<double> expected;
  for (const OrderCondition& condition : splitting_conditions(triple_jump(), 6, Parts::quadratic_kinetic))
    if (condition.order % 2 == 1) expected.push_back(static_cast<double>(condition.residual));
  ASSERT_EQ(expected.size(), quadratic.size());
  double largest = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(quadratic[k], expected[k], 1e-14);
    largest = std::max(largest, std::abs(expected[k]));
  }
  EXPECT_GT(largest, 1e-3);  // the jump is of order 4
}

TEST(Tuning, OrderSixForQuadraticKineticEnergiesAlone) {
  const auto model = system("pendulum");
  const SplittingLogarithm logarithm(6, Degrees::odd, Parts::quadratic_kinetic);
  const ShadowTerms terms(*model, logarithm, 0.8, states_along_the_motion(model, 200));
  // Three starts of sixty lead to a method of order 6, that of this seed among them.
  const TunedSplitting tuned =
      tuned_splitting(logarithm, terms,
                      {.order = 6, .stages = 11, .parts = Parts::quadratic_kinetic, .seed = 3, .starts = 1});
  EXPECT_EQ(tuned.flows.size(), 23U);
  const auto violated = [&](Parts parts) {
    const auto conditions = splitting_conditions(tuned.flows, 6, parts);
    return first_violated(conditions, 6, precision_of_quad_coefficients) != nullptr;
  };
  EXPECT_FALSE(violated(Parts::quadratic_kinetic));
  EXPECT_TRUE(violated(Parts::general));  // the control: two conditions are left out
  EXPECT_NE(splitting_table(tuned, "tuned", 6, "pendulum").find("kind = \"rkn-splitting\""),
            std::string::npos);
}

TEST(Tuning, Refusals) {
  EXPECT_EQ(free_coefficients({.order = 4, .stages = 4}), 1);
  EXPECT_EQ(free_coefficients({.order = 4, .stages = 3}), 0);
  EXPECT_EQ(free_coefficients({.order = 6, .stages = 10}), 1);
  EXPECT_EQ(free_coefficients({.order = 6, .stages = 8, .parts = Parts::quadratic_kinetic}), 1);
  EXPECT_NO_THROW(check({.order = 4, .stages = 4}));
  EXPECT_THROW(check({.order = 4, .stages = 3}), InputError);
  EXPECT_THROW(check({.order = 3, .stages = 6}), InputError);
  EXPECT_THROW(check({.order = 8, .stages = 40}), InputError);
  for (const char* name : {"free-rigid-body", "spherical-pendulum"})
    EXPECT_THROW((void)states_along_the_motion(system(name), 3), InputError) << name;
}

}  // namespace
}  // namespace pfaff::testing
