// The Jacobian of a step and the structure residual made from it: at round-off for methods that preserve the
// structure, and clearly above it for others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/core/integrator.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/method_on_model.hpp>

#include "../formula_values.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::model_named;

std::unique_ptr<MethodInstance> method_of(const std::string& name, const Assignments& set = {}) {
  return integrators().get(name, "integrator").make(set);
}
// Off any symmetry, at a time that is not 0.
template <class T>
double residual(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  std::vector<T> z;
  for (const Real& x : model->initial()) z.push_back(T(x) + T(0.07 + 0.03 * static_cast<double>(z.size())));
  return static_cast<double>(StructureResidual<T>(method, model)(T(0.37), T(0.1), z));
}

TEST(Structure, RungeKuttaDoesNotKeepIt) {
  const auto rk4 = method_of("rk4");
  for (const char* name : {"pendulum", "damped-pendulum", "henon-heiles", "kepler"}) {
    EXPECT_GT(residual<double>(*rk4, model_named(name)), 1e-9) << name;
    EXPECT_NEAR(residual<Quad>(*rk4, model_named(name)) / residual<double>(*rk4, model_named(name)), 1, 1e-3)
        << name;
  }
}

TEST(Structure, GeneratingFunctionsKeepItToRoundOffInBothPrecisions) {
  for (const char* order : {"1", "2", "3", "6"})
    for (const char* name : {"damped-pendulum", "damped-oscillator", "pendulum", "kepler"}) {
      const auto method =
          method_of("generating-function", {{"order", order}, {"variant", "P"}, {"extra", "0"}});
      EXPECT_LE(residual<double>(*method, model_named(name)), 1e-14) << name << ' ' << order;
      EXPECT_LE(residual<Quad>(*method, model_named(name)), 1e-31) << name << ' ' << order;
    }
}

// The midpoint rule keeps constant structures and not e^{nu t} K: the residual is that of the structure it is
// given.
TEST(Structure, TheMidpointRuleKeepsConstantStructureOnly) {
  const auto midpoint = method_of("implicit-midpoint");
  EXPECT_LE(residual<Quad>(*midpoint, model_named("pendulum")), 1e-31);
  EXPECT_GT(residual<Quad>(*midpoint, model_named("damped-pendulum")), 1e-6);
  EXPECT_LE(residual<Quad>(*midpoint, model_named("damped-pendulum", {{"nu", "0"}})), 1e-31);
}

TEST(Structure, VerletInQuad) {
  EXPECT_LE(residual<Quad>(*method_of("verlet"), model_named("kepler")), 1e-31);
}

TEST(Structure, AppliesWhereThereIsOne) {
  EXPECT_TRUE(StructureResidual<double>::applies(*model_named("damped-pendulum")));
  EXPECT_TRUE(StructureResidual<double>::applies(*model_named("kepler")));
  EXPECT_FALSE(StructureResidual<double>::applies(*model_named("relaxing-rigid-body")));
}

TEST(Structure, IsNamedAsItIsMeasured) {
  const auto pendulum = model_named("spherical-pendulum");
  EXPECT_EQ(structure_name(*pendulum), "constrained-symplectic");
  EXPECT_EQ(structure_name(*motion_of(pendulum)), "constrained-symplectic");
  EXPECT_EQ(structure_name(*model_named("damped-pendulum")), "K-symplectic");
  EXPECT_EQ(structure_name(*model_named("pendulum")), "symplectic");
  EXPECT_EQ(structure_name(*model_named("free-rigid-body")), "poisson");
  EXPECT_EQ(structure_name(*model_named("relaxing-rigid-body")), "");  // dissipates: nothing is kept
}

// The flow of a motion on constraints with friction contracts the form; without friction it keeps it.
TEST(Structure, IsNoneWhereConstraintsHaveFriction) {
  const SystemPlugin& ring = systems().get("ring", "system");
  EXPECT_EQ(structure_name(*ring.make({{"friction", "0"}})), "constrained-symplectic");
  EXPECT_EQ(structure_name(*ring.make({{"friction", "0.5"}})), "");
  EXPECT_EQ(structure_name(*motion_of(ring.make({{"friction", "0.5"}}))), "");
}

TEST(Structure, JacobianOfAStepOfRK4IsItsStabilityPolynomial) {
  const auto model = model_named("harmonic-oscillator");
  const Quad h(0.5);
  const auto step = StepDifferentiator<Quad>(*method_of("rk4"), model)(Quad(0), h, {Quad(0.3), Quad(-0.2)});
  // R(A h) with A = [[0, 1], [-1, 0]]: 1 - h^2/2 + h^4/24 on the diagonal, h - h^3/6 off it.
  const Quad c = Quad(1) - h * h / Quad(2) + h * h * h * h / Quad(24), s = h - h * h * h / Quad(6);
  const std::vector<Quad> expected{c, s, -s, c};
  ASSERT_EQ(step.status, Status::converged);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LE(abs(step.jacobian[k] - expected[k]), Quad(1e-32)) << k;
  EXPECT_LE(abs(step.z[0] - (c * Quad(0.3) - s * Quad(0.2))), Quad(1e-32));
}

TEST(Structure, CongruenceByHand) {
  const std::vector<double> k{0, -1, 1, 0};
  EXPECT_EQ(congruence_residual<double>({1, 0, 0, 1}, k, k), 0);
  EXPECT_EQ(congruence_residual<double>({2, 0, 0, 0.5}, k, k), 0);  // determinant 1
  EXPECT_EQ(congruence_residual<double>({1, 7, 0, 1}, k, k), 0);
  EXPECT_EQ(congruence_residual<double>({2, 0, 0, 1}, k, k), 0.5);  // M^T K M = 2 K: |2 - 1| / 2
  EXPECT_EQ(congruence_residual<double>({1, 0, 0, 1}, {0, -3, 3, 0}, k), 2.0 / 3);
  EXPECT_TRUE(std::isnan(congruence_residual<double>({NAN, 0, 0, 1}, k, k)));
}

// The explicit Euler method, whose first coordinate has derivatives that are off by a part in 10^20.
struct WronglyDifferentiated {
  template <class P>
  struct Work {
    State<P> slope;
    Work(const WronglyDifferentiated& /*method*/, const P& p) : slope(p.make_state()) {}
  };
  template <class T>
  static T spoilt(const T& x) {
    return x;
  }
  template <class T, int N>
  static Dual<T, N> spoilt(Dual<T, N> x) {
    for (T& d : x.derivative) d = d * (T(1) + T(1e-20));
    return x;
  }
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < z.size(); ++k) {
      const auto moved = z[k] + h * w.slope[k];
      z[k] = k == 0 ? spoilt(moved) : moved;
    }
    return Status::converged;
  }
};

// On a chain with a skate the field amplifies rounding by some hundred, and with it the displacements.
TEST(Structure, JacobiansAreThoseOfTheStep) {
  static const Method<WronglyDifferentiated> wrong{{.name = "wrongly-differentiated",
                                                    .title = "",
                                                    .reference = "",
                                                    .order = 1,
                                                    .preserves = {Claim::none}}};
  const auto jacobian = [](const std::vector<Check>& checks) {
    return *std::find_if(checks.begin(), checks.end(),
                         [](const Check& c) { return c.claim == "step-jacobian"; });
  };
  const auto of_wrong = jacobian(check_method(wrong, {}, systems().get("pendulum", "system")));
  EXPECT_EQ(of_wrong.result, CheckResult::fail);
  EXPECT_NEAR(of_wrong.measured, 1e-20, 1e-22);
  // Of many coordinates not every one is moved alone; one wrong row of 64 is found all the same.
  const auto of_many = wrong.make({});
  MethodOnModel on_many(*of_many, {}, "fermi-pasta-ulam-tsingou", model_named("fermi-pasta-ulam-tsingou"));
  const Check many = check_step_jacobian(on_many);
  EXPECT_EQ(many.result, CheckResult::fail);
  EXPECT_GT(many.measured, 1e-21);
  EXPECT_LT(many.measured, 1e-19);
  const auto chain = model_named("skate-chain");
  for (const char* name : {"dla", "nonholonomic-discrete-gradient"}) {
    const auto method = method_of(name);
    MethodOnModel on(*method, {}, "skate-chain", chain);
    EXPECT_LE(check_step_jacobian(on).measured, 1e-25) << name;
  }
}

}  // namespace
