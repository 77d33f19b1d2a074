// Collocation: coefficients that are symplectic to the last bit, and the form of second order, which makes
// the steps of the form of first order in half the iterations.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/runge_kutta/collocation_coefficients.hpp>
#include <pfaff/integrators/runge_kutta/stage_convergence.hpp>
#include <pfaff/runs/integrate.hpp>

#include "../formula_values.hpp"

namespace pfaff {
namespace {

template <class Number>
void symplectic_to_the_last_bit() {
  // In double half a spacing, of 1 or 2 units, and what one triangle takes over from the other. In quad the
  // tableau itself is known to some units only, and weights as small as 0.013 divide it.
  const double allowed =
      std::is_same_v<Number, double> ? 3 * static_cast<double>(unit_roundoff<Number>()) : 2e-31;
  for (int stages = 1; stages <= 16; ++stages) {
    const GaussCoefficients g = gauss_coefficients(stages);
    const CollocationCoefficients<Number> c(g);
    const std::size_t s = c.stages;
    bool rounded_one_by_one = true;
    for (std::size_t i = 0; i < s; ++i) {
      EXPECT_EQ(c.counted[i], Number(1));
      EXPECT_EQ(c.nodes[i] + c.beta[i], Number(1)) << stages;
      EXPECT_EQ(c.nodes[i] + c.nodes[s - 1 - i], Number(1)) << stages;
      EXPECT_LE(static_cast<double>(abs(Quad(c.nodes[i]) - g.nodes[i])), allowed);
      for (std::size_t j = 0; j < s; ++j) {
        EXPECT_EQ(c.mu[i * s + j] + c.mu[j * s + i], Number(1)) << stages;
        EXPECT_EQ(c.nu[i * s + j] - c.nu[j * s + i], c.nodes[i] - c.nodes[j]) << stages;
        const std::size_t mirror = (s - 1 - j) * s + (s - 1 - i);
        EXPECT_EQ(c.mu[i * s + j], c.mu[mirror]) << stages;
        EXPECT_TRUE(i == j || c.nu[i * s + j] == c.nu[mirror]) << stages;
        const Quad exact = g.matrix[i * s + j] / g.weights[j];
        Quad twice(0);
        for (std::size_t k = 0; k < s; ++k) twice += g.matrix[i * s + k] * g.matrix[k * s + j];
        EXPECT_LE(static_cast<double>(abs(Quad(c.mu[i * s + j]) - exact)), allowed) << stages;
        EXPECT_LE(static_cast<double>(abs(Quad(c.nu[i * s + j]) - twice / g.weights[j])), allowed) << stages;
        const Number plain = Number(Real(exact)), other = Number(Real(g.matrix[j * s + i] / g.weights[i]));
        rounded_one_by_one = rounded_one_by_one && plain + other == Number(1) && c.mu[i * s + j] == plain;
      }
    }
    EXPECT_TRUE(stages <= 2 || !rounded_one_by_one) << stages;  // the control
  }
}
TEST(CollocationCoefficients, AreSymplecticToTheLastBit) {
  symplectic_to_the_last_bit<double>();
  symplectic_to_the_last_bit<Quad>();
}

TEST(CollocationCoefficients, OfAMethodThatIsNotSymplecticStayAsTheyAre) {
  GaussCoefficients g = gauss_coefficients(3);
  g.weights[0] += Quad(1e-6);
  const CollocationCoefficients<double> c(g);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(c.mu[k], static_cast<double>(g.matrix[k] / g.weights[k % 3]));
  EXPECT_GT(std::abs(c.mu[1] + c.mu[3] - 1), 1e-7);
}

// Two masses that move each other's velocity, a force that depends on time.
struct CoupledMasses {
  static constexpr int dimension = 4;
  Real stiffness = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&CoupledMasses::stiffness, "stiffness", "", 0, 1000000)};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2 + p[0] * p[1] / 5 + p[1] * p[1] / 3;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return T(stiffness) * q[0] * q[0] / 2 + cos(q[0] - q[1]) + sin(t) * q[1] + q[1] * q[1] * q[1] * q[1] / 4;
  }
};

// An energy that is separable but not quadratic in the momenta.
struct Fast {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return sqrt(1 + p[0] * p[0]);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -cos(q[0]);
  }
};

std::shared_ptr<const Model> masses(const Real& stiffness = 1) {
  return make_model({.name = "masses", .title = "", .reference = "", .initial = {0.5_r, -0.3_r, 0.2_r, 1}},
                    CoupledMasses{stiffness});
}
std::shared_ptr<const Model> fast() {
  return make_model({.name = "fast", .title = "", .reference = "", .initial = {1, 2}}, Fast{});
}

template <class T>
struct CollocationRun {
  std::vector<T> z;
  Counters counters;
};
template <class T>
CollocationRun<T> run_collocation(const std::string& method, const std::shared_ptr<const Model>& model,
                                  int stages, const Real& step, std::int64_t steps) {
  auto run =
      integrate<T>(model, integrators().get(method, "").make({{"stages", std::to_string(stages)}}), T(step));
  run.steps(steps).expect_reached();
  return {{run.state().begin(), run.state().end()}, run.counters()};
}

// In canonical coordinates gauss-darboux is the method in its form of first order. Both solve their stages to
// round-off, which a hundred steps multiply by a thousand at most.
template <class T>
void both_forms_agree(const std::shared_ptr<const Model>& model, int stages, const Real& step) {
  const auto second = run_collocation<T>("gauss", model, stages, step, 100),
             first = run_collocation<T>("gauss-darboux", model, stages, step, 100);
  const double tolerance = 2000 * static_cast<double>(unit_roundoff<T>());
  for (std::size_t k = 0; k < first.z.size(); ++k)
    EXPECT_LE(static_cast<double>(abs(second.z[k] - first.z[k])),
              tolerance * std::max(1.0, std::abs(static_cast<double>(first.z[k]))))
        << model->name() << ' ' << stages << ' ' << k;
}
TEST(Collocation, TheFormsOfFirstAndOfSecondOrderMakeTheSameSteps) {
  const auto kepler = systems().get("kepler", "").make({}),
             henon = systems().get("henon-heiles", "").make({});
  for (const auto& model : {kepler, henon, masses(), fast()})
    for (const int stages : {2, 3, 5, 9}) {
      both_forms_agree<double>(model, stages, 0.1_r);
      both_forms_agree<Quad>(model, stages, 0.1_r);
    }
}

TEST(Collocation, ItIsTheSecondOrderThatHalvesTheIterations) {
  const auto counts = [](const std::shared_ptr<const Model>& model) {
    return std::pair(run_collocation<double>("gauss", model, 4, 0.1_r, 200).counters.iterations,
                     run_collocation<double>("gauss-darboux", model, 4, 0.1_r, 200).counters.iterations);
  };
  const auto [second, first] = counts(masses());
  EXPECT_LT(second, 0.67 * static_cast<double>(first));
  const auto [same, as_well] = counts(fast());  // not quadratic: the form of first order in both
  EXPECT_EQ(same, as_well);
}

TEST(Collocation, NewtonTakesOverWhereStepsAreLong) {
  const auto stiff = masses(Real(40000));  // h omega = 10
  const auto second = run_collocation<double>("gauss", stiff, 3, 0.05_r, 20),
             first = run_collocation<double>("gauss-darboux", stiff, 3, 0.05_r, 20);
  EXPECT_EQ(second.counters.factorisations, 20);
  // Momenta are 200 times the positions, and errors of the stages are multiplied by h omega.
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(second.z[k], first.z[k], k < 2 ? 1e-12 : 2e-10) << k;
}

// A component that is no number ends the iteration whichever others are judged after it.
TEST(StageConvergence, LosesNoNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), small = 1e-20;
  for (const bool in_turns : {false, true})
    for (const auto& [first, second] : {std::pair(nan, small), std::pair(small, nan)}) {
      StageConvergence<double> convergence(in_turns);
      convergence.begin_iteration();
      convergence.add(0, first, first);
      convergence.add(0, second, second);
      EXPECT_TRUE(convergence.finished());
      EXPECT_EQ(convergence.status(), Status::non_finite);
    }
  StageConvergence<double> control(false);
  control.begin_iteration();
  for (int k = 0; k < 2; ++k) control.add(0, small, small);
  EXPECT_TRUE(control.finished());
  EXPECT_EQ(control.status(), Status::converged);
}

TEST(Collocation, AStateChangedFromOutsideStartsAfresh) {
  for (const auto& model : {masses(), systems().get("kepler", "").make({})}) {
    const auto method = integrators().get("gauss", "").make({{"stages", "4"}});
    const auto used = method->stepper(model, 0.0), fresh = method->stepper(model, 0.0);
    std::vector<double> z;
    for (const Real& x : model->initial()) z.push_back(x.value());
    std::int64_t completed = 0;
    used->advance(0.0, 0, 0.1, 7, z, completed);
    z[3] += 1e-3;
    std::vector<double> other = z;
    used->advance(0.0, 7, 0.1, 1, z, completed);
    fresh->advance(0.0, 7, 0.1, 1, other, completed);
    EXPECT_EQ(z, other) << model->name();
  }
}

// Round-off without a bias is claimed of steps of second order, with enough stages and compensation.
TEST(Collocation, ClaimsUnbiasedRoundOffOfStepsOfSecondOrder) {
  const auto claimed = [](const std::shared_ptr<const Model>& model, const Assignments& parameters) {
    const std::vector<Claim> claims = integrators().get("gauss", "").make(parameters)->preserves(*model);
    return std::find(claims.begin(), claims.end(), Claim::unbiased_round_off) != claims.end();
  };
  EXPECT_TRUE(claimed(testing::model_named("pendulum"), {{"stages", "6"}}));
  EXPECT_TRUE(claimed(testing::model_named("kepler"), {{"stages", "6"}}));
  EXPECT_FALSE(claimed(testing::model_named("pendulum"), {{"stages", "5"}}));
  EXPECT_FALSE(claimed(testing::model_named("pendulum"), {{"stages", "6"}, {"compensated", "no"}}));
  EXPECT_FALSE(claimed(fast(), {{"stages", "6"}}));
  EXPECT_FALSE(claimed(testing::model_named("free-rigid-body"), {{"stages", "6"}}));
}

}  // namespace
}  // namespace pfaff
