// Methods that keep constraints, on kinetic energies that depend on time. Expected values are Taylor
// solutions of 45 digits of the pendulum's angle and its momentum, made with mpmath.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraints.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::after_steps;
using testing::method_named;

// A pendulum of length 1 in the plane with V = y and T = |p|^2/(2 (1 + t/2)), or T = |p|^2/2 + t |p|^4/4,
// which is quadratic at t = 0 alone. It starts at the angle -1/2 with P = 3/10.
struct TimedPendulum {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 1;
  bool quartic = false;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    const T square = p[0] * p[0] + p[1] * p[1];
    return quartic ? T(square / 2 + t * square * square / 4) : T(square / (2 * (1 + t / 2)));
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] - 1) / 2;
  }
};
std::shared_ptr<const Model> pendulum(bool quartic) {
  return make_model({.name = "timed-pendulum",
                     .title = "",
                     .reference = "",
                     .initial = {*Real::parse("0.87758256189037271611628158260383"),
                                 *Real::parse("-0.479425538604203000273287935215571"),
                                 *Real::parse("0.143827661581260900081986380564671"),
                                 *Real::parse("0.263274768567111814834884474781149")}},
                    TimedPendulum{quartic});
}
// Where it is at t = 2.
std::vector<Quad> end_of(bool quartic) {
  const std::array<const char*, 4> growing{
      "0.428865017369878258792964814169288", "-0.903368583069133536808009692950808",
      "-1.12033102549301204102155544247835", "-0.531865723153341467030479866778492"},
      fourth{"-0.639899760730052079674693680510882", "-0.768458389385932918207367643911386",
             "-0.578007148710116452997294120556809", "0.481309907300797013930400396710748"};
  std::vector<Quad> z;
  for (const char* x : quartic ? fourth : growing) z.push_back(Real::parse(x)->quad());
  return z;
}

// The first `count` components are compared: positions alone, or momenta too.
double error_after(const MethodInstance& method, bool quartic, int steps, std::size_t count = 4) {
  const auto z = after_steps<Quad>(method, pendulum(quartic), Quad(2) / Quad(steps), steps);
  const std::vector<Quad> expected = end_of(quartic);
  Quad worst(0);
  for (std::size_t k = 0; k < count; ++k) worst = std::max(worst, abs(z[k] - expected[k]));
  return static_cast<double>(worst);
}
double slope_of(const MethodInstance& method, bool quartic, int steps, std::size_t count = 4) {
  return std::log2(error_after(method, quartic, steps, count) /
                   error_after(method, quartic, 2 * steps, count));
}

// Slopes are within .2 of the order: the next term of the error is an h or h^2 smaller.
TEST(TimedConstrainedEnergy, MethodsHaveTheirOrder) {
  for (const bool quartic : {false, true}) {
    EXPECT_NEAR(slope_of(*method_named("rattle"), quartic, 64), 2, 0.1) << quartic;
    EXPECT_NEAR(slope_of(*method_named("shake"), quartic, 64), 2, 0.1) << quartic;
    EXPECT_NEAR(slope_of(*method_named("lincs"), quartic, 64), 2, 0.2) << quartic;
    EXPECT_NEAR(slope_of(*method_named("yoshida-rattle", {{"order", "4"}}), quartic, 64), 4, 0.2) << quartic;
    EXPECT_NEAR(slope_of(*method_named("yoshida-rattle", {{"order", "6"}}), quartic, 64), 6, 0.3) << quartic;
    EXPECT_NEAR(slope_of(*method_named("lobatto-spark", {{"stages", "3"}}), quartic, 32), 4, 0.2) << quartic;
  }
}

// Both levels of constraints hold to round-off at the ends of steps, and a step of -h undoes one of h.
TEST(TimedConstrainedEnergy, RattleKeepsConstraintsAndIsSymmetric) {
  for (const bool quartic : {false, true}) {
    const auto model = pendulum(quartic);
    const auto method = method_named("rattle");
    const Quad h = Quad(1) / Quad(20);
    const auto start = after_steps<Quad>(*method, model, h, 20);
    ConstraintResiduals<Quad> residuals_of(*model);
    std::vector<Quad> residuals;
    residuals_of(Quad(1), start, residuals);
    for (const Quad& x : residuals) EXPECT_LT(static_cast<double>(abs(x)), 1e-31) << quartic;
    auto z = after_steps<Quad>(*method, model, h, 1, start, Quad(1));
    z = after_steps<Quad>(*method, model, -h, 1, z, Quad(1) + h);
    for (std::size_t k = 0; k < z.size(); ++k)
      EXPECT_LT(static_cast<double>(abs(z[k] - start[k])), 1e-30) << quartic;
  }
}

// A blade on a plane whose mass grows, pushed about by a potential: v_y = x v_x.
struct TimedBlade {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    const T square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    return square / (2 * (1 + t / 2)) + t * square * square / 8;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) / 2 + q[0] * q[1] * q[2] * (1 + t);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[2];
    rows[1] = T(1);
    rows[2] = T(0);
  }
};

// The reference is another method and another form of the equations: Gauss collocation of order 12 of the
// field that the formulation makes.
TEST(TimedConstrainedEnergy, MethodsOfVelocityConstraintsHaveTheirOrder) {
  const auto model = make_model({.name = "timed-blade",
                                 .title = "",
                                 .reference = "",
                                 .initial = {0.5_r, 0.1_r, 0.25_r, 0.4_r, 0.1_r, 0.3_r}},
                                TimedBlade());
  const auto expected =
      after_steps<Quad>(*method_named("gauss", {{"stages", "6"}}), motion_of(model), Quad(1) / Quad(64), 64);
  const auto error = [&](const MethodInstance& method, int steps) {
    const auto z = after_steps<Quad>(method, model, Quad(1) / Quad(steps), steps);
    Quad worst(0);
    for (std::size_t k = 0; k < z.size(); ++k) worst = std::max(worst, abs(z[k] - expected[k]));
    return static_cast<double>(worst);
  };
  for (const char* name : {"dla", "gni", "nonholonomic-leap-frog", "mclachlan-perlmutter"}) {
    const auto method = method_named(name);
    EXPECT_NEAR(std::log2(error(*method, 64) / error(*method, 128)), 2, 0.15) << name;
  }
}

}  // namespace
}  // namespace pfaff
