// Parameters that stay symbols in derived equations, and the coefficients of generating functions, against
// closed forms, against equations that were derived with other values, and against the literal expansion of
// papers/.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/derive/derivation/named_parameters.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/tests/generating/generating_expansion.hpp>

#include "../temporary_directory.hpp"
#include "derived.hpp"

namespace {

using namespace pfaff;
using namespace pfaff::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Equations derived_with_names(const SystemPlugin& system, const Assignments& settings,
                             const std::string& method, int degree = 4) {
  return with_named_parameters(system, settings, [&](const Model& model) {
    return derive(model, method, DerivationOptions{.degree = degree});
  });
}
std::vector<std::string> symbols(const Equations& equations) {
  std::vector<std::string> names;
  for (const Symbol& symbol : equations.parameters) names.push_back(symbol.name);
  return names;
}
std::vector<Quad> somewhere(const Model& model) {
  std::vector<Quad> z;
  for (int k = 0; k < model.dimension(); ++k) z.push_back(Quad(7 + 3 * k) / Quad(11 + k));
  return z;
}
double relative_difference(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, static_cast<double>(abs(a[k] - b[k]) / std::max(Quad(1), abs(b[k]))));
  return worst;
}

struct Named {
  std::string system, method;
  std::vector<std::string> symbols;
  Assignments other;  // values that differ from those of the derivation
};

// Equations with symbols, evaluated with other values, are the equations that these values give.
TEST(NamedParameters, OtherValuesGiveTheirEquations) {
  for (const Named& one : {Named{"damped-oscillator", "birkhoffian", {"nu"}, {{"nu", "0.7"}}},
                           Named{"lotka-volterra",
                                 "birkhoffian",
                                 {"alpha", "beta", "gamma", "delta"},
                                 {{"alpha", "0.9"}, {"beta", "0.4"}, {"gamma", "1.3"}, {"delta", "0.3"}}},
                           Named{"damped-pendulum", "generating-function", {"nu"}, {{"nu", "0.45"}}}}) {
    SCOPED_TRACE(one.system);
    const SystemPlugin& system = systems().get(one.system, "system");
    const auto model = system.make(one.other);
    Equations equations = derived_with_names(system, {}, one.method);
    EXPECT_THAT(symbols(equations), ::testing::UnorderedElementsAreArray(one.symbols));
    const std::vector<Quad> z = somewhere(*model);
    const auto before = rates_of(derive(*system.make({}), one.method), Quad(0.3), z);
    EXPECT_LT(relative_difference(rates_of(equations, Quad(0.3), z), before), 1e-31);
    for (std::size_t k = 0; k < equations.parameters.size(); ++k)
      for (const auto& [name, value] : one.other)
        if (name == equations.parameters[k].name) equations.parameter_values[k] = *Real::parse(value);
    const auto found = rates_of(equations, Quad(0.3), z);
    EXPECT_LT(relative_difference(found, rates_of(derive(*model, one.method), Quad(0.3), z)), 1e-31);
    EXPECT_GT(relative_difference(found, before), 1e-3);  // the control: the values matter
  }
}

// A sum of parameters is one constant of the formula, so that they stay numbers; a product is not.
TEST(NamedParameters, OfTextModelsStayNumbersWhereTheyAreAdded) {
  const TemporaryDirectory directory;
  const std::string path = directory / "sums.toml";
  std::ofstream(path) << R"toml(name = "sums"
title = "A quartic oscillator"
reference = "none"
parameters = { a = { value = 2 }, b = { value = 3 }, c = { value = "1/2" }, d = { value = 5 }, none = { value = 0 } }
coordinates = ["q", "p"]
initial = [1, 0]
kinetic = "p^2/(2*d)"
potential = "(a + b)*q^2/2 + c*d^2*q^4/4 + none*q"
)toml";
  const SystemPlugin& system = system_named(path);
  Equations equations = derived_with_names(system, {}, "birkhoffian");
  EXPECT_THAT(symbols(equations), ElementsAre("c", "d"));
  const std::vector<Quad> z{Quad(2), Quad(3)};
  equations.parameter_values = {7, 4};
  // q' = p/d, p' = -(a + b) q - c d^2 q^3
  EXPECT_LT(relative_difference(rates_of(equations, Quad(0), z), {Quad(0.75), Quad(-10 - 7 * 16 * 8)}),
            1e-33);
}

// Near its value each of these but e enters as a factor.
TEST(NamedParameters, StayNumbersWhereTheyAreFactorsNearTheirValuesAlone) {
  const TemporaryDirectory directory;
  const std::string path = directory / "bent.toml";
  std::ofstream(path) << R"toml(name = "bent"
reference = "none"
parameters = { a = 2, b = 3, c = "3/2", e = 7 }
coordinates = ["q", "p"]
initial = [1, 0]
hamiltonian = "p^2/2 + min(a, 5)*q^2 + abs(b)*q^4 + select(c > 10, 7, c)*q^6 + e*q^8"
)toml";
  EXPECT_THAT(symbols(derived_with_names(system_named(path), {}, "birkhoffian")), ElementsAre("e"));
}

// phi of q'' + q = 0 is -tan(tau/2) (q^2 + p^2).
TEST(GeneratingCoefficients, AreClosedFormsOfTheOscillator) {
  const SystemPlugin& system = systems().get("harmonic-oscillator", "system");
  const auto model = system.make({});
  const Equations equations = derive(*model, "generating-function", DerivationOptions{.degree = 5});
  EXPECT_THAT(equations.further_outputs, ElementsAre("phi1", "phi2", "phi3", "phi4", "phi5"));
  const std::vector<Quad> z{Quad(0.5), Quad(-0.75)};
  const Quad square = z[0] * z[0] + z[1] * z[1];
  EXPECT_LT(relative_difference(
                rates_of(equations, Quad(0), z),
                {z[1], -z[0], -square / Quad(2), Quad(0), -square / Quad(24), Quad(0), -square / Quad(240)}),
            1e-33);
}

TEST(GeneratingCoefficients, AreThoseOfTheLiteralExpansion) {
  constexpr int degree = 5;
  for (const auto& [name, energy] : {std::pair{"damped-pendulum", Formula::chart_hamiltonian},
                                     std::pair{"damped-oscillator", Formula::chart_hamiltonian},
                                     std::pair{"henon-heiles", Formula::hamiltonian}}) {
    const auto model = systems().get(name, "system").make({});
    const auto terms = expand_scalar(scalar_evolution(*model->tape(energy)), model->dimension(), degree);
    const std::vector<Quad> z = somewhere(*model);
    const auto found =
        rates_of(derive(*model, "generating-function", DerivationOptions{.degree = degree}), Quad(0.7), z);
    double changed = 0;
    for (int k = 1; k <= degree; ++k) {
      std::vector<Quad> expected(1), earlier(1);
      Replay<Quad> replay(std::make_shared<const Tape>(terms[static_cast<std::size_t>(k)]));
      replay(Quad(0.7), z.data(), expected.data());
      EXPECT_LT(relative_difference({found[z.size() + static_cast<std::size_t>(k) - 1]}, expected), 1e-30)
          << name << k;
      replay(Quad(0.2), z.data(), earlier.data());
      changed = std::max(changed, relative_difference(earlier, expected));
    }
    // The control: what depends on time is compared at the right one.
    if (name != std::string("henon-heiles")) {
      EXPECT_GT(changed, 1e-3) << name;
    }
  }
}

TEST(GeneratingCoefficients, RefuseWhatHasNone) {
  const auto message = [](const char* system, int degree) -> std::string {
    try {
      (void)derive(*systems().get(system, "system").make({}), "generating-function",
                   DerivationOptions{.degree = degree});
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  EXPECT_EQ(message("kepler", 2), "nothing thrown");
  EXPECT_THAT(message("kepler", 0), HasSubstr("order: expected 1 .. 12, got 0"));
  EXPECT_THAT(message("kepler", 13), HasSubstr("got 13"));
  EXPECT_THAT(message("humanoid", 2), HasSubstr("needs a Hamiltonian in Darboux coordinates"));
}

// A velocity constraint that repeats another one leaves nothing to be derived, and is named.
TEST(NamedParameters, DependentVelocityConstraintsAreRefused) {
  const TemporaryDirectory directory;
  const std::string path = directory / "twice.toml";
  std::ofstream(path) << R"toml(name = "twice"
reference = "none"
coordinates = ["x", "y", "u", "v"]
initial = [1, 2, 3, 4]
hamiltonian = "u^2/2 + v^2/2"
velocity_constraints = [{ name = "a", row = ["1", "x"] }, { name = "b", row = ["2", "2*x"] }]
)toml";
  try {
    (void)derived_with_names(system_named(path), {}, "nonholonomic");
    FAIL() << "it was derived";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("constraint b"), std::string::npos) << error.what();
  }
}

}  // namespace
