// Systems written as text: those of examples/models against the same systems written in C++, in double and
// in quad, and all of them by the checks of every system.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include <pfaff/runs/motion.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check.hpp>

#include "../formula_values.hpp"
#include "../temporary_directory.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::evaluated;
namespace fs = std::filesystem;
using enum Formula;

fs::path examples() { return fs::path(PFAFF_GOLDEN) / "../../examples/models"; }
std::shared_ptr<const Model> text_model(const std::string& name, const Assignments& set = {}) {
  return system_named((examples() / (name + ".toml")).string()).make(set);
}

// The largest difference of a formula's results, relative to their size, at random states of order one.
template <class T>
double formula_difference(const std::shared_ptr<const Model>& a, const std::shared_ptr<const Model>& b,
                          Formula f) {
  const auto first = make_evaluator<T>(a, f), second = make_evaluator<T>(b, f);
  const std::size_t inputs = 2 * static_cast<std::size_t>(a->dimension()) + 1;  // as many as alpha reads
  const std::size_t outputs = inputs * inputs;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(0.3, 1.3);
  double worst = 0;
  for (int k = 0; k < 5; ++k) {
    std::vector<T> z(inputs), x(outputs, T(0)), y(outputs, T(0));
    for (T& c : z) c = T(number(random));
    const T t(number(random));
    first.call(first.context, t, z.data(), x.data());
    second.call(second.context, t, z.data(), y.data());
    bool some = false;
    for (std::size_t i = 0; i < outputs; ++i) {
      some = some || static_cast<double>(y[i]) != 0;
      worst = std::max(
          worst, static_cast<double>(abs(x[i] - y[i])) / std::max(1.0, std::abs(static_cast<double>(y[i]))));
    }
    EXPECT_TRUE(some) << to_string(f);
  }
  return worst;
}

void expect_twins(const std::string& name, const std::string& system, std::initializer_list<Formula> formulas,
                  const Assignments& set = {}, const Assignments& set_twin = {}) {
  const auto text = text_model(name, set), twin = systems().get(system, "system").make(set_twin);
  for (const Formula f : formulas) {
    const auto a = f == field ? motion_of(text) : text, b = f == field ? motion_of(twin) : twin;
    // Other orders of operations in a handful of terms, and the linear solves of formulations.
    EXPECT_LT(formula_difference<double>(a, b, f), 2e-13) << name << " " << to_string(f);
    EXPECT_LT(formula_difference<Quad>(a, b, f), 1e-30) << name << " " << to_string(f);
  }
}

TEST(TextModels, AgreeWithTheirTwins) {
  expect_twins("henon-heiles", "henon-heiles", {field, force, velocity, hamiltonian, reversal, invariants});
  expect_twins("henon-heiles", "henon-heiles", {field}, {{"lambda", "0.7"}}, {{"lambda", "7/10"}});
  expect_twins(
      "damped-pendulum", "damped-pendulum",
      {field, structure, covector, chart, chart_inverse, chart_field, chart_hamiltonian, alpha, invariants});
  expect_twins("lagrangian-pendulum", "pendulum", {field, kinetic, potential}, {{"omega", "1.5"}},
               {{"omega", "1.5"}});
  expect_twins("double-pendulum", "n-pendulum-angles", {field, hamiltonian, reversal}, {{"n", "3"}},
               {{"bobs", "3"}});
  expect_twins("turned-damped-oscillator", "damped-oscillator", {field, structure}, {{"nu", "0.7"}},
               {{"nu", "0.7"}});
  expect_twins("spherical-pendulum", "spherical-pendulum", {field, holonomic, constraints, invariants});
  expect_twins("sleigh", "sleigh", {field, velocity_constraints, reversal, invariants});
  expect_twins("predator-prey", "lotka-volterra", {field, invariants});
  expect_twins("relaxing-rigid-body", "relaxing-rigid-body",
               {field, poisson_tensor, symmetric_tensor, casimirs, entropy});
  expect_twins("free-rigid-body", "free-rigid-body", {field, poisson_tensor, casimirs, reversal, invariants});
  expect_twins("sphere-particle", "sphere-particle", {field, constraints});
  expect_twins("shaken-pendulum", "shaken-pendulum", {field, holonomic, constraints});
  expect_twins("rolling-ball", "rolling-ball",
               {field, hamiltonian, velocity_constraints, velocity_offsets, reversal});
}

// The largest difference of the motions that a formulation makes of two models, at states near the start of
// the first one and off the surface of its constraints, relative to the size of the rates.
template <class T>
double difference_of_motions(const FormulationPlugin& formulation, const std::shared_ptr<const Model>& a,
                             const std::shared_ptr<const Model>& b) {
  const auto first = make_evaluator<T>(formulation.apply(a, {}), field),
             second = make_evaluator<T>(formulation.apply(b, {}), field);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  double worst = 0, size = 1;
  for (int k = 0; k < 3; ++k) {
    std::vector<T> z, x(a->initial().size()), y(x.size());
    for (const Real& c : a->initial()) z.push_back(T(c) + T(number(random)));
    first.call(first.context, T(0), z.data(), x.data());
    second.call(second.context, T(0), z.data(), y.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      worst = std::max(worst, static_cast<double>(abs(x[i] - y[i])));
      size = std::max(size, static_cast<double>(abs(y[i])));
    }
  }
  return worst / size;
}

TEST(TextModels, BeadsAndRodsMoveByEveryFormulation) {
  const auto chain = text_model("bead-chain", {{"gravity", "2"}}),
             ring = text_model("bead-ring", {{"drag", "0.3"}});
  const auto
      chain_twin = systems()
                       .get("chain-molecule", "system")
                       .make({{"dimension", "2"}, {"beads", "4"}, {"gravity", "2"}, {"friction", "0.1"}}),
      ring_twin =
          systems().get("ring", "system").make({{"beads", "5"}, {"gravity", "1"}, {"friction", "0.3"}});
  for (const char* name : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
    const FormulationPlugin& formulation = formulations().get(name, "formulation");
    // Linear systems of a few rods, whose condition is some tens.
    EXPECT_LT(difference_of_motions<double>(formulation, chain, chain_twin), 1e-12) << name;
    EXPECT_LT(difference_of_motions<Quad>(formulation, chain, chain_twin), 1e-30) << name;
    EXPECT_LT(difference_of_motions<double>(formulation, ring, ring_twin), 1e-12) << name;
    EXPECT_LT(difference_of_motions<Quad>(formulation, ring, ring_twin), 1e-30) << name;
    const auto without = text_model("bead-ring", {{"drag", "0"}});
    EXPECT_GT(difference_of_motions<double>(formulation, without, ring_twin), 1e-3) << name;
  }
}

// What is written and zero takes nothing: no offset, friction or damping, and the energy is conserved.
TEST(TextModels, WhatIsZeroTakesNothingFromTheEnergy) {
  const pfaff::testing::TemporaryDirectory files;
  const std::string skate =
      "coordinates = [\"x\", \"y\", \"th\", \"px\", \"py\", \"pth\"]\ninitial = [0, 0, 0, 0, 0, 0.5]\n"
      "kinetic = \"(px^2+py^2+pth^2)/2\"\npotential = \"-x\"\nvelocity_constraints = [{ name = \"edge\", row "
      "= "
      "[\"-sin(th)\", \"cos(th)\", \"0\"], b = ";
  const std::string oscillator =
      "coordinates = [\"q\", \"p\"]\nkinetic = \"p^2/2\"\npotential = \"q^2/2\"\ndamping = ";
  const auto energy = [&](const std::string& text) {
    std::ofstream(files / "model.toml") << text;
    const auto model = system_named(files / "model.toml").make({});
    EXPECT_EQ(model->invariants().at(0).name, "energy");
    return std::pair{model->invariants()[0].behaviour, model->given(velocity_offsets)};
  };
  EXPECT_EQ(energy(skate + "0 }]\n"), std::pair(Behaviour::conserved, false));
  EXPECT_EQ(energy(skate + "\"0*t\" }]\n"), std::pair(Behaviour::conserved, false));
  EXPECT_EQ(energy(skate + "0.1 }]\n"), std::pair(Behaviour::free, true));
  EXPECT_EQ(energy(oscillator + "0\n").first, Behaviour::conserved);
  EXPECT_EQ(energy(oscillator + "0.1\n").first, Behaviour::free);
}

TEST(TextModels, BeadsAndRodsStartOnTheirSurface) {
  for (const auto& model : {text_model("bead-chain", {{"n", "7"}}), text_model("bead-ring", {{"n", "9"}})}) {
    const auto surface = make_evaluator<Quad>(model, constraints);
    std::vector<Quad> z, phi(model->constraint_names().size());
    for (const Real& x : model->initial()) z.push_back(x.quad());
    surface.call(surface.context, Quad(0), z.data(), phi.data());
    for (const Quad& x : phi) EXPECT_LT(static_cast<double>(abs(x)), 1e-32) << model->name();
  }
}

// The rows of a bracket against its equations, x_i' = x_i (x_i+1 - x_i-1).
TEST(TextModels, ABracketMayBeWrittenAsRows) {
  const auto lattice = text_model("volterra-lattice");
  const auto rate_of = make_evaluator<Quad>(lattice, field);
  const std::vector<Quad> x{Quad(1) / Quad(3), Quad(2), Quad(-5) / Quad(7)};
  std::vector<Quad> rate(3);
  rate_of.call(rate_of.context, Quad(0), x.data(), rate.data());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(static_cast<double>(abs(rate[i] - x[i] * (x[(i + 1) % 3] - x[(i + 2) % 3]))), 1e-32);
}

std::vector<Quad> some_state(std::size_t size) {
  std::vector<Quad> z;
  for (std::size_t k = 0; k < size; ++k) z.push_back(sin(Quad(static_cast<int>(3 * k + 1))));
  return z;
}

// The double pendulum in relative angles: theta1 = q1, theta2 = q1 + q2 with the momenta p1 - p2 and p2.
TEST(TextModels, RelativeAnglesAreTheSameDoublePendulum) {
  const auto relative = text_model("double-pendulum-relative");
  const auto angles = systems().get("n-pendulum-angles", "system").make({{"bobs", "2"}, {"gravity", "9.8"}});
  const std::vector<Quad> z = some_state(4);
  const Quad ours = evaluated<Quad>(relative, hamiltonian, z, 1)[0];
  const Quad theirs = evaluated<Quad>(angles, hamiltonian, {z[0], z[0] + z[1], z[2] - z[3], z[3]}, 1)[0];
  EXPECT_LT(static_cast<double>(abs(ours - theirs)), 1e-31);  // a dozen terms of up to 20
}

// Without its quartic part the quadrupole boson is the Henon-Heiles problem with q1 and q2 exchanged.
TEST(TextModels, QuadrupoleBosonHoldsHenonHeiles) {
  const std::string lambda = to_string(3 * (Quad(1) / 4) / sqrt(Quad(2)), 36);
  const auto boson = systems().get("quadrupole-boson", "system").make({{"b", "1/4"}, {"d", "0"}});
  const auto galaxy = systems().get("henon-heiles", "system").make({{"lambda", lambda}});
  const std::vector<Quad> z = some_state(4), exchanged{z[1], z[0], z[3], z[2]};
  const auto ours = evaluated<Quad>(boson, force, {z[0], z[1]}, 2),
             theirs = evaluated<Quad>(galaxy, force, {z[1], z[0]}, 2);
  EXPECT_LT(static_cast<double>(abs(ours[0] - theirs[1])), 1e-32);
  EXPECT_LT(static_cast<double>(abs(ours[1] - theirs[0])), 1e-32);
  EXPECT_LT(static_cast<double>(abs(evaluated<Quad>(boson, hamiltonian, z, 1)[0] -
                                    evaluated<Quad>(galaxy, hamiltonian, exchanged, 1)[0])),
            1e-32);
}

// Newton's law by loops over pairs, for n bodies in `dimensions` dimensions whose coordinates stand by
// direction.
void expect_gravity(const std::string& name, const std::vector<Quad>& m, std::size_t dimensions, Quad g) {
  const auto model = text_model(name);
  const std::size_t n = m.size();
  const std::vector<Quad> q = some_state(dimensions * n);
  const auto ours = evaluated<Quad>(model, force, q, q.size());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t x = 0; x < dimensions; ++x) {
      Quad pull(0);
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        Quad square(0);
        for (std::size_t y = 0; y < dimensions; ++y)
          square += (q[y * n + j] - q[y * n + i]) * (q[y * n + j] - q[y * n + i]);
        pull += g * m[i] * m[j] * (q[x * n + j] - q[x * n + i]) / (square * sqrt(square));
      }
      const Quad scale = std::max(abs(pull), g * m[i]);
      EXPECT_LT(static_cast<double>(abs(ours[x * n + i] - pull) / scale), 1e-29) << name << " " << i;
    }
}

TEST(TextModels, BodiesAttractEachOther) {
  expect_gravity("pleiades", {Quad(1), Quad(2), Quad(3), Quad(4), Quad(5), Quad(6), Quad(7)}, 2, Quad(1));
  const auto number = [](const char* text) { return Real::parse(text)->quad(); };
  expect_gravity("outer-solar-system",
                 {number("1.00000597682"), number("0.000954786104043"), number("0.000285583733151"),
                  number("0.0000437273164546"), number("0.0000517759138449"), Quad(1) / 130000000},
                 3, number("2.95912208286e-4"));
}

TEST(TextModels, ADifferentTwinIsSeen) {
  const auto text = text_model("henon-heiles", {{"lambda", "1.000001"}});
  const auto twin = systems().get("henon-heiles", "system").make({});
  EXPECT_GT(formula_difference<double>(text, twin, field), 1e-8);
}

TEST(TextModels, StartWhereTheirTwinsDo) {
  for (const char* name :
       {"henon-heiles", "damped-pendulum", "spherical-pendulum", "sleigh", "relaxing-rigid-body",
        "free-rigid-body", "sphere-particle", "shaken-pendulum", "rolling-ball"}) {
    const auto text = text_model(name), twin = systems().get(name, "system").make({});
    ASSERT_EQ(text->initial().size(), twin->initial().size()) << name;
    for (std::size_t k = 0; k < text->initial().size(); ++k) {
      EXPECT_EQ(text->coordinates()[k].name, twin->coordinates()[k].name);
      EXPECT_LT(static_cast<double>(abs(text->initial()[k].quad() - twin->initial()[k].quad())), 1e-33)
          << name;
    }
  }
}

TEST(TextModels, OfferWhatTheirTwinsOffer) {
  for (const char* name : {"henon-heiles", "spherical-pendulum"})
    EXPECT_EQ(to_string(text_model(name)->facets()),
              to_string(systems().get(name, "system").make({})->facets()));
  EXPECT_TRUE(text_model("lagrangian-pendulum")->facets().has(Facet::separable));
  EXPECT_FALSE(text_model("double-pendulum")->facets().has(Facet::separable));
  EXPECT_TRUE(text_model("damped-pendulum")->facets().has(Facet::generating_map));
  EXPECT_TRUE(text_model("conformal-oscillator")->facets().has(Facet::conformal));
  EXPECT_EQ(text_model("spherical-pendulum")->constraint_names(), (std::vector<std::string>{"rod", "rod~"}));
  EXPECT_EQ(text_model("sleigh")->constraint_names(), (std::vector<std::string>{"knife-edge"}));
}

// The force of the lattice by a loop over its springs.
TEST(TextModels, LatticesHaveTheSizeOfAParameter) {
  constexpr std::size_t n = 50;
  const auto model = text_model("lattice", {{"n", "50"}, {"alpha", "0.3"}});
  ASSERT_EQ(model->dimension(), 100);
  EXPECT_EQ(model->coordinates().back().name, "p50");
  const auto evaluator = make_evaluator<Quad>(model, force);
  std::vector<Quad> q(n), f(n), expected(n);
  for (std::size_t k = 0; k < n; ++k) q[k] = sin(Quad(static_cast<int>(3 * k)));
  evaluator.call(evaluator.context, Quad(0), q.data(), f.data());
  const Quad alpha = Quad(3) / Quad(10), beta = Quad(1) / Quad(10);
  for (std::size_t k = 0; k <= n; ++k) {
    const Quad d = (k < n ? q[k] : Quad(0)) - (k > 0 ? q[k - 1] : Quad(0));
    const Quad tension = d + alpha * d * d + beta * d * d * d;
    if (k < n) expected[k] = expected[k] - tension;
    if (k > 0) expected[k - 1] = expected[k - 1] + tension;
  }
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_LT(static_cast<double>(abs(f[k] - expected[k])), 1e-32) << k;  // six terms of order one
}

TEST(TextModels, PassTheChecksOfEverySystem) {
  int systems_checked = 0;
  for (const auto& entry : fs::directory_iterator(examples())) {
    const std::string path = entry.path().string();
    if (is_text_bracket(path)) {
      for (const Check& check : check_bracket(bracket_named(path), {}))
        EXPECT_TRUE(good(check)) << path << ": " << check.claim << " " << check.measured;
      continue;
    }
    const auto checks = check_system(system_named(path), {});
    for (const Check& check : checks)
      EXPECT_TRUE(good(check)) << path << ": " << check.claim << " " << check.measured;
    ++systems_checked;
  }
  EXPECT_GE(systems_checked, 21);
}

// What is false is found in text as it is in C++.
TEST(TextModels, FalseClaimsAreFound) {
  const pfaff::testing::TemporaryDirectory directory;
  const auto bad = [&](const std::string& name, const std::string& text, bool bracket) {
    const fs::path file = directory.path() / (name + ".toml");
    std::ofstream(file) << text;
    const auto checks = bracket ? check_bracket(bracket_named(file.string()), {})
                                : check_system(system_named(file.string()), {});
    return std::any_of(checks.begin(), checks.end(), [](const Check& check) { return !good(check); });
  };
  const std::string spring =
      "coordinates = [\"q\", \"p\"]\ninitial = [1, 0.2]\nkinetic = \"p^2/2\"\npotential = \"q^4/4\"\n";
  EXPECT_FALSE(bad("true", spring + "invariants = { H = \"p^2/2 + q^4/4\" }\n", false));
  EXPECT_TRUE(bad("invariant", spring + "invariants = { H = \"p^2/2 + q^4/4.000001\" }\n", false));
  EXPECT_TRUE(bad("reversal", spring + "reversal = [\"q\", \"p\"]\n", false));
  const std::string parts =
      spring + "parts = [{ name = \"drift\", change = [\"h*p\", 0] }, { name = \"kick\", change = ";
  EXPECT_FALSE(bad("parts", parts + "[0, \"-h*q^3\"] }]\n", false));
  EXPECT_TRUE(bad("part", parts + "[0, \"-h*q^3*1.000001\"] }]\n", false));
  EXPECT_TRUE(bad("group", parts + "[0, \"-h*q^3*(1 + h^2/1e6)\"] }]\n", false));
  EXPECT_TRUE(bad("override", spring + "force = [\"-q^3*1.000001\"]\n", false));
  EXPECT_TRUE(bad("bracket",
                  "coordinates = [\"x\", \"y\", \"z\"]\nsymmetry = \"skew\"\njacobi = true\n"
                  "tensor = [[\"0\", \"z\", \"x\"], [\"-z\", \"0\", \"1\"], [\"-x\", \"-1\", \"0\"]]\n",
                  true));
}
}  // namespace
