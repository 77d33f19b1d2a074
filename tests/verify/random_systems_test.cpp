// Random systems: each kind is what it says, by measures that know nothing of how it was made.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/random_systems/recipe.hpp>
#include <pfaff/verify/residuals.hpp>

#include "../formula_values.hpp"

namespace pfaff {
namespace {

using testing::values;

constexpr std::uint64_t seeds = 4;

template <class F>
void every_recipe(F&& f) {
  for (const SystemKind kind : system_kinds)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      for (int size = 0; size < 3; ++size) {
        SCOPED_TRACE(std::string(to_string(kind)) + " seed " + std::to_string(seed) + " size " +
                     std::to_string(size));
        f(random_recipe(kind, seed, size));
      }
}

std::vector<Quad> initial(const Model& model) {
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad());
  return z;
}

TEST(RandomSystems, AreFunctionsOfTheirSeed) {
  every_recipe([](const Recipe& recipe) {
    const auto source = [&](std::uint64_t seed) {
      return text_model(system_of(random_recipe(recipe.kind, seed, 2)), {});
    };
    EXPECT_EQ(source(7), source(7));
    EXPECT_NE(source(7), source(8));
  });
}

TEST(RandomSystems, OfferWhatTheirKindSays) {
  const auto facet_of = [](SystemKind kind) {
    switch (kind) {
      case SystemKind::separable:
      case SystemKind::driven:
      case SystemKind::central:
      case SystemKind::transcendental:
      case SystemKind::breathing:
        return Facet::separable;
      case SystemKind::nonseparable:
      case SystemKind::central_nonseparable:
      case SystemKind::casimir_bracket:
        return Facet::hamiltonian;
      case SystemKind::damped:
        return Facet::conformal;
      case SystemKind::scaled_form:
      case SystemKind::sheared_form:
        return Facet::generating_map;
      case SystemKind::metriplectic:
      case SystemKind::concave_metriplectic:
        return Facet::metriplectic;
      case SystemKind::surface:
      case SystemKind::revolution:
      case SystemKind::rods:
      case SystemKind::breathing_surface:
        return Facet::holonomic;
      case SystemKind::second_class:
        return Facet::constraints;
      case SystemKind::rolling:
        return Facet::velocity_constraints;
      default:
        return Facet::vector_field;
    }
  };
  every_recipe([&](const Recipe& recipe) {
    const auto model = model_of(system_of(recipe));
    EXPECT_TRUE(model->facets().has(facet_of(recipe.kind))) << to_string(model->facets());
    EXPECT_EQ(static_cast<std::size_t>(model->dimension()), recipe.dimension);
  });
}

// Every invariant's rate along the field, at random states, against the size of its gradient and the field.
TEST(RandomSystems, ConserveTheirInvariants) {
  int measured = 0;
  every_recipe([&](const Recipe& recipe) {
    const auto model = motion_of(model_of(system_of(recipe)));
    if (model->invariants().empty()) return;
    const auto invariants = model->tape(Formula::invariants);
    const auto field = model->tape(Formula::field);
    const auto n = static_cast<std::size_t>(model->dimension());
    const auto rate = expression(static_cast<int>(n), static_cast<int>(invariants->outputs.size()),
                                 [&](const Recorded& t, Arguments z, Results out) {
                                   const auto x = evaluate(*field, t, z);
                                   const auto slopes =
                                       directional_derivative(*invariants, t, Recorded(0), z, x);
                                   std::copy(slopes.begin(), slopes.end(), out.begin());
                                 });
    Replay<Quad> replay(rate);
    std::vector<Quad> z = initial(*model), out(rate->outputs.size());
    replay(Quad(0.37), z.data(), out.data());
    for (const Quad& x : out) EXPECT_LE(static_cast<double>(abs(x)), 1e-29);
    ++measured;
  });
  EXPECT_GT(measured, 60);
}

TEST(RandomSystems, ChartsAreDarbouxAndInverted) {
  for (const SystemKind kind : {SystemKind::scaled_form, SystemKind::sheared_form})
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto model = model_of(system_of(random_recipe(kind, seed, 2)));
      SCOPED_TRACE(seed);
      EXPECT_LE(static_cast<double>(largest<Quad>(
                    darboux_residual(*model->tape(Formula::chart), *model->tape(Formula::structure)),
                    model->initial())),
                1e-30);
      const std::vector<Quad> z = initial(*model);
      const auto back =
          values(*model, Formula::chart_inverse, Quad(0.3), values(*model, Formula::chart, Quad(0.3), z));
      for (std::size_t k = 0; k < z.size(); ++k) EXPECT_LE(static_cast<double>(abs(back[k] - z[k])), 1e-31);
      // The structure depends on the state: no method keeps it that keeps constant ones only.
      EXPECT_FALSE(model->tape(Formula::structure)->state_independent());
    }
}

TEST(RandomSystems, BracketsObeyJacobi) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto model = model_of(system_of(random_recipe(SystemKind::casimir_bracket, seed, 2)));
    const Tape& tensor = *model->tape(Formula::poisson_tensor);
    EXPECT_LE(static_cast<double>(largest<Quad>(jacobiator(tensor, 3), model->initial())), 1e-30);
    EXPECT_LE(static_cast<double>(largest<Quad>(sharp_of_casimirs(tensor, *model->tape(Formula::casimirs)),
                                                model->initial())),
              1e-30);
    // Control: with one entry changed the identity fails.
    const auto wrong = expression(3, 9, [&](const Recorded& t, Arguments z, Results out) {
      const auto entries = evaluate(tensor, t, z);
      std::copy(entries.begin(), entries.end(), out.begin());
      out[1] = out[1] + z[0] * z[0];
      out[3] = out[3] - z[0] * z[0];
    });
    EXPECT_GT(static_cast<double>(largest<Quad>(jacobiator(*wrong, 3), model->initial())), 1e-6);
  }
}

// By the measures of verification, and S by its second differences in random directions: that of one kind is
// concave everywhere, and that of the other is not.
TEST(RandomSystems, EntropiesRiseAndAreConcaveOrNot) {
  for (const SystemKind kind : {SystemKind::metriplectic, SystemKind::concave_metriplectic})
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      for (int size = 0; size < 3; ++size) {
        SCOPED_TRACE(std::string(to_string(kind)) + " seed " + std::to_string(seed) + " size " +
                     std::to_string(size));
        const auto model = model_of(system_of(random_recipe(kind, seed, size)));
        for (const Check& check : check_metriplectic("random", *model))
          EXPECT_TRUE(good(check)) << check.claim;
        const auto entropy = [&](const std::vector<double>& d, double share) {
          std::vector<Quad> z = initial(*model);
          for (std::size_t k = 0; k < z.size(); ++k) z[k] += Quad(share * d[k]);
          return static_cast<double>(values(*model, Formula::entropy, Quad(0), z).front());
        };
        std::mt19937 random(1);
        std::uniform_real_distribution<double> any(-1, 1);
        int concave = 0;
        for (int k = 0; k < 20; ++k) {
          const std::vector<double> d{any(random), any(random), any(random)};
          concave += entropy(d, 1) - 2 * entropy(d, 0) + entropy(d, -1) < 0 ? 1 : 0;
        }
        EXPECT_EQ(concave == 20, kind == SystemKind::concave_metriplectic);
      }
}

TEST(RandomSystems, StartOnTheirConstraints) {
  int restricted = 0;
  every_recipe([&](const Recipe& recipe) {
    const auto model = model_of(system_of(recipe));
    if (!model->restricted()) return;
    ++restricted;
    for (const Quad& x : values(*model, Formula::constraints, Quad(0), initial(*model)))
      EXPECT_LE(static_cast<double>(abs(x)), 1e-32);
    // Control: a state beside it is not on them.
    std::vector<Quad> beside = initial(*model);
    for (Quad& x : beside) x += Quad(0.01);
    Quad worst(0);
    for (const Quad& x : values(*model, Formula::constraints, Quad(0), beside))
      worst = std::max(worst, abs(x));
    EXPECT_GT(static_cast<double>(worst), 1e-6);
  });
  EXPECT_EQ(restricted, 6 * static_cast<int>(seeds) * 3);
}

TEST(RandomSystems, SimplerRecipesAreSimplerAndOfTheirKind) {
  every_recipe([](const Recipe& recipe) {
    const auto offered = model_of(system_of(recipe))->facets();
    const auto list = simpler(recipe);
    EXPECT_FALSE(list.empty());
    for (std::size_t k = 0; k < list.size(); k += 7) {
      EXPECT_LT(complexity(list[k]), complexity(recipe));
      const auto model = model_of(system_of(list[k]));
      EXPECT_EQ(static_cast<std::size_t>(model->dimension()), list[k].dimension);
      EXPECT_TRUE(model->facets().includes(offered.without(Facet::invariants).without(Facet::darboux_chart)));
    }
  });
}

// V of the model and V as written, for every function, at one point: what an author reads is the formula that
// methods run on.
TEST(RandomSystems, FunctionsAreEvaluatedAndWritten) {
  const std::array<const char*, 4> written{"sin(q)", "exp(q)", "sqrt(1 + q^2)", "(1/(1 + q^2))"};
  const double x = 0.7;
  const std::array<double, 4> expected{std::sin(x), std::exp(x), std::sqrt(1 + x * x), 1 / (1 + x * x)};
  for (std::size_t k = 0; k < all_functions.size(); ++k) {
    Recipe recipe;
    recipe.kind = SystemKind::transcendental;
    recipe.state = {Real::parse("0.7").value(), 1};
    const auto f = SparsePolynomial::variable(2, 1);
    recipe.parts = {{detail::half_square(1, 0, 1)}, {Real(3) * f * SparsePolynomial::variable(2, 0)}};
    recipe.applied = {{}, {{all_functions[k], 0}}};
    const PolynomialSystem system = system_of(recipe);
    const auto model = model_of(system);
    const auto potential =
        static_cast<double>(values(*model, Formula::potential, Quad(0), {Quad(x)}).front());
    EXPECT_NEAR(potential, 3 * x * expected[k], 1e-15);
    EXPECT_NEAR(static_cast<double>(values(*model, Formula::invariants, Quad(0), {Quad(x), Quad(2)}).front()),
                3 * x * expected[k] + 2, 1e-15);
    EXPECT_FALSE(system.invariants.front().quadratic);
    EXPECT_NE(text_model(system, {}).find(std::string("3*q*") + written[k]), std::string::npos)
        << text_model(system, {});
  }
}

// A reversal is offered where T(-p) = T(p), and not where a function spoils that.
TEST(RandomSystems, FunctionsOfMomentaDecideAboutReversals) {
  for (const Function function : all_functions) {
    Recipe recipe;
    recipe.kind = SystemKind::transcendental;
    recipe.state = {1, 1};
    recipe.parts = {{detail::half_square(2, 0, 1) + SparsePolynomial::variable(2, 1)},
                    {detail::half_square(1, 0, 1)}};
    recipe.applied = {{{function, 0}}, {}};
    EXPECT_EQ(system_of(recipe).formulas.contains(Formula::reversal),
              function == Function::root || function == Function::bell);
  }
}

// At time 0 the constraints are what they were; later they have moved.
TEST(RandomSystems, ConstraintsAreSetInMotion) {
  for (const SystemKind kind : {SystemKind::surface, SystemKind::rods, SystemKind::second_class}) {
    const PolynomialSystem system = system_of(random_recipe(kind, 1, 1));
    const auto still = model_of(system), moving = model_of(with_moving_constraints(system, 1));
    const Formula formula = kind == SystemKind::second_class ? Formula::constraints : Formula::holonomic;
    std::vector<Quad> z = initial(*still);
    if (formula == Formula::holonomic) z.resize(z.size() / 2);
    EXPECT_EQ(values(*moving, formula, Quad(0), z), values(*still, formula, Quad(0), z));
    EXPECT_NE(values(*moving, formula, Quad(1), z), values(*still, formula, Quad(1), z));
    EXPECT_TRUE(still->tape(Formula::constraints)->autonomous());
    EXPECT_FALSE(moving->tape(Formula::constraints)->autonomous());
  }
}

// Kinetic energies of two kinds depend on time, and those of no other.
TEST(RandomSystems, KineticEnergiesBreathe) {
  int timed = 0;
  every_recipe([&](const Recipe& recipe) {
    const auto model = model_of(system_of(recipe));
    if (!model->given(Formula::kinetic)) return;
    const bool breathes =
        recipe.kind == SystemKind::breathing || recipe.kind == SystemKind::breathing_surface;
    EXPECT_EQ(model->tape(Formula::velocity)->autonomous(), !breathes);
    timed += breathes ? 1 : 0;
  });
  EXPECT_EQ(timed, 2 * static_cast<int>(seeds) * 3);
}

TEST(RandomSystems, PolynomialsAreDifferentiatedAndComposed) {
  const auto x = SparsePolynomial::variable(2, 0), y = SparsePolynomial::variable(2, 1),
             t = SparsePolynomial::variable(2, 2);
  const SparsePolynomial p = x * x * y - Real::fraction(1, 3) * t * y;
  EXPECT_EQ(p.derivative(0), Real(2) * x * y);
  EXPECT_EQ(p.derivative(2), Real::fraction(-1, 3) * y);
  EXPECT_EQ(p.at({y, x + t}), y * y * (x + t) - Real::fraction(1, 3) * t * (x + t));
  EXPECT_TRUE(p.exactly(3, {2, 5}) == Real(15));
  EXPECT_TRUE((p - p).zero());
  EXPECT_EQ(p.degree(), 3);
  const auto name = [](std::size_t k) { return std::string(1, "xyt"[k]); };
  EXPECT_EQ(p.text(name), "-y*t/3 + x^2*y");
  EXPECT_EQ((p - p).text(name), "0");
  EXPECT_EQ(SparsePolynomial::constant(2, Real::fraction(2, 3)).text(name), "2/3");
}

}  // namespace
}  // namespace pfaff
