// Methods for velocity constraints: what they keep, how fast they converge to reference flows, and which
// pairings they refuse. That their steps allocate nothing is tested with that of all others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/runs/way_back.hpp>
#include <pfaff/tests/integrators/nonholonomic_samples.hpp>

namespace pfaff {
namespace {
using namespace nonholonomic;
using ::testing::HasSubstr;

const std::vector<const char*> one_step{"dla", "mclachlan-perlmutter", "nonholonomic-discrete-gradient",
                                        "nonholonomic-lobatto"},
    all{"dla", "gni", "nonholonomic-leap-frog", "mclachlan-perlmutter", "nonholonomic-discrete-gradient"};

// The slope of the errors at T = 1 from reference flows of 36 digits, between `steps` steps and twice as
// many.
double measured_slope(const MethodInstance& m, std::size_t k, std::int64_t steps) {
  const auto model = golden_models()[k];
  const auto flow = numbers<Quad>(golden_cases()[k]["flow T=1 (q,v)"]);
  const auto error = [&](std::int64_t count) {
    const auto z =
        after_steps(m, model, Quad(1) / Quad(static_cast<double>(count)), count, initial_state<Quad>(*model));
    return distance(joined(positions(z), velocity(*model, z)), flow);
  };
  return std::log2(error(steps) / error(2 * steps));
}

TEST(Nonholonomic, MethodsHaveOrderTwo) {
  for (const char* name : all)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto m = method_named(name);
      if (!m->refuses(*golden_models()[k]).empty()) continue;
      EXPECT_NEAR(measured_slope(*m, k, 64), 2, 0.03) << name << ' ' << k;
    }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(
        measured_slope(*method_named("nonholonomic-discrete-gradient", {{"form", "multipliers"}}), k, 64), 2,
        0.05);
}
TEST(Nonholonomic, LobattoPairsHaveOrderTwoLessThanTwiceTheirStages) {
  for (const int stages : {2, 3, 4})
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(
          measured_slope(*method_named("nonholonomic-lobatto", {{"stages", std::to_string(stages)}}), k, 16),
          2 * stages - 2, 0.1)
          << stages << ' ' << k;
}
TEST(Nonholonomic, LobattoPairHasItsFormerName) {
  const auto model = golden_models()[0];
  EXPECT_EQ(after_steps(*method_named("spark-lobatto"), model, 0.01, 3),
            after_steps(*method_named("nonholonomic-lobatto"), model, 0.01, 3));
}
TEST(Nonholonomic, CompositionsReachHigherOrders) {
  EXPECT_NEAR(measured_slope(*composed("dla", "suzuki", "4"), 0, 16), 4, 0.1);
  EXPECT_NEAR(measured_slope(*composed("dla", "suzuki", "4"), 3, 16), 4, 0.1);
  EXPECT_NEAR(measured_slope(*composed("dla", "kahan-li", "6"), 2, 16), 6, 0.1);
  EXPECT_NEAR(measured_slope(*composed("dla", "kahan-li", "8"), 0, 8), 8, 0.3);
}
// Control: sub-steps of these leave an error that depends on their size (see their files).
TEST(Nonholonomic, OtherMethodsCannotBeComposed) {
  for (const char* base :
       {"gni", "nonholonomic-leap-frog", "mclachlan-perlmutter", "nonholonomic-discrete-gradient"}) {
    try {
      (void)composed(base, "suzuki", "4");
      FAIL() << base;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("it does not say how it is composed"));
    }
  }
}

template <class T>
constexpr double round_off = std::is_same_v<T, Quad> ? 1e-31 : 2e-14;

template <class T>
void constraints_hold() {
  for (const auto& model : golden_models())
    for (const char* name :
         {"dla", "gni", "nonholonomic-leap-frog", "nonholonomic-discrete-gradient", "nonholonomic-lobatto"}) {
      const auto m = method_named(name);
      if (!m->refuses(*model).empty()) continue;
      EXPECT_LE(
          slip(*model, T(0), after_steps(*m, model, T(Real::fraction(1, 20)), 40, initial_state<T>(*model))),
          round_off<T> / 10)
          << name << ' ' << model->name();
    }
}
TEST(Nonholonomic, ConstraintsHoldAtTheEndsOfSteps) {
  constraints_hold<double>();
  constraints_hold<Quad>();
}
TEST(Nonholonomic, OnesInTheMiddleDoNot) {  // control, and what the description says: of order h^2
  const auto model = golden_models().front();
  const auto slip_of = [&](double h) {
    return slip(*model, Quad(0),
                after_steps(*method_named("mclachlan-perlmutter"), model, Quad(h), std::int64_t(1 / h),
                            initial_state<Quad>(*model)));
  };
  EXPECT_GT(slip_of(0.0625), 1e-5);
  EXPECT_NEAR(std::log2(slip_of(0.03125) / slip_of(0.015625)), 2, 0.2);
}

TEST(Nonholonomic, DiscreteGradientKeepsEnergies) {
  for (const auto& model : golden_models()) {
    EXPECT_LE(energy_error(*method_named("nonholonomic-discrete-gradient"), model), 1e-31) << model->name();
    EXPECT_LE(energy_error(*method_named("nonholonomic-discrete-gradient", {{"form", "multipliers"}}), model),
              1e-31);
    EXPECT_GT(energy_error(*method_named("gni"), model), 1e-7) << model->name();  // control
  }
  EXPECT_GT(energy_error(*method_named("dla"), golden_models()[0]), 1e-6);
}

template <class T>
void steps_are_symmetric() {
  for (const auto& model : golden_models())
    for (const char* name : one_step) {
      const auto m = method_named(name);
      if (!m->refuses(*model).empty()) continue;
      const auto start = initial_state<T>(*model);
      const T h(Real::fraction(1, 10));
      const auto there = after_steps(*m, model, h, 1, start);
      EXPECT_LE(distance(after_steps(*m, model, T(-h), 1, there), start), round_off<T>)
          << name << ' ' << model->name();
      auto reversed = values(*model, Formula::reversal, T(0), there);
      reversed = values(*model, Formula::reversal, T(0), after_steps(*m, model, h, 1, reversed));
      EXPECT_LE(distance(reversed, start), round_off<T>) << name << ' ' << model->name();
    }
}
TEST(Nonholonomic, StepsAreSymmetricAndReversible) {
  steps_are_symmetric<double>();
  steps_are_symmetric<Quad>();
}
// Methods that carry a reaction are so together with it: ten steps there and back with one stepper.
TEST(Nonholonomic, StaggeredStepsAreSymmetricWithTheReactionTheyCarry) {
  for (const auto& model : golden_models())
    for (const char* name : staggered) {
      const auto m = method_named(name);
      if (!m->refuses(*model).empty()) continue;
      const Quad h(0.0625);
      const auto start = initial_state<Quad>(*model);
      for (const bool by_reversal : {false, true}) {
        Integration<Quad> run(start_with(*m, model, start, h, Quad(0)));
        run.steps(10).expect_reached();
        const auto z = WayBack<Quad>(by_reversal ? model : nullptr)(run, 10);
        ASSERT_TRUE(z);
        EXPECT_LE(distance(*z, start), 1e-31) << name << ' ' << model->name() << ' ' << by_reversal;
      }
      // Control: forgetting the reaction spoils it.
      const auto there = after_steps(*m, model, h, 10, start);
      EXPECT_GT(distance(after_steps(*m, model, Quad(-h), 10, there), start), 1e-6)
          << name << ' ' << model->name();
    }
}

// The edge turns freely, its spin p_theta being along a direction that the constraint allows.
TEST(Nonholonomic, MomentaOfAllowedSymmetriesAreKept) {
  const auto edge = golden_models()[1];
  const auto start = initial_state<Quad>(*edge);
  for (const char* name :
       {"dla", "gni", "nonholonomic-leap-frog", "mclachlan-perlmutter", "nonholonomic-lobatto"})
    EXPECT_LE(static_cast<double>(
                  abs(after_steps(*method_named(name), edge, Quad(0.125), 40, start)[5] - start[5])),
              1e-32)
        << name;
  const auto other = method_named("nonholonomic-discrete-gradient", {{"form", "multipliers"}});
  EXPECT_GT(static_cast<double>(abs(after_steps(*other, edge, Quad(0.125), 40, start)[5] - start[5])),
            1e-6);  // control
}

// An edge on a belt that moves sideways and ever faster, b(q, t) != 0, in a field that depends on time.
struct Belt : testing::KnifeEdge {
  template <class T>
  T potential(const T& t, In<T> q) const {
    return q[0] * q[1] + q[2] * sin(t);
  }
  template <class T>
  void velocity_offsets(const T& t, In<T> q, Out<T> b) const {
    b[0] = (1 + t * t) * cos(q[2]);
  }
};
// z' by hand, with unit mass and J = 1/2: A A^T = 1 for the metric, and lambda makes the rate of A v + b
// zero.
std::vector<Quad> belt_rate(const Quad& t, const std::vector<Quad>& z) {
  const Quad s = sin(z[2]), c = cos(z[2]), w = Quad(2) * z[5];
  const Quad fx = -z[1], fy = -z[0];
  const Quad rate = w * (c * z[3] + s * z[4]) + Quad(2) * t * c - (Quad(1) + t * t) * s * w;
  const Quad lambda = s * fx - c * fy + rate;
  return {z[3], z[4], w, fx - s * lambda, fy + c * lambda, -sin(t)};
}
std::vector<Quad> belt_flow(std::vector<Quad> z, int steps) {
  const Quad h = Quad(1) / Quad(steps);
  const auto moved = [](const std::vector<Quad>& a, const Quad& length, const std::vector<Quad>& b) {
    std::vector<Quad> sum = a;
    for (std::size_t k = 0; k < a.size(); ++k) sum[k] += length * b[k];
    return sum;
  };
  for (int i = 0; i < steps; ++i) {
    const Quad t = Quad(i) * h, half = h / Quad(2);
    const auto k1 = belt_rate(t, z), k2 = belt_rate(t + half, moved(z, half, k1)),
               k3 = belt_rate(t + half, moved(z, half, k2)), k4 = belt_rate(t + h, moved(z, h, k3));
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] += h / Quad(6) * (k1[k] + Quad(2) * k2[k] + Quad(2) * k3[k] + k4[k]);
  }
  return z;
}
TEST(Nonholonomic, MovingConstraintsAreFollowed) {
  const auto model = testing::model_of<Belt>("belt");
  std::vector<Quad> start{Quad(0.5), Quad(0.25), Quad(0.375), Quad(0), Quad(0), Quad(0.25)};
  start[4] = Quad(1);  // sin(theta) x' - cos(theta) y' + cos(theta) = 0
  ASSERT_LE(slip(*model, Quad(0), start), 1e-33);
  const auto flow = belt_flow(start, 4000);  // the error of RK4 at h = 1/4000 is below 1e-13
  for (const char* name : all) {
    const auto m = method_named(name);
    const auto error = [&](std::int64_t count) {
      const auto z = after_steps(*m, model, Quad(1) / Quad(static_cast<double>(count)), count, start);
      const bool at_ends = std::string(name) != "mclachlan-perlmutter";
      EXPECT_LE(slip(*model, Quad(1), z), at_ends ? 1e-32 : 1e-2) << name;
      return distance(z, flow);
    };
    EXPECT_NEAR(std::log2(error(64) / error(128)), 2, 0.05) << name;
  }
  const auto eighth = after_steps(*composed("dla", "kahan-li", "8"), model, Quad(1) / Quad(32), 32, start);
  EXPECT_LE(distance(eighth, flow), 1e-12);
  const auto lobatto = [&](std::int64_t count) {
    const auto z = after_steps(*method_named("nonholonomic-lobatto"), model,
                               Quad(1) / Quad(static_cast<double>(count)), count, start);
    EXPECT_LE(slip(*model, Quad(1), z), 1e-32);
    return distance(z, flow);
  };
  EXPECT_NEAR(std::log2(lobatto(16) / lobatto(32)), 4, 0.1);
}

TEST(Nonholonomic, PairingsThatMakeNoSenseAreRefused) {
  const auto models = golden_models();
  for (const char* name : {"rattle", "shake", "lobatto-spark", "verlet", "rk4"})
    EXPECT_THAT(method_named(name)->refuses(*models[0]), HasSubstr(std::string(name) + " needs")) << name;
  for (const char* name : {"nonholonomic-leap-frog", "mclachlan-perlmutter"})
    EXPECT_THAT(method_named(name)->refuses(*models[3]), HasSubstr(": take dla or gni")) << name;
  const auto pendulum = systems().get("pendulum", "system").make({});
  for (const auto& names : {all, {"nonholonomic-lobatto"}})
    for (const char* name : names)
      EXPECT_THAT(method_named(name)->refuses(*pendulum), HasSubstr("needs velocity-constraints")) << name;
  for (const Claim claim : {Claim::symplectic, Claim::k_symplectic, Claim::poisson, Claim::volume})
    EXPECT_FALSE(in_scope(claim, *models[0])) << to_string(claim);
}

TEST(Nonholonomic, StepsThatAreTooLargeAreReported) {
  const auto model = golden_models()[0];
  for (const char* name : {"dla", "gni", "nonholonomic-discrete-gradient", "nonholonomic-lobatto"}) {
    const auto stepper = method_named(name)->stepper(model, double());
    auto z = initial_state<double>(*model);
    const auto before = z;
    std::int64_t done = 0;
    EXPECT_NE(stepper->advance(0.0, 0, 100.0, 1, z, done), Status::converged) << name;
    EXPECT_EQ(z, before) << name;
    EXPECT_EQ(stepper->advance(0.0, 0, 0.01, 1, z, done), Status::converged) << name;
  }
}

}  // namespace
}  // namespace pfaff
