// Methods on a constraint surface whose coordinates are counted in very different units.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;

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

struct Ended {
  std::vector<double> z;   // in the same units for all
  double off_surface = 0;  // the largest |phi| after a step
  std::int64_t iterations = 0;
};

Ended ended(const char* method, const Assignments& parameters, std::int64_t unit) {
  const auto model = make_model(
      SystemDescriptor{
          .name = "sphere-in-units",
          .title = "a bead on a sphere",
          .reference = "landau-lifshitz1976",
          .coordinates = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"px", ""}, {"py", ""}, {"pz", ""}},
          .initial = {Real(1) / Real(unit), 0, 0, 0, Real::fraction(7, 10), Real::fraction(1, 2)}},
      SphereInUnits{Real(unit)});
  const auto instance = method_named(method, parameters);
  Integration<double> run(start_with<double>(*instance, motion_for(*instance, model),
                                             testing::initial_state<double>(*model), 0.0625, 0.0));
  Ended end;
  const auto scale = static_cast<double>(unit);
  for (int step = 0; step < 200; ++step) {
    EXPECT_EQ(run.steps(1).status(), Status::converged) << method << ", unit " << unit << ", step " << step;
    const auto z = run.state();
    const double x = z[0] * scale;
    end.off_surface = std::max(end.off_surface, std::fabs(x * x + z[1] * z[1] + z[2] * z[2] - 1));
  }
  end.z.assign(run.state().begin(), run.state().end());
  end.z[0] *= scale;
  end.z[3] /= scale;
  end.iterations = run.counters().iterations;
  return end;
}

// The sum of three squares has some 4 units of round-off. The motions differ where an iteration more is made,
// by what is left of a convergence at round-off, which 200 steps of 1/16 enlarge to less than a thousand
// units.
TEST(ConstrainedUnits, StepsEndAtRoundOffInAnyUnits) {
  const std::vector<std::pair<const char*, Assignments>> methods{
      {"rattle", {}}, {"shake", {}}, {"lobatto-spark", {{"stages", "3"}}}, {"projected-rk4", {}}};
  for (const auto& [method, parameters] : methods) {
    const Ended alike = ended(method, parameters, 1);
    for (const std::int64_t unit : {1024, 1048576, 1073741824}) {
      const Ended other = ended(method, parameters, unit);
      EXPECT_LE(other.off_surface, 1e-15) << method << ", unit " << unit;
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(other.z[k], alike.z[k], 2e-13) << method << ", unit " << unit << ", coordinate " << k;
      EXPECT_LE(other.iterations, alike.iterations + 200) << method << ", unit " << unit;
    }
  }
}

}  // namespace
}  // namespace pfaff
