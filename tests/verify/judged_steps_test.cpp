// Verification of methods that fail, remember, skip or are wrong by very little: each fault is found, and the
// same method without the fault passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/runs/history.hpp>
#include <pfaff/runs/support/chosen_steps.hpp>

#include "judged.hpp"

namespace {
using namespace pfaff;

MethodDescriptor described(std::string name, int order, std::vector<Claim> preserves = {Claim::none}) {
  return {.name = std::move(name),
          .title = "",
          .reference = "",
          .order = order,
          .preserves = std::move(preserves)};
}

using pfaff::testing::bad;
using pfaff::testing::Names;
using ClassicalInScalar = pfaff::testing::Classical<false>;

Names bad_on(const MethodPlugin& method, const char* system) {
  return bad(check_method(method, {}, systems().get(system, "system")));
}

// The explicit Euler method, which gives up on steps longer than a bound.
struct BoundedEuler {
  static constexpr double longest = 0.04;
  template <class P>
  struct Work {
    State<P> slope;
    Work(const BoundedEuler& /*method*/, const P& p) : slope(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if (abs(value_of(h)) > longest) return Status::not_converged;
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.slope[k];
    return Status::converged;
  }
};

TEST(JudgedSteps, AMethodIsJudgedAtAStepThatItCanTake) {
  static const Method<BoundedEuler> claims{described("bounded-euler", 1, {Claim::quadratic_invariants})};
  const auto checks = check_method(claims, {}, systems().get("harmonic-oscillator", "system"));
  const auto steps =
      std::find_if(checks.begin(), checks.end(), [](const Check& c) { return c.claim == "steps"; });
  ASSERT_NE(steps, checks.end());
  EXPECT_EQ(steps->result, CheckResult::pass);
  EXPECT_EQ(steps->measured, 0.025);
  EXPECT_EQ(bad(checks), (Names{"quadratic-invariants", "quadratic-invariants along a run"}));
}

struct Stuck {
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& /*z*/,
              NoWork& /*w*/) const {
    return Status::not_converged;
  }
};

// On one system it is not judged; where no system has judged it, it fails.
TEST(JudgedSteps, AMethodThatNeverStepsFails) {
  static const Method<Stuck> stuck{described("stuck", 2, {Claim::symplectic})};
  EXPECT_EQ(bad_on(stuck, "pendulum"), Names{});
  const auto failed = bad(verify({.names = {"stuck"}}));
  EXPECT_NE(std::find(failed.begin(), failed.end(), "steps"), failed.end());
}

struct Stateless {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return z[0] * z[0] + z[1] * z[1];
  }
};

// Whoever runs it states where it begins; a method is not to pay for that, and who asks for its claims is
// told.
TEST(JudgedSteps, ASystemWithoutAnInitialStateIsJudgedForNobody) {
  static const System<Stateless> stateless{{.name = "begins-anywhere",
                                            .title = "a test",
                                            .reference = "su-qin",
                                            .coordinates = {{"q", ""}, {"p", ""}}}};
  static const Method<Stuck> stuck{described("stuck-beside-it", 2, {Claim::none})};
  for (const Check& check : verify({.names = {"stuck-beside-it"}}))
    EXPECT_EQ(check.system.find("begins-anywhere"), std::string::npos);
  EXPECT_THROW(verify({.names = {"begins-anywhere"}}), InputError);
}

// Momenta of planets are 1e-11 of their positions, which is said where a step does not converge there.
TEST(JudgedSteps, AStepOnCoordinatesOfVeryDifferentSizesNeedNotConverge) {
  static const Method<Stuck> stuck{described("stuck-far-apart", 2, {Claim::none})};
  const auto checks = check_method(stuck, {}, systems().get("outer-solar-system", "system"));
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].result, CheckResult::skipped);
  EXPECT_TRUE(good(checks[0]));
  EXPECT_NE(checks[0].reason.find("sizes of coordinates differ by 2^"), std::string::npos)
      << checks[0].reason;
}

// The backward differentiation formula of two steps, z_2 = 4/3 z_1 - 1/3 z_0 + beta h f(z_2), with implicit
// midpoint steps for the starting values. Both equations are solved by iteration.
template <int numerator, int denominator>
struct Differentiation {
  template <class P>
  struct Work {
    State<P> before, slope, end, middle;
    bool started = false;
    Work(const Differentiation& /*method*/, const P& p)
        : before(p.make_state()), slope(p.make_state()), end(p.make_state()), middle(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const T beta = T(numerator) / T(denominator), third = T(1) / T(3);
    w.end = z;
    for (int k = 0; k < 100; ++k) {
      for (std::size_t i = 0; i < z.size(); ++i)
        w.middle[i] = w.started ? w.end[i] : (z[i] + w.end[i]) / T(2);
      p.field(w.started ? t + h : t + h / T(2), w.middle, w.slope);
      for (std::size_t i = 0; i < z.size(); ++i)
        w.end[i] = w.started ? 4 * third * z[i] - third * w.before[i] + beta * h * w.slope[i]
                             : z[i] + h * w.slope[i];
    }
    w.before = z;
    z = w.end;
    w.started = true;
    return Status::converged;
  }
};

// The explicit method of Adams of order 4, with the classical method for the starting values.
struct Adams {
  template <class P>
  struct Work {
    std::array<State<P>, 4> slopes;  // the last one first
    pfaff::Work<ClassicalInScalar, P> start;
    int known = 0;
    Work(const Adams& /*method*/, const P& p)
        : slopes{p.make_state(), p.make_state(), p.make_state(), p.make_state()},
          start(ClassicalInScalar(), p) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    std::rotate(w.slopes.begin(), w.slopes.end() - 1, w.slopes.end());
    p.field(t, z, w.slopes[0]);
    if (++w.known < 4) return ClassicalInScalar().step(p, t, h, z, w.start);
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] = z[i] + h *
                        (T(55) * w.slopes[0][i] - T(59) * w.slopes[1][i] + T(37) * w.slopes[2][i] -
                         T(9) * w.slopes[3][i]) /
                        T(24);
    return Status::converged;
  }
};

TEST(JudgedSteps, MethodsWithHistoryAreJudgedAfterTheirStart) {
  static const Method<Differentiation<2, 3>> right{described("differentiation", 2)};
  static const Method<Differentiation<9, 10>> wrong{described("false-differentiation", 2)};
  static const Method<Adams> adams{described("adams-4", 4)};
  static const Method<Adams> vain{described("adams-called-5", 5)};
  for (const char* system : {"pendulum", "driven-duffing"}) {
    SCOPED_TRACE(system);
    // None of them asks whether it goes on from where it ended, by a step of the same size, and each is told
    // so.
    const Names trusting{"steps of another motion", "steps of another size"};
    const Names low{"order", "steps of another motion", "steps of another size"};
    EXPECT_EQ(bad_on(right, system), trusting);
    EXPECT_EQ(bad_on(wrong, system), low);
    EXPECT_EQ(bad_on(adams, system), trusting);
    EXPECT_EQ(bad_on(vain, system), low);
  }
}

// Euler's method with a small part of the step before added to each step.
template <int Digits>
struct FaintlyRemembering {
  template <class P>
  struct Work {
    State<P> before;
    Work(const FaintlyRemembering& /*method*/, const P& p) : before(p.make_state()) {
      for (auto& x : before) x = Scalar<P>(0);
    }
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    State<P> rate = p.make_state();
    p.field(t, z, rate);
    for (std::size_t i = 0; i < z.size(); ++i) {
      z[i] = z[i] + h * (rate[i] + pow(Scalar<P>(10), -Scalar<P>(Digits)) * w.before[i]);
      w.before[i] = rate[i];
    }
    return Status::converged;
  }
};

// A predictor changes a step by its round-off in quad, 1e-34. What changes it by more is history, however
// little it is.
TEST(JudgedSteps, HistoryIsMoreThanRoundOff) {
  const auto model = systems().get("pendulum", "system").make({});
  static const Method<FaintlyRemembering<21>> little{described("little-history", 1)};
  static const Method<FaintlyRemembering<28>> less{described("less-history", 1)};
  for (const MethodPlugin* plugin : std::initializer_list<const MethodPlugin*>{&little, &less})
    EXPECT_EQ(keeps_history(*plugin->make({}), model, Quad(0), Quad(0.1), {Quad(1), Quad(0.5)}),
              plugin == &little)
        << plugin->name();
}

TEST(JudgedSteps, AStructureThatCannotBeJudgedIsNotClaimed) {
  static const Method<Adams> claims{described("adams-claimed-symplectic", 4, {Claim::symplectic})};
  const auto checks = check_method(claims, {}, systems().get("pendulum", "system"));
  EXPECT_EQ(bad(checks), (Names{"steps of another motion", "steps of another size", "symplectic"}));
  for (const Check& check : checks) {
    if (check.claim != "symplectic") continue;
    EXPECT_NE(check.reason.find("remembers"), std::string::npos) << check.reason;
  }
}

TEST(JudgedSteps, RunsOfMethodsWithHistoryShowNoStructureOfOneStep) {
  RunSettings settings;
  settings.system = "pendulum";
  settings.step = "0.1";
  settings.time = "1";
  settings.integrator = "leap-frog";
  EXPECT_EQ(execute(resolve(settings), nullptr).structure_residual, std::nullopt);
  settings.integrator = "rk4";
  EXPECT_NE(execute(resolve(settings), nullptr).structure_residual, std::nullopt);
}

// Runs with a tolerance by equal steps of the classical method, as many as the tolerance asks for, with one
// fault.
enum class Fault { none, skips, stops_short, overshoots, careless, idle };
template <Fault fault>
struct Adaptive : ClassicalInScalar {
  template <HasVectorField P>
  requires std::is_same_v < Scalar<P>,
  double > Status advance_to(const P& p, double& t, double end, const Tolerance<double>& tolerance,
                             State<P>& z, Work<P>& w) const {
    const double goal = fault == Fault::overshoots ? end + 1e-9 * (end - t) : end;
    const auto steps =
        fault == Fault::careless ? std::int64_t{10} : std::llround(10 / std::pow(tolerance.relative, 0.25));
    const double begin = t, h = (goal - t) / static_cast<double>(steps);
    if (fault != Fault::skips)
      for (std::int64_t k = 0; k < steps; ++k) (void)step(p, begin + static_cast<double>(k) * h, h, z, w);
    p.counters().steps += fault == Fault::idle ? 0 : steps;
    t = fault == Fault::stops_short ? end - h : goal;
    return Status::converged;
  }
};

// Runs with a tolerance by the registered extrapolation; in quad, with the fault, to 1e-10 whatever the
// tolerance.
template <bool careless>
struct AdaptiveInQuad : ClassicalInScalar {
  template <HasVectorField P>
  requires std::is_same_v<Scalar<P>, Value<Scalar<P>>> Status
  advance_to(const P& p, Scalar<P>& t, const Scalar<P>& end, const Tolerance<Scalar<P>>& tolerance,
             State<P>& z, Work<P>& /*w*/)
  const {
    using T = Scalar<P>;
    const auto method = integrators().get("extrapolation", "integrator").make({});
    const auto stepper = method->stepper(p.model(), T());
    std::vector<T> state(z.begin(), z.end());
    const T allowed = careless ? std::max(tolerance.relative, T(1e-10)) : tolerance.relative;
    const Status status = stepper->advance_to(t, end, allowed, state);
    std::copy(state.begin(), state.end(), z.begin());
    p.counters().steps += stepper->counters().steps;
    return status;
  }
};

TEST(JudgedSteps, RunsWithAToleranceEndWhereTheyShouldWithTheErrorTheyShould) {
  static const Method<Adaptive<Fault::none>> none{described("adaptive", 4)};
  static const Method<Adaptive<Fault::skips>> skips{described("adaptive-skips", 4)};
  static const Method<Adaptive<Fault::stops_short>> stops{described("adaptive-stops-short", 4)};
  static const Method<Adaptive<Fault::overshoots>> beyond{described("adaptive-overshoots", 4)};
  static const Method<Adaptive<Fault::careless>> careless{described("adaptive-careless", 4)};
  static const Method<Adaptive<Fault::idle>> idle{described("adaptive-idle", 4)};
  EXPECT_EQ(bad_on(none, "harmonic-oscillator"), Names{});
  const Names both{"tolerance", "tolerance, backwards"};
  for (const MethodPlugin* plugin :
       std::initializer_list<const MethodPlugin*>{&skips, &stops, &beyond, &careless, &idle})
    EXPECT_EQ(bad_on(*plugin, "harmonic-oscillator"), both) << plugin->name();
  EXPECT_EQ(bad_on(integrators().get("odeint-dopri5", ""), "harmonic-oscillator"), Names{});
}

// The same methods in the scalar of the run: their faults are found in quad too.
TEST(JudgedSteps, RunsWithAToleranceAreJudgedInQuad) {
  static const Method<AdaptiveInQuad<false>> good_one{described("adaptive-in-quad", 8)};
  static const Method<AdaptiveInQuad<true>> careless{described("adaptive-careless-in-quad", 8)};
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  const auto judged_in = [&](const MethodPlugin& plugin) {
    std::vector<std::string> precisions;
    for (const Check& check : check_method(*plugin.make({}), {}, "harmonic-oscillator", model))
      if (check.claim == "tolerance")
        precisions.push_back(check.precision + (check.result == CheckResult::pass ? "" : " fails"));
    return precisions;
  };
  EXPECT_EQ(judged_in(good_one), (Names{"double", "quad"}));
  EXPECT_EQ(judged_in(careless), (Names{"double", "quad fails"}));
  EXPECT_EQ(judged_in(integrators().get("extrapolation", "")), (Names{"double", "quad"}));
  EXPECT_EQ(judged_in(integrators().get("odeint-dopri5", "")), Names{"double"});
  EXPECT_TRUE(adaptive_in_quad(*integrators().get("extrapolation", "").make({}), model));
  EXPECT_FALSE(adaptive_in_quad(*integrators().get("odeint-bulirsch-stoer", "").make({}), model));
  EXPECT_FALSE(adaptive_in_quad(*integrators().get("rk4", "").make({}), model));
}

TEST(JudgedSteps, ACoefficientThatIsWrongByABillionthIsFound) {
  for (const char* name : {"verlet", "rk4", "gauss"}) {
    const MethodPlugin& plugin = integrators().get(name, "integrator");
    const auto method = plugin.make({});
    const auto model = systems().get("henon-heiles", "system").make({});
    ASSERT_EQ(bad(check_method(*method, {}, "henon-heiles", model)), Names{});
    for (std::size_t k = 0; k < method->coefficient_count(); ++k)
      EXPECT_NE(
          bad(check_method(*method->with_changed_coefficient(k, Quad(1e-9)), {}, "henon-heiles", model)),
          Names{})
          << name << " coefficient " << k;
  }
}
}  // namespace
