// Applied forces, which no potential gives: beside energies, holonomic constraints and constraints of
// velocities, in C++ and as text, against closed forms, power balances and values computed independently.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>

#include "../falling_particle.hpp"
#include "../formula_values.hpp"
#include "../integrators/methods.hpp"
#include "written_models.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::after_steps;
using pfaff::testing::evaluated;
using pfaff::testing::method_named;
using pfaff::testing::model_written;
using pfaff::testing::refusal_written;

std::shared_ptr<const Model> example(const std::string& name) {
  const auto directory = std::filesystem::path(PFAFF_GOLDEN) / "../../examples/models";
  return system_named((directory / (name + ".toml")).string()).make({});
}
// The values were computed with 34 digits by Gragg, Bulirsch and Stoer's extrapolation from equations of
// motion written by hand in other coordinates: angles and their rates of the arm, the angle of the crank
// alone for the loop, whose point 4 is where two circles meet. Gauss's method of order 16 in quad is exact to
// the tolerance at these steps.
struct Sample {
  const char* model;
  std::int64_t steps;
  Quad step;
  std::vector<std::pair<std::size_t, Quad>> state;
  double tolerance;
};

Quad number(const char* digits) { return Real::parse(digits)->quad(); }

void expect_sample(const Sample& sample) {
  const auto z = after_steps<Quad>(*method_named("gauss", {{"stages", "8"}}),
                                   motion_of(example(sample.model)), sample.step, sample.steps);
  for (const auto& [k, expected] : sample.state)
    EXPECT_LT(static_cast<double>(abs(z[k] - expected)), sample.tolerance) << sample.model << " " << k;
}

TEST(AppliedForce, ExamplesMoveAsComputedIndependently) {
  expect_sample({"van-der-pol",
                 400,
                 Quad(1) / Quad(40),
                 {{0, number("-2.008340782579712332780730146633687789")},
                  {1, number("0.03290706586332406443147170071894005878")}},
                 1e-18});
  expect_sample({"slowing-well",
                 400,
                 Quad(1) / Quad(20),
                 {{0, number("-0.2191903258932153968340556164564563055")},
                  {1, number("1.215123833133111857463451812669026168")}},
                 1e-18});
  // The square is at the angle -.2077658... then, and turns at the rate -.90778210...
  const Quad angle = number("-0.2077658187022567968544583577692512"),
             rate = number("-0.9077821016196564174158316839121501");
  expect_sample({"braced-loop",
                 100,
                 Quad(1) / Quad(200),
                 {{0, cos(angle)},
                  {4, sin(angle)},
                  {3, number("3.202508598022732040199962403787426")},
                  {7, number("1.989721153259136341340183651065042")},
                  {8, -sin(angle) * rate},
                  {12, cos(angle) * rate},
                  {11, number("0.8544109171861717110394628505420579")},
                  {15, number("-0.08695970120801837939325768267195574")}},
                 1e-18});
}

// The friction |w| w of the second joint has a kink where the joint stands still, which Taylor steps end at;
// the extrapolation does not know it, so that its last digits, beyond the fifteenth, are lost.
TEST(AppliedForce, FrictionInAJointActsOnBothLinks) {
  const auto arm = example("robot-arm");
  std::vector<Quad> z;
  for (const Real& x : arm->initial()) z.push_back(x.quad());
  Quad t(0);
  ASSERT_EQ(method_named("taylor")->stepper(arm, Quad())->advance_to(t, Quad(2), Quad(1e-22), z),
            Status::converged);
  const std::array expected{"-0.029900703542105425", "0.16756154613284985", "0.34912624087285521",
                            "0.44596710028844651"};
  for (std::size_t k = 0; k < z.size(); ++k)
    EXPECT_LT(static_cast<double>(abs(z[k] - number(expected[k]))), 2e-14) << k;
}

struct Driven {  // q'' = cos(2 t) - q - q'/5
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
  template <class T>
  void applied_force(const T& t, In<T> z, Out<T> f) const {
    f[0] = cos(2 * t) - z[1] / 5;
  }
};
// A bob on a circle of radius one about the origin, pushed along it by 3/2 - v_theta/4, with gravity 1.
struct MotorPendulum : pfaff::testing::FallingParticle {
  static constexpr int constraint_count = 1;
  template <class T>
  void applied_force(const T& /*t*/, In<T> z, Out<T> f) const {
    const T push = T(3) / 2 - (z[0] * z[3] - z[1] * z[2]) / 4;
    f[0] = -z[1] * push;
    f[1] = z[0] * push;
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] - 1) / 2;
  }
};
// A knife edge, driven along its blade by the force 1/2 and turned by the torque 1/3 - w/2.
struct DrivenEdge {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void applied_force(const T& /*t*/, In<T> z, Out<T> f) const {
    f[0] = cos(z[2]) / 2;
    f[1] = sin(z[2]) / 2;
    f[2] = T(1) / 3 - z[5] / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = sin(q[2]);
    rows[1] = -cos(q[2]);
    rows[2] = T(0);
  }
};
template <class S>
std::shared_ptr<const Model> model_of(const S& system, std::vector<Real> initial) {
  return make_model(
      SystemDescriptor{.name = "forced", .title = "", .reference = "", .initial = std::move(initial)},
      system);
}
const char* const driven_text =
    "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nkinetic = \"p^2/2\"\npotential = \"q^2/2\"\n"
    "applied_force = [\"cos(2*t) - p/5\"]\n";

TEST(AppliedForce, TwinsInCppAndTextHaveOneField) {
  const std::vector<Quad> z{Quad(3) / Quad(7), Quad(-2) / Quad(3)};
  const Quad t = Quad(4) / Quad(5);
  const auto text = evaluated(model_written(driven_text), Formula::field, z, 2, t),
             twin = evaluated(model_of(Driven{}, {1, 0}), Formula::field, z, 2, t);
  EXPECT_EQ(text, twin);
  EXPECT_LT(static_cast<double>(abs(twin[1] - (cos(Quad(2) * t) - z[0] - z[1] / Quad(5)))), 1e-33);
}

// Beside a lagrangian the force reads velocities: L = (1 + q^2) v^2/2 - q^2/2 has p = (1 + q^2) v.
TEST(AppliedForce, ReadsTheVelocitiesOfALagrangian) {
  const auto model = model_written(
      "coordinates = [\"q\", \"p\"]\ninitial = [1, 0]\nvelocities = [\"u\"]\n"
      "lagrangian = \"(1 + q^2)*u^2/2 - q^2/2\"\napplied_force = [\"t*u^3 - q*p\"]\n");
  const Quad q = Quad(1) / Quad(3), p = Quad(5) / Quad(7), t = Quad(2), u = p / (Quad(1) + q * q);
  const auto rate = evaluated(model, Formula::field, std::vector<Quad>{q, p}, 2, t);
  EXPECT_LT(static_cast<double>(abs(rate[0] - u)), 1e-33);
  // H_q = -L_q with v held: -(q u^2 - q)
  EXPECT_LT(static_cast<double>(abs(rate[1] - (q * u * u - q + t * u * u * u - q * p))), 1e-32);
}

// The angle a of the bob from the x axis obeys a'' = -cos a + 3/2 - a'/4, in every formulation.
TEST(AppliedForce, ConstrainedMotionIsThatOfTheAngle) {
  const auto model = model_of(MotorPendulum{}, {1, 0, 0, 0});
  const Quad a = Quad(7) / Quad(5), w = Quad(-2) / Quad(3), push = Quad(3) / Quad(2) - w / Quad(4) - cos(a);
  const std::vector<Quad> z{cos(a), sin(a), -w * sin(a), w * cos(a)};
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
    const auto rate = evaluated(formulations().get(formulation, "formulation").apply(model, {}),
                                Formula::field, z, 4, Quad(0));
    EXPECT_LT(static_cast<double>(abs(rate[0] - z[2])), 1e-32) << formulation;
    EXPECT_LT(static_cast<double>(abs(rate[1] - z[3])), 1e-32) << formulation;
    EXPECT_LT(static_cast<double>(abs(rate[2] - (-push * sin(a) - w * w * cos(a)))), 1e-32) << formulation;
    EXPECT_LT(static_cast<double>(abs(rate[3] - (push * cos(a) - w * w * sin(a)))), 1e-32) << formulation;
  }
}
// The blade goes along its direction at u with u' = 1/2, and turns at w with w' = 1/3 - w/2.
TEST(AppliedForce, ADrivenBladeKeepsItsDirection) {
  const auto model = model_of(DrivenEdge{}, {0, 0, 0, 1, 0, 1});
  const Quad angle = Quad(3) / Quad(5), u = Quad(2), w = Quad(4) / Quad(7);
  const std::vector<Quad> z{Quad(1), Quad(2), angle, u * cos(angle), u * sin(angle), w};
  const auto rate = evaluated(formulations().get("nonholonomic", "formulation").apply(model, {}),
                              Formula::field, z, 6, Quad(0));
  const Quad half = Quad(1) / Quad(2);
  EXPECT_LT(static_cast<double>(abs(rate[3] - (half * cos(angle) - u * w * sin(angle)))), 1e-32);
  EXPECT_LT(static_cast<double>(abs(rate[4] - (half * sin(angle) + u * w * cos(angle)))), 1e-32);
  EXPECT_LT(static_cast<double>(abs(rate[5] - (Quad(1) / Quad(3) - w * half))), 1e-32);
}

// H' = Q.v: an energy that such a force changes counts as conserved nowhere.
TEST(AppliedForce, TheEnergyIsFollowedAndNotClaimed) {
  const auto model = model_written(driven_text);
  ASSERT_EQ(model->invariants().size(), 1U);
  EXPECT_EQ(model->invariants().front().name, "energy");
  EXPECT_EQ(model->invariants().front().behaviour, Behaviour::free);
}

std::string said_of(const std::string& method, const std::shared_ptr<const Model>& model) {
  return method_named(method)->refuses(*model);
}
TEST(AppliedForce, MethodsOfEnergiesSayWhatTakesThem) {
  EXPECT_EQ(said_of("verlet", model_written(driven_text)),
            "verlet needs separable; model offers vector-field, invariants; its applied forces have no "
            "potential: methods for vector fields take them");
  const auto bob = model_of(MotorPendulum{}, {1, 0, 0, 0});
  EXPECT_EQ(said_of("rattle", bob),
            "rattle keeps the constraints of a motion that an energy makes alone; forced has applied forces, "
            "which methods for vector fields take, beside a formulation of its constraints");
  EXPECT_EQ(said_of("gauss", model_written(driven_text)), "");
  const auto edge = model_of(DrivenEdge{}, {0, 0, 0, 1, 0, 1});
  EXPECT_EQ(said_of("nonholonomic-lobatto", edge)
                .find("nonholonomic-lobatto keeps the constraints of a motion that an "
                      "energy makes alone"),
            0U);
  EXPECT_EQ(formulations().get("vakonomic", "formulation").refuses(*edge),
            "formulation vakonomic makes the motion of a Hamiltonian; forced has applied forces");
}
TEST(AppliedForce, WhatItDoesNotStandBesideIsRefused) {
  const std::string state = "coordinates = [\"q\", \"p\"]\n", force = "applied_force = [\"-p\"]\n",
                    energies = "kinetic = \"p^2/2\"\npotential = \"q^2/2\"\n";
  EXPECT_EQ(refusal_written(state + "field = [\"p\", \"-q\"]\n" + force),
            "model.toml:3:1: applied_force is written beside a canonical energy (kinetic and potential, or "
            "hamiltonian without bracket), which is missing");
  EXPECT_EQ(
      refusal_written(state + energies + force + "damping = 0.1\n"),
      "model.toml:5:1: damping beside applied_force: expected -nu p as a part of applied_force instead");
  EXPECT_EQ(refusal_written(state + energies + "applied_force = [\"-p\", 0]\n"),
            "model.toml:4:17: applied_force: expected 1 expression, got 2");
  EXPECT_EQ(
      refusal_written(state + energies + force + "symmetric_bracket = [[0, 0], [0, 1]]\n"),
      "model.toml:4:1: applied_force stands beside an energy, holonomic and velocity constraints; expected "
      "no symmetric_bracket");
}
}  // namespace
