// Verification of systems in units that nobody would choose, and of methods whose coefficients are doubles on
// motions that leave few steps between too long and round-off: what is true passes, and what is false does
// not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <pfaff/core/integrator.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/step_scale.hpp>

#include "judged.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::bad;
using pfaff::testing::Classical;
using pfaff::testing::Names;

// A sun and planets in a plane, in metres, seconds and kilograms: lengths of 1e11, times of 1e7, masses of
// 1e21 to 1e30, momenta of 1e25 to 1e31. The sun rests in the origin at the start. The state is (x, y) and
// (p_x, p_y) of each body.
template <int bodies>
struct Planets {
  static constexpr int dimension = 4 * bodies;
  std::array<Real, 5> masses{1.989e30_r, 1.898e27_r, 5.683e26_r, 8.681e25_r, 1.3e21_r};
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (std::size_t k = 0; k < bodies; ++k)
      sum = sum + (p[2 * k] * p[2 * k] + p[2 * k + 1] * p[2 * k + 1]) / (2 * T(masses[k]));
    return sum;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    T sum(0);
    for (std::size_t i = 0; i < bodies; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const T x = q[2 * i] - q[2 * j], y = q[2 * i + 1] - q[2 * j + 1];
        sum = sum - T(6.674e-11_r) * T(masses[i]) * T(masses[j]) / sqrt(x * x + y * y);
      }
    return sum;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    constexpr std::size_t half = std::size_t{2} * bodies;
    values[0] = kinetic(t, z.subspan(half)) + potential(t, z.first(half));
    values[1] = T(0);
    for (std::size_t k = 0; k < bodies; ++k)
      values[1] = values[1] + z[2 * k] * z[half + 2 * k + 1] - z[2 * k + 1] * z[half + 2 * k];
  }
};
template <int bodies>
std::vector<Real> start_of_planets() {
  const auto masses = Planets<bodies>().masses;
  const std::array<Real, 5> x{0, 7.4e11_r, -1.0e12_r, 2.0e12_r, -2.3e12_r},
      y{0, -2.1e11_r, 9.8e11_r, -2.1e12_r, -3.8e12_r}, u{0, 3.5e3_r, -6.7e3_r, 4.7e3_r, 4.7e3_r},
      v{0, 1.26e4_r, -6.8e3_r, 4.4e3_r, -2.8e3_r};
  std::vector<Real> z, p;
  for (std::size_t k = 0; k < bodies; ++k) {
    z.insert(z.end(), {x[k], y[k]});
    p.insert(p.end(), {masses[k] * u[k], masses[k] * v[k]});
  }
  z.insert(z.end(), p.begin(), p.end());
  return z;
}
template <int bodies>
const SystemPlugin& planets(const char* name) {
  static const System<Planets<bodies>> plugin{
      {.name = name,
       .title = "",
       .reference = "",
       .initial = start_of_planets<bodies>(),
       .invariants = {conserved("energy", "J"), conserved_quadratic("angular momentum", "J s")}}};
  return plugin;
}

TEST(JudgedUnits, SystemsInStrangeUnitsRaiseNoFalseAlarms) {
  for (const SystemPlugin* system : {&planets<3>("three-bodies-si"), &planets<5>("five-bodies-si")}) {
    EXPECT_EQ(bad(check_system(*system)), Names{}) << system->name();
    for (const char* name : {"verlet", "rk4", "implicit-midpoint", "leap-frog", "odeint-dopri5", "taylor"})
      EXPECT_EQ(bad(check_method(integrators().get(name, ""), {}, *system)), Names{})
          << name << " on " << system->name();
  }
}

// A damped Duffing oscillator of nanometres, driven ten million times a second; the energy that it would keep
// without its drive and its friction is no invariant.
struct DrivenNanometres {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    const T x = z[0] * 1000000000_r;
    rate[0] = z[1];
    rate[1] = (T(x + x * x * x) * Real(-40000) - z[1] * 1000000000_r / 5000 +
               T(sin(T(t * Real(10000000)))) * Real(70000));
  }
};

TEST(JudgedUnits, FastForcesOnSmallMotionsRaiseNoFalseAlarms) {
  static const System<DrivenNanometres> system{{.name = "driven-nanometres",
                                                .title = "",
                                                .reference = "",
                                                .initial = {1_r / 1000000000, Real::fraction(1, 200)}}};
  for (const char* name : {"rk4", "implicit-midpoint", "gauss", "odeint-dopri5", "taylor"})
    EXPECT_EQ(bad(check_method(integrators().get(name, ""), {}, system)), Names{}) << name;
  EXPECT_LT(generic_time_of(*system.make({})).value(), 1e-6);
}

TEST(JudgedUnits, StatesAreMovedByPartsOfTheirOwnSize) {
  const SystemPlugin& system = planets<5>("five-bodies-moved");
  const auto model = system.make({});
  const std::vector<Real> before = model->initial(), after = generic_state(*model);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double size = std::abs(before[k].value());
    EXPECT_NE(after[k].value(), before[k].value()) << k;
    if (size > 0) {
      EXPECT_LT(std::abs(after[k].value() - before[k].value()), size / 2) << k;
    }
  }
  // The sun rests, and what the planets make of it in the time of the motion is far below their own size.
  const std::size_t half = before.size() / 2;
  EXPECT_LT(std::abs(after[0].value()), 1e10);
  EXPECT_LT(std::abs(after[half].value() / Planets<5>().masses[0].value()), 1e3);
  const auto time = static_cast<double>(own_time(*model, generic_time_of(*model), after));
  EXPECT_GT(time, 1e6);
  EXPECT_LT(time, 1e9);
}

MethodDescriptor called_of_order(const char* name, int order, bool doubles,
                                 std::vector<Claim> preserves = {Claim::none}) {
  return {.name = name,
          .title = "",
          .reference = "",
          .order = order,
          .preserves = std::move(preserves),
          .double_coefficients = doubles};
}

// The double pendulum of unit masses and rods in relative angles, which is fast, and a slow oscillator, whose
// errors are soon at round-off.
struct RelativeAngles {
  static constexpr int dimension = 4;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T difference = z[3] - z[2], g(9.8_r);
    return (2 * z[3] * z[3] + difference * difference + 2 * z[3] * difference * cos(z[1])) /
               (3 - cos(2 * z[1])) -
           2 * g * cos(z[0]) - g * cos(z[0] + z[1]);
  }
};
struct SlowOscillator {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1] / 20;
    rate[1] = -sin(z[0]) / 20;
  }
};

TEST(JudgedUnits, OrdersOfDoubleCoefficientsAreJudgedWhereSlopesDoNotSettle) {
  static const System<RelativeAngles> fast{{.name = "relative-angles",
                                            .title = "",
                                            .reference = "",
                                            .initial = {1.1_r, Real::fraction(-11, 10), 2.7746_r, 2.7746_r}}};
  static const System<SlowOscillator> slow{
      {.name = "slow-oscillator", .title = "", .reference = "", .initial = {Real(1), Real::fraction(1, 2)}}};
  static const Method<Classical<true>> right{called_of_order("double-classical", 4, true)};
  static const Method<Classical<true>> vain{called_of_order("double-classical-called-5", 5, true)};
  for (const SystemPlugin* system : std::initializer_list<const SystemPlugin*>{&fast, &slow}) {
    SCOPED_TRACE(system->name());
    EXPECT_EQ(bad(check_method(integrators().get("odeint-dopri5", ""), {}, *system)), Names{});
    EXPECT_EQ(bad(check_method(integrators().get("odeint-bulirsch-stoer", ""), {}, *system)), Names{});
    EXPECT_EQ(bad(check_method(right, {}, *system)), Names{});
    const Names found = bad(check_method(vain, {}, *system));
    EXPECT_NE(std::find(found.begin(), found.end(), "order"), found.end());
  }
}

// A mass of a ton on a spring.
struct HeavyOscillator {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return z[1] * z[1] / 2000 + 500 * (z[0] * z[0] + z[0] * z[0] * z[0] * z[0] / 8);
  }
};

// A generating function of w = (q + p, ...) has other steps in other units; one of (q, p') and midpoints do
// not.
TEST(JudgedUnits, MethodsThatAddUpUnitsAreKnown) {
  static const System<HeavyOscillator> system{
      {.name = "heavy-oscillator", .title = "", .reference = "", .initial = {Real(2), Real(3000)}}};
  const auto adds = [&](const char* name, const Assignments& set) {
    const auto method = integrators().get(name, "integrator").make(set);
    return adds_up_units(MethodOnModel(*method, set, system.name(), system.make({})));
  };
  EXPECT_TRUE(
      adds("generating-function", {{"order", "2"}, {"form", "normal"}, {"normal", "0.2,0.1,-0.3,-0.2"}}));
  EXPECT_FALSE(adds("generating-function", {{"order", "2"}}));
  EXPECT_FALSE(adds("implicit-midpoint", {}));
}

TEST(JudgedUnits, FalseClaimsAreFoundInStrangeUnits) {
  static const Method<Classical<false>> vain{
      called_of_order("classical-vain", 5, false, {Claim::symplectic, Claim::quadratic_invariants})};
  for (const SystemPlugin* system :
       {&planets<3>("three-bodies-falsely"), &planets<5>("five-bodies-falsely")}) {
    const Names found = bad(check_method(vain, {}, *system));
    for (const char* claim : {"order", "symplectic", "quadratic-invariants"})
      EXPECT_NE(std::find(found.begin(), found.end(), claim), found.end()) << claim << ' ' << system->name();
  }
}
}  // namespace
