// The static path computes the same as the registered one: the same bits where the arithmetic is the same,
// the same numbers to round-off where an iteration is involved. Its derived formulas agree with the author's
// to round-off.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/generating_function.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>
#include <pfaff/systems/canonical/harmonic_oscillator.hpp>
#include <pfaff/systems/canonical/kepler.hpp>
#include <pfaff/systems/canonical/pendulum.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

// What is left of a system when its author writes the energies only.
template <class S>
struct EnergiesOnly {
  static constexpr int dimension = S::dimension;
  S system;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return system.kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return system.potential(t, q);
  }
};

// The same as one Hamiltonian.
template <class S>
struct HamiltonianOnly {
  static constexpr int dimension = S::dimension;
  S system;
  template <class T>
  T hamiltonian(const T& t, In<T> z) const {
    return system.kinetic(t, z.subspan(dimension / 2)) + system.potential(t, z.first(dimension / 2));
  }
};

template <class T, int N>
std::vector<T> listed(const Vector<T, N>& z) {
  return {z.begin(), z.end()};
}

template <class S, class T, class M>
std::vector<T> run_static(const M& method, const S& system, const std::vector<T>& start, const T& h,
                          std::int64_t steps) {
  const StaticProblem<S, T> problem(system);
  auto z = problem.make_state();
  std::copy(start.begin(), start.end(), z.begin());
  Work<M, StaticProblem<S, T>> work(method, problem);
  std::int64_t completed = 0;
  EXPECT_EQ(advance(method, problem, T(0), 0, h, steps, z, work, completed), Status::converged);
  EXPECT_EQ(completed, steps);
  return listed(z);
}

template <class T>
std::vector<T> run_registered(const std::string& method, const Assignments& parameters,
                              const std::string& system, const std::vector<T>& start, const T& h,
                              std::int64_t steps) {
  const auto model = systems().get(system, "system").make({});
  return testing::after_steps(*testing::method_named(method, parameters), model, h, steps, start);
}

const std::vector<double> kepler_start{0.4, 0, 0, 2};

TEST(StaticPath, VerletAndSymplecticEulerAreTheSameBits) {
  Verlet plain;
  plain.compensated = false;
  EXPECT_EQ(run_static(Verlet(), Kepler(), kepler_start, 0.01, 5000),
            run_registered("verlet", {}, "kepler", kepler_start, 0.01, 5000));
  EXPECT_EQ(run_static(plain, Kepler(), kepler_start, 0.01, 5000),
            run_registered("verlet", {{"compensated", "no"}}, "kepler", kepler_start, 0.01, 5000));
  EXPECT_EQ(run_static(SymplecticEuler(), Kepler(), kepler_start, 0.01, 5000),
            run_registered("symplectic-euler", {}, "kepler", kepler_start, 0.01, 5000));
  const std::vector<double> start{1, 0.5};
  EXPECT_EQ(run_static(Verlet(), Pendulum(), start, 0.01, 5000),
            run_registered("verlet", {}, "pendulum", start, 0.01, 5000));
  EXPECT_EQ(run_static(Verlet(), HarmonicOscillator(), start, 0.01, 5000),
            run_registered("verlet", {}, "harmonic-oscillator", start, 0.01, 5000));
}

TEST(StaticPath, RungeKuttaIsTheSameBits) {
  EXPECT_EQ(run_static(RungeKutta4(), Kepler(), kepler_start, 0.01, 500),
            run_registered("rk4", {}, "kepler", kepler_start, 0.01, 500));
}

void expect_close(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], tolerance);
}

TEST(StaticPath, ImplicitMethodsAgreeToRoundOff) {
  GeneratingFunction generating;
  generating.truncation = 6;
  generating.validate();
  expect_close(run_static(ImplicitMidpoint(), Kepler(), kepler_start, 0.01, 100),
               run_registered("implicit-midpoint", {}, "kepler", kepler_start, 0.01, 100), 1e-14);
  expect_close(run_static(Collocation<3>(), Kepler(), kepler_start, 0.01, 100),
               run_registered("gauss", {{"stages", "3"}}, "kepler", kepler_start, 0.01, 100), 1e-14);
  expect_close(run_static(generating, Kepler(), kepler_start, 0.01, 100),
               run_registered("generating-function", {{"order", "6"}}, "kepler", kepler_start, 0.01, 100),
               1e-14);
}

template <class T>
inline constexpr bool is_pack = false;
template <int W>
inline constexpr bool is_pack<Pack<W>> = true;

// A system that evaluates its force for one stage after the other.
template <class S>
struct StageByStage : S {
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const requires(!is_pack<T>) {
    S::force(t, q, f);
  }
};

// A pendulum that is shaken, so that stages have times of their own.
struct Shaken : Pendulum {
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const {
    Pendulum::force(t, q, f);
    f[0] = f[0] + cos(2 * t) / 3;
  }
};

template <class P>
constexpr bool forces_in_lanes = requires(const P& p, const Pack<4>& t, std::vector<Pack<4>>& z) {
  p.force(t, In<Pack<4>>(z), Out<Pack<4>>(z));
};
static_assert(forces_in_lanes<StaticProblem<Kepler>> &&
              !forces_in_lanes<StaticProblem<StageByStage<Kepler>>> &&
              !forces_in_lanes<StaticProblem<Kepler, Quad>>);

template <class M>
void expect_same_bits_in_lanes(const M& method) {
  const std::vector<double> swing{1, 0.5};
  EXPECT_EQ(run_static(method, Kepler(), kepler_start, 0.1, 200),
            run_static(method, StageByStage<Kepler>(), kepler_start, 0.1, 200));
  EXPECT_EQ(run_static(method, Shaken(), swing, 0.2, 200),
            run_static(method, StageByStage<Shaken>(), swing, 0.2, 200));
}

// With lanes that are full, and with some beyond the last stage.
TEST(StaticPath, ForcesAtSeveralStagesTogetherAreTheSameBits) {
  expect_same_bits_in_lanes(Collocation<3>());
  expect_same_bits_in_lanes(Collocation<6>());
  expect_same_bits_in_lanes(Collocation<8>());
  Gauss gauss;
  gauss.stages = 6;
  gauss.validate();
  expect_same_bits_in_lanes(gauss);
}

// Sums over stages have one order whether those lie in packs of four or of eight, and whether their number
// and that of the coordinates are known to the compiler or not.
template <int Stages>
void expect_one_order_of_sums() {
  Gauss gauss;
  gauss.stages = Stages;
  gauss.validate();
  const std::vector<double> four = run_static(gauss, Kepler(), kepler_start, 0.1, 200);
  EXPECT_EQ(run_static(Collocation<Stages>(), Kepler(), kepler_start, 0.1, 200), four) << Stages;
  EXPECT_EQ(run_registered("gauss", {{"stages", std::to_string(Stages)}}, "kepler", kepler_start, 0.1, 200),
            four)
      << Stages;
}
TEST(StaticPath, LanesOfFourAndOfEightAreTheSameBits) {
  expect_one_order_of_sums<5>();
  expect_one_order_of_sums<6>();
  expect_one_order_of_sums<8>();
  expect_one_order_of_sums<12>();
}

TEST(StaticPath, StagesKnownAtRunTimeTakeTheSameSteps) {
  Gauss gauss;
  gauss.stages = 3;
  gauss.validate();
  expect_close(run_static(gauss, Kepler(), kepler_start, 0.01, 100),
               run_static(Collocation<3>(), Kepler(), kepler_start, 0.01, 100), 1e-14);
}

// |static formula - formula of the same system with everything derived| <= 1e-15 max(1, |formula|).
template <class Derived, class S>
void formulas_agree(const S& system, const std::vector<double>& at) {
  constexpr std::size_t n = static_cast<std::size_t>(S::dimension);
  const StaticProblem<S> written(system);
  const StaticProblem<Derived> derived(Derived{system});
  const auto expect_equal = [](double a, double b, double scale) {
    EXPECT_NEAR(a, b, 1e-15 * std::max(1.0, scale));
  };
  const double t = 0.3;
  std::vector<double> a(n), b(n), matrix(n * n), other(n * n);
  written.field(t, at, a);
  derived.field(t, at, b);
  for (std::size_t k = 0; k < n; ++k) expect_equal(a[k], b[k], std::abs(a[k]));
  written.field_jacobian(t, at, matrix);
  derived.field_jacobian(t, at, other);
  double largest = 0;
  for (const double x : matrix) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < n * n; ++k) expect_equal(matrix[k], other[k], largest);
  expect_equal(written.hamiltonian(t, at), derived.hamiltonian(t, at), 1);
  if constexpr (HasSeparable<StaticProblem<Derived>>) {
    const In<double> q(at.data(), n / 2), p(at.data() + n / 2, n / 2);
    written.force(t, q, a);
    derived.force(t, q, b);
    for (std::size_t k = 0; k < n / 2; ++k) expect_equal(a[k], b[k], std::abs(a[k]));
    written.velocity(t, p, a);
    derived.velocity(t, p, b);
    for (std::size_t k = 0; k < n / 2; ++k) expect_equal(a[k], b[k], std::abs(a[k]));
  }
}

TEST(StaticPath, DerivedFormulasAreTheAuthors) {
  HarmonicOscillator stiff;
  stiff.omega = 1.7_r;
  formulas_agree<EnergiesOnly<HarmonicOscillator>>(stiff, {0.7, -0.3});
  formulas_agree<HamiltonianOnly<HarmonicOscillator>>(stiff, {0.7, -0.3});
  formulas_agree<EnergiesOnly<Pendulum>>(Pendulum(), {1.1, 0.4});
  formulas_agree<HamiltonianOnly<Pendulum>>(Pendulum(), {1.1, 0.4});
  formulas_agree<EnergiesOnly<Kepler>>(Kepler(), {0.8, -0.5, 0.3, 0.9});
  formulas_agree<HamiltonianOnly<Kepler>>(Kepler(), {0.8, -0.5, 0.3, 0.9});
}

TEST(StaticPath, FacetsAreThoseOfTheStruct) {
  static_assert(HasSeparable<StaticProblem<Kepler>>);
  static_assert(HasDarbouxChart<StaticProblem<Kepler>>);
  static_assert(HasVectorField<StaticProblem<HamiltonianOnly<Kepler>>>);
  static_assert(!HasSeparable<StaticProblem<HamiltonianOnly<Kepler>>>);
  static_assert(!Steps<Verlet, StaticProblem<HamiltonianOnly<Kepler>>>);
}

// Orders from the errors at h and h/2 in quad, against the exact solution; Kepler hides no error.
template <class M>
double measured_order(const M& method) {
  const Kepler kepler;
  const std::vector<Quad> start{Quad(1), Quad(0), Quad(0), Quad(1.1)};
  std::vector<Quad> exact(4);
  kepler.exact_solution(Quad(1), Quad(0), In<Quad>(start), Out<Quad>(exact));
  const auto error = [&](int steps) {
    const auto z = run_static(method, kepler, start, Quad(1) / Quad(steps), steps);
    Quad largest(0);
    for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, abs(z[k] - exact[k]));
    return static_cast<double>(largest);
  };
  return std::log2(error(32) / error(64));
}

TEST(StaticPath, Orders) {
  EXPECT_NEAR(measured_order(SymplecticEuler()), 1, 0.1);
  EXPECT_NEAR(measured_order(Verlet()), 2, 0.1);
  EXPECT_NEAR(measured_order(ImplicitMidpoint()), 2, 0.1);
  EXPECT_NEAR(measured_order(RungeKutta4()), 4, 0.1);
  EXPECT_NEAR(measured_order(Collocation<2>()), 4, 0.1);
  EXPECT_NEAR(measured_order(Collocation<4>()), 8, 0.1);
  GeneratingFunction generating;
  generating.truncation = 4;
  generating.validate();
  EXPECT_NEAR(measured_order(generating), 4, 0.1);
}

}  // namespace
}  // namespace pfaff
