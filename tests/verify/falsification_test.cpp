// The search for counterexamples: false claims are found and shrunk, true ones hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/way_back.hpp>
#include <pfaff/verify/falsification/drawn_parameters.hpp>
#include <pfaff/verify/falsification/falsify.hpp>
#include <pfaff/verify/falsification/judgement.hpp>
#include <pfaff/verify/falsification/many_steps.hpp>
#include <pfaff/verify/measured_step.hpp>
#include <pfaff/verify/random_checks.hpp>

#include "../built.hpp"

namespace pfaff {
namespace {

const MethodPlugin& method_plugin(const std::string& name) {
  if ((name.starts_with("false-") || name.starts_with("noisy-")) && integrators().find(name) == nullptr)
    load_plugin(testing::test_plugin("false-claims"));
  return integrators().get(name, "integrator");
}

// Ends after so many systems, and so with the same result on every machine.
FalsificationResult result_of(const std::string& name, Claim claim, std::uint64_t systems = 200,
                              double budget = 300) {
  auto tests = claims_under_test(method_plugin(name), {}, claim);
  return falsify({tests.front()}, {.seed = 1, .budget = budget, .systems = systems}, nullptr).front();
}

Counterexample found(const std::string& name, Claim claim) {
  FalsificationResult result = result_of(name, claim);
  if (!result.counterexample)
    throw std::runtime_error(name + " keeps " + std::string(to_string(claim)) + " on " +
                             std::to_string(result.tried) + " systems");
  return std::move(*result.counterexample);
}

std::size_t terms_of(const Recipe& recipe) {
  std::size_t count = 0;
  for (const auto& part : recipe.parts)
    for (const SparsePolynomial& p : part) count += p.terms().size();
  return count;
}

// True where every gradient of the constraints is constant.
bool linear_constraints(const PolynomialSystem& system) {
  for (const SparsePolynomial& phi : system.formulas.at(Formula::holonomic))
    if (phi.degree() > 1) return false;
  return true;
}

int energy_degree(const PolynomialSystem& system) {
  int degree = 0;
  for (const Formula f : {Formula::kinetic, Formula::potential, Formula::hamiltonian})
    if (system.formulas.contains(f)) degree = std::max(degree, system.formulas.at(f).front().degree());
  return degree;
}

TEST(Falsify, RungeKuttaIsNotSymplectic) {
  const Counterexample counterexample = found("rk4", Claim::symplectic);
  EXPECT_EQ(counterexample.recipe.dimension, 2U);
  EXPECT_LE(terms_of(counterexample.recipe), 2U);  // nothing moves symplectically wrong with one energy alone
  EXPECT_GE(counterexample.judgement.exponent, 4);
}

TEST(Falsify, SinglyDiagonalMethodNeedsANonlinearSystem) {
  const Counterexample counterexample = found("false-singly-diagonal", Claim::symplectic);
  EXPECT_GE(energy_degree(system_of(counterexample.recipe)), 3);
  EXPECT_EQ(counterexample.recipe.dimension, 2U);
  EXPECT_LE(terms_of(counterexample.recipe), 2U);
}

// The control of the above: on linear systems the false claim holds, so that a search which draws none but
// these would not find it.
TEST(Falsify, SinglyDiagonalMethodIsSymplecticOnLinearSystems) {
  const auto instance = method_plugin("false-singly-diagonal").make({});
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  const Judgement judgement =
      judge(*instance, Claim::symplectic, {model, model->initial(), 0, Real::fraction(1, 2)});
  EXPECT_FALSE(judgement.falsified);
  EXPECT_LE(judgement.residuals.front(), 1e-31);
}

TEST(Falsify, ProjectionNeedsACurvedSurface) {
  const Counterexample counterexample = found("false-projection", Claim::constrained_symplectic);
  EXPECT_FALSE(linear_constraints(system_of(counterexample.recipe)));
  EXPECT_EQ(counterexample.recipe.dimension, 4U);
}

TEST(Falsify, MidpointRuleNeedsAStructureThatVaries) {
  const Counterexample counterexample = found("false-midpoint", Claim::k_symplectic);
  EXPECT_FALSE(counterexample.at.model->tape(Formula::structure)->state_independent() &&
               counterexample.at.model->tape(Formula::structure)->autonomous());
}

TEST(Falsify, LeapFrogIsNeitherSymmetricNorKeepsEnergies) {
  EXPECT_LE(found("false-leap-frog", Claim::symmetric).recipe.dimension, 2U);
  EXPECT_EQ(found("false-leap-frog", Claim::energy).recipe.dimension, 2U);
}

// Of random systems some run off to infinity before a long run ends, from their initial state too. They are
// passed over, and the search goes on.
TEST(Falsify, MotionsThatEndAreNoCounterexamples) {
  const FalsificationResult result = result_of("gauss", Claim::unbiased_round_off, 6);
  EXPECT_FALSE(result.counterexample);
  EXPECT_EQ(result.tried, 6);
}

// Among polynomials up to degree eight the false claim holds.
TEST(Falsify, AveragedRatesNeedAFunctionThatIsNoPolynomial) {
  const Counterexample counterexample = found("false-averaged", Claim::energy);
  EXPECT_EQ(counterexample.recipe.kind, SystemKind::transcendental);
  EXPECT_EQ(counterexample.recipe.dimension, 2U);
  EXPECT_LE(terms_of(counterexample.recipe), 3U);
}

// The method keeps its claim with the parameters that it is verified with, and not with others.
TEST(Falsify, ParametersAreDrawn) {
  const auto tests = claims_under_test(method_plugin("false-with-parameters"), {}, {});
  ASSERT_EQ(tests.size(), 3U);
  EXPECT_TRUE(tests.front().parameters.empty());
  const auto results = falsify(tests, {.seed = 1, .budget = 300, .systems = 20}, nullptr);
  EXPECT_FALSE(results[0].counterexample);
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_NE(results[k].test.parameters, (Assignments{{"wrong", "0"}}));
    EXPECT_TRUE(results[k].counterexample) << k;
  }
}

TEST(Falsify, DrawnParametersAreAccepted) {
  int drawn = 0;
  for (const MethodPlugin* plugin : integrators().all()) {
    const auto instances = plugin->instances(false);
    const auto list = drawn_parameters(*plugin, instances, 7, 3);
    EXPECT_EQ(list, drawn_parameters(*plugin, instances, 7, 3)) << plugin->name();
    for (const Assignments& settings : list) {
      EXPECT_NO_THROW((void)plugin->make(settings)) << plugin->name();
      EXPECT_EQ(std::find(instances.begin(), instances.end(), settings), instances.end());
      ++drawn;
    }
  }
  EXPECT_GT(drawn, 20);
}

// The first step is symmetric, so that no single step shows what the later ones do.
TEST(Falsify, ParasiticOscillationShowsInSeveralSteps) {
  const Counterexample counterexample = found("false-two-step", Claim::symmetric);
  EXPECT_GT(counterexample.at.count, 1);
  JudgedStep one = counterexample.at;
  one.count = 1;
  const auto instance = method_plugin("false-two-step").make({});
  const Judgement single = judge(*instance, Claim::symmetric, one);
  EXPECT_FALSE(single.falsified);
  EXPECT_LE(single.residuals.front(), 1e-31);
}

// GNI carries a reaction from its second step on, with which steps back undo steps; without it they do not,
// and were once taken for a counterexample.
TEST(Falsify, WhatAMethodCarriesGoesBackWithTheState) {
  const auto particle = systems().get("contact-particle", "system").make({});
  for (const char* name : {"gni", "nonholonomic-leap-frog"}) {
    const auto instance = method_plugin(name).make({});
    const JudgedStep two{.model = particle, .state = particle->initial(), .count = 2};
    EXPECT_FALSE(judge(*instance, Claim::symmetric, two).falsified) << name;
    const ManySteps many(*instance, 2);
    const Real length = Real::fraction(1, 5);
    MeasuredStep<Quad> step(many, particle, particle->initial(), 0, length, 0, true);
    const auto there = step.end();
    ASSERT_TRUE(there) << name;
    const auto back = WayBack<Quad>()(*step.at_end(), 1), fresh = step.after(step.h(), -step.h(), *there);
    ASSERT_TRUE(back && fresh) << name;
    EXPECT_LE(static_cast<double>(step.distance(*back, step.start())), 1e-31) << name;
    EXPECT_GT(static_cast<double>(step.distance(*fresh, step.start())), 1e-9) << name;  // control
  }
}

// Several steps as one: of a method of one step they are that method's, and they keep what it keeps.
TEST(Falsify, ManyStepsAreThoseOfTheMethod) {
  const auto instance = method_plugin("verlet").make({});
  const auto model = systems().get("pendulum", "system").make({});
  const ManySteps many(*instance, 4);
  const std::vector<Quad> start{Quad(1), Quad(0.5)};
  Integration<Quad> one(start_with(*instance, model, start, Quad(0.25), Quad(0)));
  Integration<Quad> other(start_with<Quad>(many, model, start, Quad(1), Quad(0)));
  one.steps(8).expect_reached();
  const Outcome outcome = other.steps(2);
  EXPECT_EQ(outcome.status(), Status::converged);
  EXPECT_EQ(outcome.steps(), 2);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(one.state()[k], other.state()[k]);
}

TEST(Falsify, EveryClaimIsFalsifiedOfAMethodThatKeepsNothing) {
  for (const Claim claim : {Claim::k_symplectic, Claim::poisson, Claim::conformal, Claim::volume,
                            Claim::reversible, Claim::quadratic_invariants, Claim::momentum_maps,
                            Claim::casimirs, Claim::constrained_symplectic, Claim::constraints}) {
    const Counterexample counterexample = found("rk4", claim);
    EXPECT_LE(terms_of(counterexample.recipe), 8U) << to_string(claim);
  }
}

TEST(Falsify, TrueClaimsHold) {
  for (const auto& [name, claim] :
       {std::pair{"verlet", Claim::symplectic}, std::pair{"verlet", Claim::symmetric},
        std::pair{"gauss", Claim::quadratic_invariants}, std::pair{"rattle", Claim::constrained_symplectic},
        std::pair{"conformal-splitting", Claim::conformal}, std::pair{"gauss-darboux", Claim::k_symplectic},
        std::pair{"generating-function-alpha", Claim::k_symplectic}}) {
    const FalsificationResult result = result_of(name, claim, 30);
    EXPECT_FALSE(result.counterexample) << name << ' ' << to_string(claim);
    EXPECT_GE(result.tried, 20) << name << ' ' << to_string(claim);
  }
}

TEST(Falsify, ResultsDoNotDependOnTheBudget) {
  const FalsificationResult shorter = result_of("rk4", Claim::volume, 200, 1),
                            longer = result_of("rk4", Claim::volume, 300, 60);
  ASSERT_TRUE(shorter.counterexample && longer.counterexample);
  EXPECT_EQ(model_text_of(shorter.test, *shorter.counterexample, {}),
            model_text_of(longer.test, *longer.counterexample, {}));
}

// Shrinking ends where nothing simpler fails: every simpler recipe of what is found keeps the claim.
TEST(Falsify, CounterexamplesAreMinimal) {
  const FalsificationResult result = result_of("rk4", Claim::symplectic);
  ASSERT_TRUE(result.counterexample);
  const Counterexample again = shrink(result.test, *result.counterexample);
  EXPECT_EQ(complexity(again.recipe), complexity(result.counterexample->recipe));
}

// The random systems of a verification reject the false claims, and nothing that is true.
TEST(Falsify, VerificationOnRandomSystemsRejectsFalseClaims) {
  const auto failed = [](const MethodPlugin& plugin) {
    std::set<std::string> claims;
    for (const Check& check : check_on_random_systems(*plugin.make({}), {}))
      if (!good(check)) claims.insert(check.claim);
    return claims;
  };
  using Claims = std::set<std::string>;
  EXPECT_EQ(failed(method_plugin("false-singly-diagonal")), (Claims{"symplectic"}));
  EXPECT_EQ(failed(method_plugin("false-projection")), (Claims{"constrained-symplectic"}));
  EXPECT_EQ(failed(method_plugin("false-midpoint")), (Claims{"K-symplectic"}));
  EXPECT_EQ(failed(method_plugin("false-leap-frog")), (Claims{"energy", "symmetric"}));
  // Its entropy rises where it is convex, as that of every registered system is.
  EXPECT_EQ(
      failed(*read_method_table(PFAFF_GOLDEN "/../verification/corpus/unseen/false/entropic_euler.toml")),
      (Claims{"entropy"}));
  for (const char* name : {"verlet", "rattle", "midpoint-darboux"})
    EXPECT_EQ(failed(method_plugin(name)), Claims{}) << name;
}

TEST(Falsify, RoundingIsNoFalsification) {
  const auto instance = method_plugin("gauss").make({});
  const auto model = systems().get("henon-heiles", "system").make({});
  const Judgement judgement =
      judge(*instance, Claim::symplectic, {model, model->initial(), 0, Real::fraction(1, 10)});
  EXPECT_FALSE(judgement.falsified);
  EXPECT_EQ(judgement.reason, "the residual is that of rounding");
  EXPECT_GT(judgement.in_double, 0);
}

// What long runs show falsifies a claim about rounding, and is no residual of the step that is given.
TEST(Falsify, PlainUpdatesAreSeenInLongRuns) {
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  const JudgedStep at{model, model->initial(), 0, Real::fraction(1, 10)};
  const auto judged = [&](const Assignments& parameters) {
    return judge(*method_plugin("gauss").make(parameters), Claim::unbiased_round_off, at);
  };
  const Judgement plain = judged({{"compensated", "no"}});
  EXPECT_TRUE(plain.falsified);
  EXPECT_EQ(plain.residuals.size(), 1U);
  EXPECT_GT(plain.in_double, 1);
  const Judgement compensated = judged({});
  EXPECT_FALSE(compensated.falsified);
  EXPECT_EQ(compensated.reason, "the rounding is a random walk");
}

// An error as large as double's rounding is above the threshold in quad, and is no power of the step.
TEST(Falsify, NoiseIsNoFalsification) {
  const auto instance = method_plugin("noisy-midpoint").make({});
  const auto model = systems().get("pendulum", "system").make({});
  const Judgement judgement =
      judge(*instance, Claim::symmetric, {model, model->initial(), 0, Real::fraction(1, 10)});
  EXPECT_GT(judgement.residuals.front(), falsifying_residual(*instance, Claim::symmetric));
  EXPECT_FALSE(judgement.falsified);
  EXPECT_EQ(judgement.reason, "the residual is no power of the step size");
  const FalsificationResult result = result_of("noisy-midpoint", Claim::symmetric, 100);
  EXPECT_FALSE(result.counterexample);
  EXPECT_GT(result.tried, 50);
}

// The commands that are printed with a counterexample are pasted into a shell.
TEST(Falsify, WordsOfCommandsAreQuotedForTheShell) {
  for (const char* plain : {"stages=2", "./plugins/my_method-2.so", "nu=1/3,+0.5", "a:b"})
    EXPECT_EQ(shell_word(plain), plain);
  EXPECT_EQ(shell_word("base=rattle(order=4, h=1)"), "'base=rattle(order=4, h=1)'");
  for (const std::string special : {" ", "$", "&", ";", "<", ">", "*", "`", "\\", "\"", "|", "~", "#", "\n"})
    EXPECT_EQ(shell_word("a" + special), "'a" + special + "'");
  EXPECT_EQ(shell_word("it's"), R"('it'\''s')");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace pfaff
