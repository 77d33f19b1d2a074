// Derived equations against numbers: the definitions of the formulations in quad, the fields of models, and
// what their sizes are. Their exactness is tested in derivation_exact_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/conformance/dense_constraints.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/derive/derivation/engines.hpp>
#include <pfaff/derive/derivation/scaled.hpp>
#include <pfaff/derive/derivation/symbolic_formulas.hpp>
#include "derived.hpp"

namespace {

using namespace pfaff;
using namespace pfaff::testing;
using ::testing::HasSubstr;

// The initial state of a model, moved by up to `amplitude` in every coordinate.
std::vector<Quad> state_of(const Model& model, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad() + Quad(shift(random)));
  return z;
}

struct Constrained {
  std::string system;
  Assignments settings;
};

class DerivedEquations : public ::testing::TestWithParam<Constrained> {};

// The difference of a and b relative to the largest of b.
template <class T>
double relative_to_largest(const std::vector<T>& a, const std::vector<Quad>& b) {
  Quad largest(0), difference(0);
  for (std::size_t k = 0; k < b.size(); ++k) {
    largest = std::max(largest, abs(b[k]));
    difference = std::max(difference, abs(Quad(a[k]) - b[k]));
    if (!isfinite(a[k])) return INFINITY;
  }
  return static_cast<double>(difference / largest);
}

// On and off the surface, relative to the condition of S, by which any solution with it is uncertain.
TEST_P(DerivedEquations, AreTheFormulationsAtRandomStates) {
  const auto model = model_of(GetParam().system, GetParam().settings);
  DenseConstraints dense(*model);
  struct Method {
    const char* name;
    Reactions reactions;
  };
  for (const Method& method : {Method{"ldl", Reactions::hamiltonian}, Method{"simplified", Reactions::ideal},
                               Method{"lmm", Reactions::ideal}}) {
    const Equations equations = derive(*model, method.name, FrictionForm::none);
    for (const double amplitude : {0.0, 0.05, 0.1}) {
      const std::vector<Quad> z = state_of(*model, amplitude, 5);
      const Quad t(amplitude);
      dense.place(t, z);
      const std::vector<Quad> expected = dense.rates(method.reactions);
      std::vector<double> rounded;
      std::vector<Quad> exact;
      for (const Quad& x : z) {
        rounded.push_back(static_cast<double>(x));
        exact.emplace_back(rounded.back());
      }
      dense.place(Quad(amplitude), exact);
      const double condition = dense.condition();
      EXPECT_LT(relative_to_largest(rates_of(equations, t, z), expected) / condition, 1e-33)
          << method.name << ' ' << amplitude;
      EXPECT_LT(relative_to_largest(rates_of(equations, amplitude, rounded), dense.rates(method.reactions)) /
                    condition,
                1e-15)
          << method.name << ' ' << amplitude;
    }
  }
}

// The friction of each method is that of its formulation.
TEST_P(DerivedEquations, HaveTheFrictionOfTheFormulations) {
  const auto model = model_of(GetParam().system, GetParam().settings);
  if (model->frictionless()) return;
  DenseConstraints dense(*model);
  const std::vector<Quad> z = state_of(*model, 0.1, 6);
  dense.place(Quad(0), z);
  const std::vector<Quad> without = rates_of(derive(*model, "ldl", FrictionForm::none), Quad(0), z);
  const auto added = [&](std::vector<Quad> force) {
    std::vector<Quad> rates = without;
    for (std::size_t k = 0; k < force.size(); ++k) rates[force.size() + k] += force[k];
    return rates;
  };
  const auto metriplectic = added(dense.metriplectic_friction()), stokes = added(dense.stokes_friction());
  for (const char* method : {"ldl", "recursion", "bivector", "recursion-literal"})
    EXPECT_LT(relative_to_largest(rates_of(derive(*model, method), Quad(0), z), metriplectic), 1e-29)
        << method;
  EXPECT_LT(relative_to_largest(rates_of(derive(*model, "ldl", FrictionForm::stokes), Quad(0), z), stokes),
            1e-29);
  // The control: the two forms differ, but where the coefficients are proportional to the masses.
  if (GetParam().system == "humanoid") {
    EXPECT_GT(relative_to_largest(metriplectic, stokes), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Systems, DerivedEquations,
    ::testing::Values(Constrained{"chain-molecule", {{"beads", "5"}}},
                      Constrained{"chain-molecule",
                                  {{"beads", "4"}, {"friction", "0.3"}, {"dimension", "2"}}},
                      Constrained{"n-pendulum", {{"bobs", "4"}}}, Constrained{"ring", {{"beads", "6"}}},
                      Constrained{"four-bar", {}}, Constrained{"humanoid", {{"seed", "2"}}},
                      Constrained{"spherical-pendulum", {}}, Constrained{"torus-particle", {}},
                      Constrained{"polar-double-pendulum", {}}, Constrained{"shaken-pendulum", {}}),
    [](const auto& tested) {
      std::string name = tested.param.system + std::to_string(tested.index);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(Derivation, GivesTheFieldsOfOtherSystems) {
  struct Method {
    const char *name, *system;
  };
  for (const auto& [name, system] :
       {Method{"nonholonomic", "sleigh"}, Method{"nonholonomic", "contact-particle"},
        Method{"nonholonomic", "snakeboard"}, Method{"birkhoffian", "damped-oscillator"},
        Method{"birkhoffian", "damped-pendulum"}, Method{"birkhoffian", "lotka-volterra"},
        Method{"birkhoffian", "dense-time-structure"}, Method{"birkhoffian", "kepler"}}) {
    const auto model = model_of(system, {});
    const auto motion =
        model->nonholonomic() ? formulations().get("nonholonomic", "formulation").apply(model, {}) : model;
    const std::vector<Quad> z = state_of(*model, 0.1, 9);
    std::vector<Quad> expected(z.size());
    Replay<Quad> field(motion->tape(Formula::field));
    field(Quad(0.5), z.data(), expected.data());
    const Equations equations = derive(*model, name);
    EXPECT_TRUE(equations.tape.solves.empty()) << system;
    EXPECT_LT(relative_to_largest(rates_of(equations, Quad(0.5), z), expected), 1e-31) << system;
  }
}

// The tensor of the Dirac bracket as the engine records it, for a planar chain of three beads.
Tape bracket_tape(bool flawed) {
  const auto model =
      model_of("chain-molecule", {{"beads", "3"}, {"dimension", "2"}, {"epsilon", "0"}, {"charge", "0"}});
  const SymbolicFormulas source = symbolic_formulas(*model, false);
  const auto tapes = std::make_shared<const HolonomicTapes>(record_holonomic(source.formulas));
  const std::size_t n = 2 * source.formulas.degrees;
  Recorder recorder(static_cast<int>(n));
  const std::vector<Recorded> z = recorder.inputs();
  std::vector<Recorded> values, tensor(n * n), unit(n), column(n);
  for (const Real& x : source.values) values.emplace_back(x);
  TapedConstraints<Recorded> constraints(tapes, values);
  BracketRates<RecursiveVectorsDirac, Recorded> bracket(constraints);
  (void)bracket.place(recorder.time(), In<Recorded>(z).first(n / 2), In<Recorded>(z).subspan(n / 2));
  for (std::size_t b = 0; b < n; ++b) {
    unit.assign(n, Recorded(0));
    unit[b] = Recorded(1);
    (void)bracket.sharp(unit, column);
    for (std::size_t a = 0; a < n; ++a) tensor[a * n + b] = column[a];
  }
  if (flawed) {
    tensor[n / 2] = -tensor[n / 2];  // {q_0, p_0}
    tensor[n / 2 * n] = -tensor[n / 2 * n];
  }
  return simplified(recorder.finish(tensor));
}

// The largest component of the Jacobiator of a tensor on a tape, relative to the largest of its terms.
double jacobiator(const Tape& tensor) {
  const auto n = static_cast<std::size_t>(tensor.inputs);
  const Tape slopes_tape = jacobian_tape(tensor);
  std::vector<Quad> z, pi(n * n), slopes(n * n * n);
  for (std::size_t k = 0; k < n; ++k) z.push_back(Quad(static_cast<int>(3 * k * k % 17) - 7) / Quad(8));
  Replay<Quad>({std::shared_ptr<const Tape>(), &tensor})(Quad(0), z.data(), pi.data());
  Replay<Quad>({std::shared_ptr<const Tape>(), &slopes_tape})(Quad(0), z.data(), slopes.data());
  Quad worst(0), largest(0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        Quad sum(0);
        for (std::size_t l = 0; l < n; ++l)
          for (const Quad& term :
               {pi[i * n + l] * slopes[(j * n + k) * n + l], pi[j * n + l] * slopes[(k * n + i) * n + l],
                pi[k * n + l] * slopes[(i * n + j) * n + l]}) {
            sum += term;
            largest = std::max(largest, abs(term));
          }
        worst = std::max(worst, abs(sum));
      }
  return static_cast<double>(worst / largest);
}

TEST(Derivation, ItsBracketObeysJacobisIdentity) {
  EXPECT_LT(jacobiator(bracket_tape(false)), 1e-31);
  EXPECT_GT(jacobiator(bracket_tape(true)), 1e-3);  // the control: one component with the wrong sign
}

Assignments free_chain(int rods) {
  return {{"beads", std::to_string(rods + 1)},
          {"epsilon", "0"},
          {"charge", "0"},
          {"gravity", "9.81"},
          {"seed", "0"}};
}

TEST(Derivation, SizesOfTheChainAreLinear) {
  const auto size = [](int rods, const char* method) {
    return operations(derive(*model_of("chain-molecule", free_chain(rods)), method).tape);
  };
  for (const int rods : {12, 64, 128}) {
    EXPECT_LE(size(rods, "ldl"), 135U * static_cast<unsigned>(rods));
    EXPECT_LE(size(rods, "simplified"), 84U * static_cast<unsigned>(rods));
  }
  // Two chains are twice one to the operation, but for what their ends save.
  EXPECT_EQ(size(128, "ldl") - size(64, "ldl"), 2 * (size(64, "ldl") - size(32, "ldl")));
  // The closed inverse is full.
  EXPECT_GT(size(64, "minors"), 3 * size(64, "ldl"));
}

TEST(Derivation, KeepsTheParametersOfRodsAsSymbols) {
  const auto model = model_of("chain-molecule", free_chain(2));
  const Equations equations = derive(*model, "ldl");
  std::vector<std::string> names;
  for (const Symbol& symbol : equations.parameters) names.push_back(symbol.name);
  // Lengths are in no equation of motion.
  EXPECT_EQ(names, (std::vector<std::string>{"m0", "m1", "m2", "gz"}));
  EXPECT_EQ(equations.tape.inputs, 18 + 4);
  // Other values of the parameters give the equations of another system.
  const auto heavy = model_of("chain-molecule", [] {
    Assignments settings = free_chain(2);
    settings.emplace_back("mass", "3");
    return settings;
  }());
  Equations changed = equations;
  for (std::size_t k = 0; k < 3; ++k) changed.parameter_values[k] = 3;
  const std::vector<Quad> z = state_of(*model, 0.1, 3);
  EXPECT_LT(relative_to_largest(rates_of(changed, Quad(0), z), rates_of(derive(*heavy, "ldl"), Quad(0), z)),
            1e-31);
  EXPECT_GT(relative_to_largest(rates_of(equations, Quad(0), z), rates_of(changed, Quad(0), z)), 1e-3);
}

std::string message_of(const auto& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Derivation, SaysWhichMethodsFit) {
  const auto message = [](const char* system, const char* method) {
    const auto model = model_of(system, {});
    return message_of([&] { (void)derive(*model, method); });
  };
  EXPECT_THAT(message("humanoid", "minors"), HasSubstr("needs one chain of constraints"));
  EXPECT_THAT(message("humanoid", "minors"), HasSubstr("methods that fit: ldl, simplified, lmm, recursion"));
  EXPECT_THAT(message("kepler", "ldl"), HasSubstr("methods that fit: birkhoffian"));
  EXPECT_THAT(message("sleigh", "ldl"), HasSubstr("methods that fit: nonholonomic"));
  EXPECT_THAT(message("kepler", "nonholonomic"), HasSubstr("velocity constraints"));
  EXPECT_THAT(message("shaken-pendulum", "recursion"), HasSubstr("do not depend on time"));
  EXPECT_THAT(message("kepler", "minor"), HasSubstr("did you mean 'minors'"));
}

// A particle in space with two constraints that are one, though no expression says so.
struct Twice {
  static constexpr int dimension = 6, constraint_count = 2;
  Real factor = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[2];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - T(1);
    phi[1] = (q[0] + q[1]) * (q[0] + q[1]) + factor * (q[2] * q[2]) - 2 * q[0] * q[1];
  }
};

TEST(Derivation, NamesARedundantConstraint) {
  const SystemDescriptor descriptor{
      .name = "twice",
      .title = "twice",
      .reference = "none",
      .coordinates = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"px", "1"}, {"py", "1"}, {"pz", "1"}}};
  Twice system;
  const auto redundant = make_model(descriptor, system);
  EXPECT_THAT(message_of([&] { (void)derive(*redundant, "ldl"); }),
              HasSubstr("constraint " + redundant->source().constraint_names[1] + " is redundant"));
  system.factor = 2;  // the control: a cone through the sphere
  EXPECT_EQ(message_of([&] { (void)derive(*make_model(descriptor, system), "ldl"); }), "nothing thrown");
}

TEST(Derivation, RefusesStokesFrictionInTheRecursion) {
  const auto model = model_of("humanoid", {});
  EXPECT_EQ(message_of([&] { (void)derive(*model, "recursion"); }), "nothing thrown");
  EXPECT_THAT(message_of([&] { (void)derive(*model, "recursion", FrictionForm::stokes); }),
              HasSubstr("no friction-form stokes"));
}

// Any order in which every pivot is there gives the same equations; the positions first give none.
TEST(Derivation, TakesAnOrderOfEliminationAndSaysWhereItBreaksDown) {
  const auto model = model_of("n-pendulum", {{"bobs", "3"}});
  const std::vector<std::string> names = model->constraint_names();
  ASSERT_EQ(names.size(), 6U);
  const auto in_order = [&](const std::vector<std::size_t>& order) {
    DerivationOptions options;
    for (const std::size_t k : order) options.elimination.push_back(names[k]);
    return derive(*model, "recursion", options);
  };
  const std::vector<Quad> z = state_of(*model, 0.1, 4);
  const auto expected = rates_of(derive(*model, "recursion"), Quad(0), z);
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{4, 5, 2, 3, 0, 1}, std::vector<std::size_t>{1, 0, 3, 2, 5, 4}})
    EXPECT_LT(relative_to_largest(rates_of(in_order(order), Quad(0), z), expected), 1e-31);
  const std::string refused = message_of([&] { (void)in_order({0, 2, 4, 1, 3, 5}); });
  EXPECT_THAT(refused, HasSubstr(names[0]));
  EXPECT_THAT(refused, HasSubstr("an order that works: " + names[0] + "," + names[1] + "," + names[2]));
  EXPECT_THAT(message_of([&] {
                (void)in_order({0, 1, 2, 3});
              }),
              HasSubstr("expected all 6 constraints, got 4"));
  EXPECT_THAT(message_of([&] { (void)in_order({0, 1, 2, 3, 4, 4}); }), HasSubstr("stands there twice"));
  EXPECT_THAT(
      message_of([&] { (void)derive(*model, "recursion", DerivationOptions{.elimination = {"ph"}}); }),
      HasSubstr("unknown constraint 'ph'"));
  EXPECT_THAT(message_of([&] { (void)derive(*model, "ldl", DerivationOptions{.elimination = {"phi"}}); }),
              HasSubstr("has no order of elimination"));
}

}  // namespace
