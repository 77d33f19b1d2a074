// Verification of systems at unusual scales, with false claims, and with starts that flatter a method: false
// claims are found whatever the size of their terms, and true systems pass with every kind of method.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "../falling_particle.hpp"
#include "judged.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::bad;
using pfaff::testing::Names;

// An oscillator with one number called an invariant.
enum class Claimed { tiny_product, constant, tiny_energy, quartic };
template <Claimed claimed>
struct ClaimedOscillator {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T square = (z[0] * z[0] + z[1] * z[1]) / 2;
    return claimed == Claimed::quartic ? square + z[0] * z[0] * z[0] * z[0] : square;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const T tiny(1e-40_r);
    if (claimed == Claimed::tiny_product) values[0] = tiny * z[0] * z[1];
    if (claimed == Claimed::constant) values[0] = T(3);
    if (claimed == Claimed::tiny_energy) values[0] = tiny * (z[0] * z[0] + z[1] * z[1]);
    if (claimed == Claimed::quartic) values[0] = hamiltonian(t, z);
  }
};
template <Claimed claimed>
const SystemPlugin& claimed_oscillator(const char* name) {
  static const System<ClaimedOscillator<claimed>> plugin{{.name = name,
                                                          .title = "",
                                                          .reference = "",
                                                          .coordinates = {{"q", ""}, {"p", ""}},
                                                          .initial = {Real(1), Real::fraction(1, 3)},
                                                          .invariants = {conserved_quadratic("claimed", "")},
                                                          .time_unit = ""}};
  return plugin;
}

TEST(JudgedSystems, InvariantsAreJudgedAtTheirOwnSize) {
  EXPECT_EQ(bad(check_system(claimed_oscillator<Claimed::tiny_product>("tiny-product"))),
            Names{"conserves claimed"});
  EXPECT_EQ(bad(check_system(claimed_oscillator<Claimed::constant>("constant-invariant"))),
            Names{"claimed varies"});
  EXPECT_EQ(bad(check_system(claimed_oscillator<Claimed::tiny_energy>("tiny-energy"))), Names{});
}

TEST(JudgedSystems, AWrongQuadraticFlagIsBlamedOnTheFlag) {
  const SystemPlugin& plugin = claimed_oscillator<Claimed::quartic>("quartic");
  EXPECT_EQ(bad(check_system(plugin)), Names{"claimed is quadratic"});
  EXPECT_EQ(bad(check_method(integrators().get("gauss", ""), {}, plugin)), Names{});
}

// The energy of an oscillator, but beyond |q| = 5, where its motion does not lead.
struct EnergyNearby {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z) + select(z[0] * z[0] - 25, z[0] * z[0] - 25, T(0));
  }
};

template <int tenths>  // of the range to both sides; without one where there are none
const SystemPlugin& energy_nearby(const char* name) {
  static const Range range = tenths == 0 ? unbounded : Range{-tenths / 10.0, tenths / 10.0};
  static const System<EnergyNearby> plugin{{.name = name,
                                            .title = "",
                                            .reference = "",
                                            .coordinates = {{"q", "", range}, {"p", ""}},
                                            .initial = {Real(1), Real::fraction(1, 3)},
                                            .invariants = {conserved("energy", "")},
                                            .time_unit = ""}};
  return plugin;
}

TEST(JudgedSystems, StatesAreDrawnFromTheRangesThatCoordinatesState) {
  EXPECT_EQ(bad(check_system(energy_nearby<0>("energy-nearby"))), Names{});
  EXPECT_EQ(bad(check_system(energy_nearby<49>("energy-within-reach"))), Names{});
  EXPECT_EQ(bad(check_system(energy_nearby<70>("energy-beyond-reach"))), Names{"conserves energy"});
}

// A field that is not that of the Hamiltonian, at the size 1e-45.
struct TinyField {
  static constexpr int dimension = 2;
  Real scale = 1e-45_r;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return scale * (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = scale * z[1];
    rate[1] = -(scale * z[0]) * Real::fraction(1000001, 1000000);
  }
};

TEST(JudgedSystems, AWrongFieldIsFoundAtAnySize) {
  static const System<TinyField> plugin{
      {.name = "tiny-field", .title = "", .reference = "", .initial = {Real(1), Real::fraction(1, 3)}}};
  EXPECT_EQ(bad(check_system(plugin)), Names{"written field is the derived one"});
}

// A one-form whose structure has the condition number 1e3, by a shear of the canonical one.
struct Sheared {
  static constexpr int dimension = 4;
  template <class T>
  static std::array<T, 4> canonical(In<T> z) {
    const T a = z[0] + 31 * z[3] + z[2] * z[2], b = z[1] - 17 * z[2];
    return {a, b + a * a / 3, z[2], z[3]};
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    // p_1 dq_1 + p_2 dq_2 with q = (a, b'), p = (z_3, z_4) of `canonical`, written out in dz.
    const auto y = canonical<T>(z);
    const T first = y[2] + y[3] * (2 * y[0] / 3);
    form[0] = first;
    form[1] = y[3];
    form[2] = first * 2 * z[2] - 17 * y[3];
    form[3] = 31 * first;
  }
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    const auto y = canonical<T>(z);
    return (y[2] * y[2] + y[3] * y[3] + y[0] * y[0] + y[1] * y[1]) / 2;
  }
};

TEST(JudgedSystems, ABadlyConditionedStructureIsNotAFault) {
  static const System<Sheared> plugin{
      {.name = "sheared",
       .title = "",
       .reference = "",
       .initial = {Real(1), Real::fraction(1, 3), Real::fraction(-1, 2), Real::fraction(2, 5)}}};
  EXPECT_EQ(bad(check_system(plugin)), Names{});
}

// Systems that a method's claims were once found false on although they are true: a start at an apsis, where
// the motion is symmetric in time; a singular coefficient; a fast motion.
struct DampedKepler {
  static constexpr int dimension = 4;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T square = z[0] * z[0] + z[1] * z[1], cube = square * sqrt(square);
    for (std::size_t k = 0; k < 2; ++k) {
      rate[k] = z[2 + k];
      rate[2 + k] = -z[k] / cube - z[2 + k] / 100;
    }
  }
};
struct EmdenFowler {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -2 / (1 + t) * z[1] - z[0] * z[0] * z[0];
  }
};
struct FastHoop {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T sine = sin(z[0]);
    return z[1] * z[1] / 2 - 10000 * sine * sine / 2 - 981 * cos(z[0]) / 100;
  }
};

TEST(JudgedSystems, TrueSystemsRaiseNoFalseAlarms) {
  static const System<DampedKepler> kepler{{.name = "damped-kepler",
                                            .title = "",
                                            .reference = "",
                                            .initial = {Real(1), Real(0), Real(0), Real(1)}}};
  static const System<EmdenFowler> emden{
      {.name = "emden-fowler", .title = "", .reference = "", .initial = {Real(1), Real(0)}}};
  static const System<FastHoop> hoop{
      {.name = "fast-hoop", .title = "", .reference = "", .initial = {Real(1), Real(0)}}};
  int judged = 0;
  for (const SystemPlugin* system : std::initializer_list<const SystemPlugin*>{&kepler, &emden, &hoop}) {
    EXPECT_EQ(bad(check_system(*system)), Names{}) << system->name();
    for (const char* name :
         {"gauss", "rk4", "verlet", "implicit-midpoint", "composition", "odeint-dopri5", "leap-frog"}) {
      const MethodPlugin& method = integrators().get(name, "integrator");
      for (const Assignments& parameters : method.instances(true)) {
        const auto instance = method.make(parameters);
        const auto model = system->make({});
        if (!instance->refuses(*model).empty()) continue;
        const auto checks = check_method(*instance, parameters, system->name(), model);
        std::string made = std::string(name) + " on " + system->name();
        for (const auto& [key, value] : parameters) made += " " + key + "=" + value;
        EXPECT_EQ(bad(checks), Names{}) << made;
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 30);
}
// A bead on a line that is carried along, y = t^2/2. Its exact solution begins on the line of the time t0.
struct CarriedBead {
  static constexpr int dimension = 4, constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    phi[0] = q[1] - t * t / 2;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& t0, In<T> z, Out<T> end) const {
    const T t = t0 + elapsed;
    end[0] = z[0] + z[2] * elapsed;
    end[1] = t * t / 2;
    end[2] = z[2];
    end[3] = t;
  }
};

TEST(JudgedSystems, ExactSolutionsOnSurfacesThatMove) {
  static const System<CarriedBead> carried{{.name = "carried-bead",
                                            .title = "",
                                            .reference = "",
                                            .coordinates = {{"x", ""}, {"y", ""}, {"p_x", ""}, {"p_y", ""}},
                                            .initial = {Real(1), 0, Real::fraction(1, 2), 0}}};
  EXPECT_EQ(bad(check_system(carried)), Names{});
}

// A pendulum on a rod whose length is a power of ten, and whose start somebody computed in doubles.
template <int exponent>
struct Rod : pfaff::testing::FallingParticle {
  static constexpr int constraint_count = 1;
  static Real length() { return exponent < 0 ? 1e-9_r : exponent > 0 ? 1e9_r : Real(1); }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = q[0] * q[0] + q[1] * q[1] - T(length() * length());
  }
};
// Whether a rod that begins there is found not to begin on its constraint.
template <int exponent>
bool begins_off(const char* name, const Real& x, const Real& y) {
  static std::vector<std::unique_ptr<const SystemPlugin>> kept;
  SystemDescriptor descriptor{.name = name, .title = "", .reference = ""};
  descriptor.coordinates = {{"x", ""}, {"y", ""}, {"p_x", ""}, {"p_y", ""}};
  descriptor.initial = {Rod<exponent>::length() * x, Rod<exponent>::length() * y, 0, 0};
  kept.push_back(std::make_unique<System<Rod<exponent>>>(descriptor));
  const Names faults = bad(check_system(*kept.back()));
  return std::find(faults.begin(), faults.end(), "initial state is on the constraints") != faults.end();
}
TEST(JudgedSystems, StartsThatWereComputedInDoublesAreOnTheSurfaceToTheirDigits) {
  const Real x = 0.29552020666133955_r,
             y = -0.955336489125606_r;  // sin .3 and -cos .3, as a double prints them
  EXPECT_FALSE(begins_off<0>("rod-in-doubles", x, y));
  EXPECT_TRUE(begins_off<0>("rod-in-few-digits", 0.2955202066_r, y));
  EXPECT_TRUE(begins_off<0>("rod-moved", 0.29552020666143955_r, y));
  // A start that is off by a thousandth is, in all units of length.
  EXPECT_TRUE(begins_off<-9>("rod-off-small", 0.296_r, y));
  EXPECT_TRUE(begins_off<0>("rod-off", 0.296_r, y));
  EXPECT_TRUE(begins_off<9>("rod-off-large", 0.296_r, y));
}

}  // namespace
