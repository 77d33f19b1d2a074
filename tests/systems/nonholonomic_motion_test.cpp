// What is said of the motions with velocity constraints: closed forms stay on the constraints, a change of
// gauge leaves the motion as it is, and the gyroscopic contact oscillator is not reversible.
#include <gtest/gtest.h>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../formula_values.hpp"
#include "motion.hpp"
#include "samples.hpp"
#include "taylor_flow.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

double size_of(const Numbers& x) {
  double worst = 0;
  for (const Quad& entry : x) worst = std::max(worst, static_cast<double>(abs(entry)));
  return worst;
}

TEST(NonholonomicMotion, ClosedFormsStayOnTheConstraints) {
  int judged = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    if (!model->nonholonomic() || !model->facets().has(Facet::exact_solution)) continue;
    SCOPED_TRACE(plugin->name());
    Samples samples(12);
    for (int k = 0; k < 10; ++k) {
      Numbers start = on_velocity_constraints(*plugin, {}, samples.start(*model)), z(start.size());
      start.emplace_back(0);
      for (const int time : {-3, 0, 1, 20}) {
        Problem<Quad>(model).exact_solution(Quad(time), start, z);
        // Momenta of size one to ten.
        EXPECT_LE(size_of(values(model->tape(Formula::constraints), Quad(0), z)), 1e-31) << time;
        z.back() += Quad(1e-6);                // the control
        if (plugin->name() != "knife-edge") {  // whose constraint does not see p_theta
          EXPECT_GT(size_of(values(model->tape(Formula::constraints), Quad(0), z)), 1e-9);
        }
        ++judged;
      }
    }
  }
  EXPECT_GE(judged, 4 * 40);
}

// Positions move alike from the same velocities, which are other momenta.
TEST(NonholonomicMotion, AChangeOfGaugeChangesMomentaOnly) {
  const auto plain = model_named("contact-oscillator"), other = model_named("contact-oscillator-conjugate");
  Numbers a, b;
  for (const Real& x : plain->initial()) a.push_back(x.quad());
  for (const Real& x : other->initial()) b.push_back(x.quad());
  EXPECT_GT(static_cast<double>(abs(a[5] - b[5])), 0.1);
  a = taylor_flow(motion_of(plain)->tape(Formula::field), Quad(0), a, Quad(2));
  b = taylor_flow(motion_of(other)->tape(Formula::field), Quad(0), b, Quad(2));
  for (std::size_t k = 0; k < 5; ++k) EXPECT_LE(static_cast<double>(abs(a[k] - b[k])), 1e-30) << k;
  EXPECT_LE(static_cast<double>(abs(a[5] - (b[5] - sin(b[2]) / Quad(2)))), 1e-30);
}

// The coefficients c_0 ... c_n of det(l - M), by Faddeev's and LeVerrier's recurrence.
Numbers characteristic(const Matrix<Quad>& m) {
  const std::size_t n = m.rows();
  Numbers c(n + 1, Quad(0));
  c[n] = Quad(1);
  Matrix<Quad> power(n, n);
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i < n; ++i) power(i, i) += c[n - k + 1];
    power = m * power;
    Quad trace(0);
    for (std::size_t i = 0; i < n; ++i) trace += power(i, i);
    c[n - k] = -trace / Quad(static_cast<int>(k));
  }
  return c;
}
// The exponents at the equilibrium q = (s, 0, 0): two are zero, those of the line of equilibria and of the
// constraint.
Numbers exponents(const std::shared_ptr<const Model>& model, Quad s) {
  const auto field = motion_of(model)->tape(Formula::field);
  const Numbers at{s, Quad(0), Quad(0), Quad(0), Quad(0), Quad(0)};
  EXPECT_LE(size_of(values(field, Quad(0), at)), 1e-33) << "no equilibrium";
  return characteristic(
      Matrix<Quad>(6, values(std::make_shared<const Tape>(jacobian_tape(*field)), Quad(0), at)));
}

TEST(NonholonomicMotion, NothingReversesTheGyroscopicContactOscillator) {
  const auto model = model_named("gyroscopic-contact-oscillator");
  const auto turned_off = model_named("gyroscopic-contact-oscillator", {{"gamma", "0"}});
  const auto plain = model_named("contact-oscillator");
  for (const double place : {-2.0, -0.3, 0.7, 1.5}) {
    const Quad s(place), square = s * s,
                         stiffness = Quad(1) + Quad(13) / Quad(10) * square;  // epsilon + beta
    const Numbers c = exponents(model, s);
    // l^2 (l^4 + c_2 l^2 - gamma s^2 l + c_0)
    const Numbers expected{Quad(0), Quad(0), stiffness, -square, Quad(1) + stiffness + square,
                           Quad(0), Quad(1)};
    for (std::size_t k = 0; k < 7; ++k) EXPECT_LE(static_cast<double>(abs(c[k] - expected[k])), 1e-31) << k;
    // A reversible relative has symmetric exponents at every one of its equilibria.
    for (const auto& reversible : {turned_off, plain})
      for (const std::size_t odd : {1U, 3U, 5U})
        EXPECT_LE(static_cast<double>(abs(exponents(reversible, s)[odd])), 1e-32);
  }
}

// d rho X + X o rho at a state, for rho (q, v) = (R q, -R v) with R = diag(signs): zero for a reversal.
// Momenta are p = v + a, a = (0, -gamma x z, 0).
double turning_residual(const std::shared_ptr<const Tape>& field, int gamma, const std::array<int, 3>& signs,
                        const Numbers& z) {
  Replay<Quad> turned(std::make_shared<const Tape>(
      record(12, 6, [&](const Recorded& /*t*/, std::span<const Recorded> x, std::span<Recorded> out) {
        // rho in the first six numbers, and its derivative along the last six by differentiating it.
        const Tape rho =
            record(6, 6, [&](const Recorded& /*s*/, std::span<const Recorded> y, std::span<Recorded> image) {
              for (std::size_t k = 0; k < 3; ++k) image[k] = signs[k] * y[k];
              for (std::size_t k = 0; k < 3; ++k) image[3 + k] = -signs[k] * y[3 + k];
              image[4] = -signs[1] * (y[4] + gamma * y[0] * y[2]) - gamma * image[0] * image[2];
            });
        const auto there = evaluate(*field, Recorded(0), evaluate(rho, Recorded(0), x.first(6)));
        const auto carried = directional_derivative(rho, Recorded(0), Recorded(0), x.first(6), x.subspan(6));
        for (std::size_t k = 0; k < 6; ++k) out[k] = there[k] + carried[k];
      })));
  Numbers point = z, out(6);
  const Numbers rate = values(field, Quad(0), z);
  point.insert(point.end(), rate.begin(), rate.end());
  turned(Quad(0), point.data(), out.data());
  return size_of(out);
}

TEST(NonholonomicMotion, ReversedVelocitiesAndMirrorsDoNotReverseTheGyroscopicContactOscillator) {
  const SystemPlugin& plugin = systems().get("gyroscopic-contact-oscillator", "system");
  for (const int gamma : {0, 1}) {
    const Assignments set{{"gamma", std::to_string(gamma)}};
    const auto field = motion_of(plugin.make(set))->tape(Formula::field);
    const Numbers z = on_velocity_constraints(
        plugin, set, {Quad(0.7), Quad(-0.4), Quad(0.6), Quad(0.3), Quad(0.5), Quad(-0.8)});
    int reversals = 0;
    for (const int x : {1, -1})
      for (const int y : {1, -1})
        for (const int w : {1, -1}) {
          const double residual = turning_residual(field, gamma, {x, y, w}, z);
          if (residual < 1e-30) ++reversals;
          if (gamma == 1) {
            EXPECT_GT(residual, 0.01) << x << y << w;
          }
        }
    // With gamma = 0 velocities reversed do, alone and with the mirrors that the distribution has.
    EXPECT_EQ(reversals > 0, gamma == 0);
  }
}

TEST(NonholonomicMotion, StatesOfTheQuarticSystemHaveTheEnergyThatIsAskedFor) {
  for (const char* energy : {"3", "0.25", "100", "0"})
    for (const char* seed : {"1", "2", "31"}) {
      const auto model =
          model_named("quartic-nonholonomic", {{"n", "4"}, {"seed", seed}, {"energy", energy}});
      Numbers z;
      for (const Real& x : model->initial()) z.push_back(x.quad());
      const Quad asked = Real::parse(energy)->quad(),
                 found = values(model->tape(Formula::hamiltonian), Quad(0), z).front();
      const double off = static_cast<double>(abs(found - asked) / (asked + Quad(1)));
      if (asked == Quad(0)) {
        EXPECT_GT(off, 0.1) << "as drawn";  // control
      } else {
        EXPECT_LE(off, 1e-32) << energy << ' ' << seed;
      }
      EXPECT_LE(size_of(values(model->tape(Formula::constraints), Quad(0), z)), 1e-30);
    }
}

}  // namespace
