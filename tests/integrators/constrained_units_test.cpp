// Methods on a constraint surface whose coordinates are counted in very different units.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "surface_motion.hpp"

namespace pfaff {
namespace {

using testing::method_named;
using testing::surface_motion;
using testing::SurfaceMotion;

// A bead on a sphere, of which the first position is counted in `unit` of the others, a power of two: what is
// computed differs from that in one unit by the exponents of numbers alone.
struct SphereInUnits {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real unit = 1;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const T first = p[0] / T(unit);
    return (first * first + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1] + q[0] * T(unit) * q[2];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const T first = q[0] * T(unit);
    phi[0] = first * first + q[1] * q[1] + q[2] * q[2] - 1;
  }
};

// Two beads on circles, at rest at the lowest point of the one, which is the origin of its coordinates; both
// coordinates of the first are counted in `unit` of those of the second. A third bead is in no constraint,
// and its position is as many of its units.
struct BeadsInUnits {
  static constexpr int dimension = 10;
  static constexpr int constraint_count = 2;
  Real unit = 1;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const T x = p[0] / T(unit), z = p[1] / T(unit), free = p[4] * T(unit);
    return (x * x + z * z + p[2] * p[2] + p[3] * p[3] + free * free) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1] * T(unit) + q[0] * T(unit) * q[2] + q[4] / T(unit) * q[3];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const T x = q[0] * T(unit), z = q[1] * T(unit) - 1;
    phi[0] = (x * x + z * z - 1) / 2;
    phi[1] = (q[2] * q[2] + q[3] * q[3] - 1) / 2;
  }
};

// Coordinates times these are counted in one unit, as those of the result are.
SurfaceMotion<double> ended(const char* method, const std::shared_ptr<const Model>& model,
                            const std::vector<double>& scales) {
  SurfaceMotion<double> run = surface_motion(method, model, 0.0625, 200);
  EXPECT_EQ(run.status, Status::converged) << method;
  for (std::size_t k = 0; k < scales.size(); ++k) run.z[k] *= scales[k];
  return run;
}
std::shared_ptr<const Model> sphere(int unit) {
  return make_model(
      SystemDescriptor{
          .name = "sphere-in-units",
          .title = "a bead on a sphere",
          .reference = "landau-lifshitz1976",
          .coordinates = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"px", ""}, {"py", ""}, {"pz", ""}},
          .initial = {Real(1) / Real(unit), 0, 0, 0, Real::fraction(7, 10), Real::fraction(1, 2)}},
      SphereInUnits{Real(unit)});
}
SurfaceMotion<double> on_a_sphere(const char* method, int unit) {
  const auto u = static_cast<double>(unit);
  return ended(method, sphere(unit), {u, 1, 1, 1 / u, 1, 1});
}
SurfaceMotion<double> of_beads(const char* method, int unit) {
  const auto u = static_cast<double>(unit);
  const auto model =
      make_model(SystemDescriptor{.name = "beads-in-units",
                                  .title = "beads on circles",
                                  .reference = "landau-lifshitz1976",
                                  .coordinates = {{"x1", ""},
                                                  {"z1", ""},
                                                  {"x2", ""},
                                                  {"z2", ""},
                                                  {"s", ""},
                                                  {"px1", ""},
                                                  {"pz1", ""},
                                                  {"px2", ""},
                                                  {"pz2", ""},
                                                  {"ps", ""}},
                                  .initial = {0, 0, 1, 0, Real(unit), 0, 0, 0, Real::fraction(1, 2), 0}},
                 BeadsInUnits{Real(unit)});
  return ended(method, model, {u, u, 1, 1, 1 / u, 1 / u, 1 / u, 1, 1, u});
}

// Sums of two or three squares have some 4 units of round-off. The motions differ where an iteration more is
// made, by what is left of a convergence at round-off, which 200 steps of 1/16 enlarge to less than a
// thousand units. Three iterations more see that phi has come to its rounding, in one solve of each step of
// RATTLE and in two of SHAKE.
TEST(ConstrainedUnits, StepsEndAtRoundOffInAnyUnits) {
  for (const auto& [method, solves] : {std::pair("rattle", 200), std::pair("shake", 400)}) {
    for (const auto& of : {on_a_sphere, of_beads}) {
      const SurfaceMotion<double> alike = of(method, 1);
      for (const int unit : {1024, 1048576, 1073741824}) {
        SCOPED_TRACE(std::string(method) + (of == on_a_sphere ? " on a sphere" : " of beads") + ", unit " +
                     std::to_string(unit));
        const SurfaceMotion<double> other = of(method, unit);
        EXPECT_LE(other.off_surface, 1e-15);
        for (std::size_t k = 0; k < other.z.size(); ++k)
          EXPECT_NEAR(other.z[k], alike.z[k], 2e-13) << "coordinate " << k;
        EXPECT_LE(other.iterations, alike.iterations + 3 * solves);
      }
    }
  }
}

TEST(ConstrainedUnits, DerivativesOfStepsConvergeInAnyUnits) {
  for (const char* method : {"rattle", "shake", "lobatto-spark", "projected-rk4"}) {
    const auto jacobian = [method](int unit) {
      const auto model = sphere(unit);
      const auto instance = method_named(method);
      StepDifferentiator<double> differentiate(*instance, motion_for(*instance, model));
      const auto step = differentiate(0.0, 0.0625, testing::initial_state<double>(*model));
      EXPECT_EQ(step.status, Status::converged) << method << ", unit " << unit;
      return step.jacobian;
    };
    const std::vector<double> alike = jacobian(1);
    for (const int unit : {1024, 1048576, 1073741824}) {
      const std::vector<double> other = jacobian(unit), scales{double(unit), 1, 1, 1.0 / unit, 1, 1};
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
          EXPECT_NEAR(other[i * 6 + j] * scales[i] / scales[j], alike[i * 6 + j], 1e-13)
              << method << ", unit " << unit << ", entry " << i << ", " << j;
    }
  }
}

// Beads of a long chain lie at a hundredth and at all of its length from where it hangs. What rounding leaves
// of the small coordinates, and how much a correction gains, is seen in every sixteenth step alone; the
// others make the one or two corrections that change something, and would make four to see that.
TEST(ConstrainedUnits, SmallCoordinatesCostNoCorrectionsInVain) {
  const auto model = systems().get("n-pendulum", "system").make({{"bobs", "64"}, {"dimension", "3"}});
  std::vector<double> start;
  for (const Real& x : model->initial()) start.push_back(x.value());
  const auto method = integrators().get("rattle", "integrator").make({});
  Integration<double> run(start_with(*method, model, start, 1e-3, 0.0));
  run.steps(300).expect_reached();
  EXPECT_LE(run.counters().iterations, 300 * 2.5);
}

}  // namespace
}  // namespace pfaff
