// Conformal splitting: M^T J M = e^{-nu h} J to round-off, its transition matrix in closed form, and the
// facet that it needs.
#include <gtest/gtest.h>

#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/integrators/splitting/conformal_splitting.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/check.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;

// A step of some dozen operations rounds by 1e-16 or 1e-34 in each.
template <class T>
constexpr double splitting_round_off = std::is_same_v<T, Quad> ? 1e-32 : 3e-15;

// Two coupled oscillators with a driven, nonlinear potential and no other formula than those of the facet, or
// with force and velocity written out.
struct EnergiesOfPair {
  static constexpr int dimension = 4;
  Real nu = 0.4_r;
  [[nodiscard]] Real damping() const { return nu; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] * 2 + p[0] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return q[0] * q[0] / 2 + q[0] * q[0] * q[1] * q[1] / 2 + pow(q[1], Real(4)) / 4 - q[1] * cos(2 * t);
  }
};
struct WrittenPair : EnergiesOfPair {
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const {
    f[0] = -q[0] - q[0] * q[1] * q[1];
    f[1] = cos(2 * t) - q[0] * q[0] * q[1] - q[1] * q[1] * q[1];
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0] + p[1] / 2;
    v[1] = 2 * p[1] + p[0] / 2;
  }
};
template <bool Written>
using DrivenPair = std::conditional_t<Written, WrittenPair, EnergiesOfPair>;
template <bool Written>
std::shared_ptr<const Model> driven_pair(const char* nu = "0.4") {
  DrivenPair<Written> pair;
  pair.nu = *Real::parse(nu);
  return make_model({.name = "driven-pair",
                     .title = "",
                     .reference = "",
                     .coordinates = {{"a", ""}, {"b", ""}, {"p", ""}, {"q", ""}},
                     .initial = {0.3_r, 0.5_r, Real::fraction(-1, 5), 0.1_r}},
                    pair);
}

// |M^T J M - e^{-rate h} J|, relative.
template <class T>
double conformal_residual(const MethodInstance& method, const std::shared_ptr<const Model>& model, const T& h,
                          const T& rate) {
  std::vector<T> z;
  for (const Real& x : model->initial()) z.push_back(T(x));
  const std::size_t n = z.size();
  const auto step = StepDifferentiator<T>(method, model)(T(0.37), h, z);
  EXPECT_EQ(step.status, Status::converged);
  std::vector<T> before(n * n), after(n * n);
  for (std::size_t k = 0; k < n / 2; ++k) {
    after[k * n + n / 2 + k] = T(1);
    after[(n / 2 + k) * n + k] = T(-1);
  }
  for (std::size_t k = 0; k < n * n; ++k) before[k] = exp(-(rate * h)) * after[k];
  return static_cast<double>(congruence_residual(step.jacobian, after, before));
}

template <class T>
void expect_conformal() {
  for (const char* nu : {"0", "0.4", "3"})
    for (const double h : {0.1, -0.1, 0.5}) {
      const auto model = driven_pair<false>(nu);
      const T rate(*Real::parse(nu));
      EXPECT_LE(conformal_residual<T>(*method_named("conformal-splitting"), model, T(h), rate),
                splitting_round_off<T>);
      EXPECT_LE(conformal_residual<T>(*method_named("suzuki-conformal"), model, T(h), rate),
                splitting_round_off<T>);
      EXPECT_LE(
          conformal_residual<T>(*method_named("kahan-li-conformal", {{"order", "8"}}), model, T(h), rate),
          splitting_round_off<T>);
    }
}
TEST(ConformalSplitting, TheCanonicalStructureDecaysAtItsRateInDouble) { expect_conformal<double>(); }
TEST(ConformalSplitting, TheCanonicalStructureDecaysAtItsRateInQuad) { expect_conformal<Quad>(); }

TEST(ConformalSplitting, AnotherRateIsSeenAndOtherMethodsFail) {  // controls
  const auto model = driven_pair<false>();
  const Quad h(0.1), rate = Real(0.4_r).quad();
  EXPECT_GT(conformal_residual<Quad>(*method_named("conformal-splitting"), model, h, rate * Quad(1 + 1e-6)),
            1e-9);
  for (const char* name : {"rk4", "leap-frog", "implicit-midpoint", "gauss"})
    EXPECT_GT(conformal_residual<Quad>(*method_named(name), model, h, rate), 1e-10) << name;
}

TEST(ConformalSplitting, OrdersOnADrivenSystem) {
  const auto model = driven_pair<false>();
  EXPECT_NEAR(measure_order(*method_named("conformal-splitting"), model).slope, 2, 0.1);
  EXPECT_NEAR(measure_order(*method_named("suzuki-conformal", {{"order", "4"}}), model).slope, 4, 0.1);
  EXPECT_NEAR(measure_order(*method_named("kahan-li-conformal", {{"order", "6"}}), model).slope, 6, 0.1);
  EXPECT_NEAR(measure_order(*method_named("kahan-li-conformal", {{"order", "8"}}), model).slope, 8, 0.1);
}

// D(h/2) S(h) D(h/2) for r'' + nu r' + r = 0, S = [[1 - h^2/2, h - h^3/4], [-h, 1 - h^2/2]].
template <class T>
void expect_conformal_transition() {
  for (const char* nu : {"0", "0.3", "1"}) {
    const auto model = systems().get("damped-oscillator", "system").make({{"nu", nu}});
    const T h(Real::fraction(1, 10)), e = exp(-(T(*Real::parse(nu)) * h / T(2)));
    const auto step =
        StepDifferentiator<T>(*method_named("conformal-splitting"), model)(T(0.7), h, {T(1), T(0)});
    const T c = T(1) - h * h / T(2);
    const std::array<T, 4> exact{c, (h - h * h * h / T(4)) * e, -(h * e), c * e * e};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LE(static_cast<double>(abs(step.jacobian[k] - exact[k])), splitting_round_off<T>)
          << nu << ' ' << k;
  }
}
TEST(ConformalSplitting, TransitionMatrixOfTheOscillatorInDouble) { expect_conformal_transition<double>(); }
TEST(ConformalSplitting, TransitionMatrixOfTheOscillatorInQuad) { expect_conformal_transition<Quad>(); }

TEST(ConformalSplitting, WithoutFrictionIsVerlet) {
  const auto damped = systems().get("damped-pendulum", "system").make({{"nu", "0"}});
  const auto free = systems().get("pendulum", "system").make({});
  const auto a = after_steps<double>(*method_named("conformal-splitting"), damped, 0.1, 100, {1, 0.5}),
             b = after_steps<double>(*method_named("verlet"), free, 0.1, 100, {1, 0.5});
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

TEST(ConformalSplitting, ALongRunDecaysToRoundOff) {
  // e^{-nu h/2} rounded a million times the same way would be off by 1e6 units.
  const auto model = systems().get("damped-pendulum", "system").make({{"nu", "0.001"}});
  const double h = 1.0 / 64;
  const auto method = method_named("conformal-splitting");
  const auto z = after_steps<double>(*method, model, h, 200000, {1, 0.5});
  const auto exact = after_steps<Quad>(*method, model, Quad(h), 200000, {Quad(1), Quad(0.5)});
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(z[k], static_cast<double>(exact[k]), 1e-14);
}

TEST(ConformalSplitting, ExpMinusOneHasNoCancellation) {
  for (const double x : {-3.0, -0.7, -0.01, -1e-5, -3e-11, -1e-16, 1e-300, 2e-8, 0.3, 2.0}) {
    Quad sum(0), term(1);
    for (int k = 1; k < 60; ++k) {
      term = term * Quad(x) / Quad(k);
      sum += term;
    }
    const auto error = [&](Quad y) { return static_cast<double>(abs(y / sum - Quad(1))); };
    EXPECT_LE(error(Quad(exp_minus_one(x))), 8e-16) << x;
    EXPECT_LE(error(exp_minus_one(Quad(x))), 1e-32) << x;
    if (std::abs(x) < 1e-4 && std::abs(x) > 1e-12) {  // control
      EXPECT_GT(error(Quad(std::exp(x) - 1)), 1e-13) << x;
    }
  }
}

TEST(ConformalFacet, IsNotTakenForASeparableHamiltonian) {
  for (const auto& model : {driven_pair<false>(), driven_pair<true>()}) {
    EXPECT_EQ(model->facets(), FacetSet{}.with(Facet::vector_field).with(Facet::conformal));
    EXPECT_NE(method_named("verlet")->refuses(*model).find("verlet needs separable"), std::string::npos);
    EXPECT_TRUE(method_named("conformal-splitting")->refuses(*model).empty());
  }
  const auto kepler = systems().get("kepler", "system").make({});
  EXPECT_NE(method_named("conformal-splitting")->refuses(*kepler).find("conformal-splitting needs conformal"),
            std::string::npos);
  EXPECT_EQ(method_named("conformal-splitting")->needs(), FacetSet{}.with(Facet::conformal));
}

TEST(ConformalFacet, FrictionIsInTheField) {
  const std::vector<double> z{0.3, 0.5, -0.2, 0.1};
  const double t = 0.6, a = z[0], b = z[1], p = z[2], q = z[3];
  const std::vector<double> by_hand{p + q / 2, 2 * q + p / 2, -a - a * b * b - 0.4 * p,
                                    std::cos(2 * t) - a * a * b - b * b * b - 0.4 * q};
  std::vector<double> rate(4);
  const auto expect_field = [&](const auto& problem) {
    problem.field(t, z, rate);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(rate[k], by_hand[k], 1e-15);
  };
  expect_field(Problem<double>(driven_pair<false>()));
  expect_field(Problem<double>(driven_pair<true>()));
  expect_field(StaticProblem<DrivenPair<false>>());
  expect_field(StaticProblem<DrivenPair<true>>());
  static_assert(!HasSeparable<StaticProblem<DrivenPair<true>>> &&
                !HasDarbouxChart<StaticProblem<DrivenPair<true>>>);
}

TEST(ConformalFacet, TheStaticPathTakesTheSameSteps) {
  using P = StaticProblem<DrivenPair<true>>;
  const P problem;
  const ConformalSplitting splitting;
  Work<ConformalSplitting, P> work(splitting, problem);
  P::State z;
  const std::vector<double> start{0.3, 0.5, -0.2, 0.1};
  std::copy(start.begin(), start.end(), z.begin());
  std::int64_t completed = 0;
  EXPECT_EQ(advance(splitting, problem, 0.0, 0, 0.1, 100, z, work, completed), Status::converged);
  const auto other =
      after_steps<double>(*method_named("conformal-splitting"), driven_pair<true>(), 0.1, 100, start);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(z[k], other[k], 1e-14);
}

}  // namespace
}  // namespace pfaff
