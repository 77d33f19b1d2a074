// What formulations keep and do not keep off the surface of constraints, with any mass matrix and with
// constraints that depend on time.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

#include "off_the_surface.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

template <class T>
void dirac_keeps_everything() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto dirac = motion(model, "dirac"), simple = motion(model, "simplified-dirac");
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const Rates<T> rates(*model, field(dirac, t, z), t, z), others(*model, field(simple, t, z), t, z);
      EXPECT_LE(rates.worst(rates.phi_rates), kept<T>);
      EXPECT_LE(rates.worst(rates.hidden_rates), kept<T>);
      EXPECT_GT(others.worst(others.phi_rates), 1e-6) << "the control keeps phi";
      if (model->name() == "shaken-pendulum") continue;  // the support does work
      EXPECT_LE(rates.relative(rates.energy_rate), kept<T>);
      EXPECT_GT(others.relative(others.energy_rate), 1e-6) << "the control keeps H";
    }
  }
}
TEST(Formulations, DiracKeepsBothLevelsAndEnergyOffTheSurface) {
  dirac_keeps_everything<double>();
  dirac_keeps_everything<Quad>();
}

template <class T>
void simplified_statements() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto simple = motion(model, "simplified-dirac"), multipliers = motion(model, "lmm"),
               stabilised = motion(model, "ggl");
    const auto constraints = model->template holonomic_constraints<T>();
    const std::size_t n = constraints->degrees();
    std::vector<T> s(constraints->count());
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const auto rate = field(simple, t, z);
      ASSERT_EQ(constraints->place(t, In<T>(z).first(n), In<T>(z).subspan(n)), Status::converged);
      const Rates<T> rates(*model, rate, t, z);
      // phi' = phi~, phi~' = 0, H' = -phi~.S^-1 h
      const std::vector<T> hidden(constraints->hidden().begin(), constraints->hidden().end());
      EXPECT_LE(relative_distance(rates.phi_rates, hidden), kept<T>);
      EXPECT_LE(rates.worst(rates.hidden_rates), kept<T>);
      constraints->solve(constraints->hidden_rates(), s);
      T expected(0);
      for (std::size_t i = 0; i < s.size(); ++i) expected = expected - constraints->hidden()[i] * s[i];
      if (model->name() != "shaken-pendulum") {
        EXPECT_LE(rates.relative(rates.energy_rate - expected), kept<T>);
      }
      // Lagrange's multipliers without friction and stabilisation are the same field.
      EXPECT_LE(relative_distance<T>(field(multipliers, t, z), rate), bound<T>);
      // The stabilised index 2 keeps both levels, and not the energy.
      const Rates<T> ggl(*model, field(stabilised, t, z), t, z);
      EXPECT_LE(ggl.worst(ggl.phi_rates), kept<T>);
      EXPECT_LE(ggl.worst(ggl.hidden_rates), kept<T>);
      if (model->name() != "shaken-pendulum") {
        EXPECT_GT(ggl.relative(ggl.energy_rate), 1e-6);
      }
    }
  }
}
TEST(Formulations, SimplifiedDiracIsLagrangesMultipliersAndLetsPositionsDrift) {
  simplified_statements<double>();
  simplified_statements<Quad>();
}

TEST(Formulations, OnTheSurfaceAllAreOneMotion) {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    std::vector<Quad> z;
    for (const Real& x : model->initial()) z.push_back(x.quad());
    const auto dirac = field(motion(model, "dirac"), Quad(0), z);
    for (const char* other : {"simplified-dirac", "lmm", "ggl"})
      EXPECT_LE(relative_distance<Quad>(field(motion(model, other), Quad(0), z), dirac), kept<Quad>) << other;
  }
}

template <class T>
void baumgarte() {
  const T alpha(2), beta(3);
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto damped = motion(model, "lmm", {{"baumgarte-alpha", "2"}, {"baumgarte-beta", "3"}});
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const auto phi = values(model->tape(Formula::constraints), t, z);
      const Rates<T> rates(*model, field(damped, t, z), t, z);
      for (std::size_t i = 0; i < rates.phi_rates.size(); ++i) {
        const T expected = -(T(2) * alpha * phi[2 * i + 1] + beta * beta * phi[2 * i]);
        EXPECT_LE(rates.relative(rates.phi_rates[i] - phi[2 * i + 1]), kept<T>);
        EXPECT_LE(rates.relative(rates.hidden_rates[i] - expected), kept<T>);
        EXPECT_GT(rates.relative(rates.hidden_rates[i]), 1e-6) << "nothing is stabilised";
      }
    }
  }
}
TEST(Formulations, BaumgarteDampsTheConstraintsAtItsRates) {
  baumgarte<double>();
  baumgarte<Quad>();
}

template <class T>
void tapes_are_the_fields() {
  auto models = holonomic_models();
  models.push_back(chain(golden_rods().drag));
  for (const auto& model : models) {
    SCOPED_TRACE(model->name());
    for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
      const auto moving = motion(model, formulation);
      ASSERT_NE(moving->program(Formula::field), nullptr);
      Points<T> at;
      for (int k = 0; k < points; ++k) {
        const T t = at.time();
        const auto z = at.near(*model);
        const auto direct = field(moving, t, z);
        EXPECT_LE(relative_distance<T>(values(moving->tape(Formula::field), t, z), direct), kept<T>)
            << formulation;
        auto changed = z;
        changed[0] = changed[0] + T(1e-5);
        EXPECT_GT(relative_distance<T>(values(moving->tape(Formula::field), t, changed), direct), kept<T>);
      }
    }
  }
}
TEST(Formulations, RecordedTapesAreTheFields) {
  tapes_are_the_fields<double>();
  tapes_are_the_fields<Quad>();
}

// A step whose signature names a weaker concept than what it calls would move without the constraints.
TEST(Formulations, OfferNoFormulaOfAnotherMotion) {
  const auto moving = formulations()
                          .get("dirac", "formulation")
                          .apply(systems().get("spherical-pendulum", "system").make({}), {});
  const Problem<double> problem(moving);
  std::vector<double> z, half(3), whole(6);
  for (const Real& x : moving->initial()) z.push_back(x.value());
  problem.field(0, z, whole);
  try {
    problem.force(0, std::span<const double>(z).first(3), half);
    FAIL() << "a force without the constraints was given";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a step evaluates force, which spherical-pendulum does not offer for its motion; expected a "
                 "method that "
                 "needs separable, conformal, as the concept in the signature of its step says");
  }
}

}  // namespace
