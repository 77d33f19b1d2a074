// Iterations that end at the rounding of what they solve, whatever that is in units of the coordinates: of
// constants in a constraint, from rest at the origin, and of small coordinates beside large ones. Those that
// do not converge are still told from them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/support/coordinate_convergence.hpp>

#include "surface_motion.hpp"

namespace pfaff {
namespace {

using testing::surface_motion;
using testing::SurfaceMotion;

constexpr std::array on_surfaces{"rattle",        "shake",           "yoshida-rattle",
                                 "lobatto-spark", "projected-gauss", "projected-rk4"};

// A bead on a circle, counted from its lowest point: phi is made of numbers that are larger than positions.
struct FromLowestPoint {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 1;
  Real radius = 1;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1] * 10;
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const T z = q[1] - T(radius);
    phi[0] = (q[0] * q[0] + z * z - T(radius) * T(radius)) / 2;
  }
};
// A bead at rest that is pushed off the origin; its first position is counted in `unit` of the second.
struct PushedOff {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 1;
  Real unit = 1;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const T first = p[0] / T(unit);
    return (first * first + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    phi[0] = q[1] - q[0] * T(unit) - t * t / 2;
  }
};
// A bead that falls along a square whose corners are rounded in the width `bend`, or not at all.
struct RoundedSquare {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 1;
  Real bend = 0;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const T square = T(bend) * T(bend);
    phi[0] = sqrt(q[0] * q[0] + square) + sqrt(q[1] * q[1] + square) - T(1);
  }
};
// A pendulum beside a particle that is far away, and whose circle becomes smaller until there is none.
struct BesideFree {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real shrinking = 0;

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1] * 10;
  }
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] - (1 - T(shrinking) * t)) / 2;
  }
};

template <class System>
std::shared_ptr<const Model> model_of(const System& system, std::vector<Real> initial) {
  SystemDescriptor descriptor{.name = "a-bead", .title = "a bead", .reference = "landau-lifshitz1976"};
  for (std::size_t k = 0; k < initial.size(); ++k)
    descriptor.coordinates.push_back({(k < initial.size() / 2 ? "q" : "p") + std::to_string(k), ""});
  descriptor.initial = std::move(initial);
  return make_model(descriptor, system);
}

template <class T>
SurfaceMotion<T> run_of(const char* method, const std::shared_ptr<const Model>& model, int steps) {
  return surface_motion<T>(method, model, T(1) / T(128), steps);
}

template <class T>
void ends_at_the_rounding_of_constants() {
  for (const char* method : on_surfaces)
    for (const int radius : {10, 1000, 1000000}) {
      SCOPED_TRACE(std::string(method) + ", radius " + std::to_string(radius));
      const auto model = model_of(FromLowestPoint{Real(radius)}, {0, 0, Real::fraction(1, 100), 0});
      const SurfaceMotion<T> run = run_of<T>(method, model, 50);
      EXPECT_EQ(run.status, Status::converged);
      EXPECT_LE(run.off_surface, 4 * unit_roundoff<T>() * T(radius) * T(radius));
    }
}
TEST(CoordinateConvergence, EndsAtTheRoundingOfConstants) {
  ends_at_the_rounding_of_constants<double>();
  ends_at_the_rounding_of_constants<Quad>();
}

TEST(CoordinateConvergence, LeavesTheOriginFromRest) {
  for (const char* method : on_surfaces)
    for (const Real& unit : {Real(1000000), Real(1) / Real(1000000), Real(1000000) * Real(1000000)}) {
      const SurfaceMotion<double> run = run_of<double>(method, model_of(PushedOff{unit}, {0, 0, 0, 0}), 50);
      EXPECT_EQ(run.status, Status::converged) << method;
      EXPECT_LE(run.off_surface, 1e-15) << method;
    }
}

// What is beside the pendulum does not change it: its motion differs by where iterations end in round-off.
// Not that of projected-gauss, whose steps before their projection are of lower accuracy beside so large a
// number.
TEST(CoordinateConvergence, SolvesSmallCoordinatesBesideLargeOnes) {
  for (const char* method : {"rattle", "shake", "yoshida-rattle", "lobatto-spark", "projected-rk4"}) {
    const auto beside = [&](const Real& place) {
      const auto three = Real::fraction(3, 5), four = Real::fraction(4, 5);
      return run_of<double>(method, model_of(BesideFree{}, {three, -four, place, four, three, 1}), 100);
    };
    const SurfaceMotion<double> near = beside(0), far = beside(Real(1000000) * Real(1000000));
    for (const std::size_t k : {0, 1, 3, 4}) EXPECT_NEAR(far.z[k], near.z[k], 1e-13) << method;
    EXPECT_LE(far.off_surface, 4e-16) << method;
  }
}

TEST(CoordinateConvergence, DoesNotConvergeWhereThereIsNoSolution) {
  for (const char* method : on_surfaces) {
    const auto model =
        model_of(BesideFree{Real(20)}, {Real::fraction(3, 5), Real::fraction(-4, 5), 0, -6, 8, 0});
    const SurfaceMotion<double> run = run_of<double>(method, model, 20);
    EXPECT_NE(run.status, Status::converged) << method;
  }
}

// Where a constraint bends within a step, an iteration may run in a circle about the corner, to which it
// comes back from a kick: that is no rounding. Whatever the steps before it say, they are on the surface.
TEST(CoordinateConvergence, DoesNotTakeACircleAboutACornerForRounding) {
  for (const char* method : {"rattle", "shake", "yoshida-rattle", "lobatto-spark"})
    for (const Real& bend : {Real(0), Real::fraction(1, 10000)}) {
      const Real half = Real::fraction(1, 2);
      const auto model =
          model_of(RoundedSquare{bend}, {Real::fraction(3, 5), Real::fraction(-2, 5), half, half});
      const SurfaceMotion<double> run = run_of<double>(method, model, 512);
      EXPECT_LE(run.off_surface, 1e-15) << method;
    }
}

// Iterations for one unknown, beside a number of size 1, from a start near the solution 0.
Status ended(const std::function<double(double)>& correction, double start = 1e-6) {
  CoordinateConvergence<double> convergence;
  double x = start;
  do {
    std::array<double, 1> next{correction(x)};
    convergence.kick(next);
    x = x - next[0];
    VectorCorrections<double> corrections(convergence.each());
    corrections.against(1.0);
    corrections.add(next[0], x, x);
    convergence.begin_iteration();
    convergence.add(corrections);
  } while (!convergence.finished(50));
  return convergence.status();
}
TEST(CoordinateConvergence, TellsRoundingFromStagnation) {
  // Rounding of 1e-9, with contractions that end in it.
  int turn = 0;
  const auto rounding = [&turn] { return (++turn % 3 + 1) * 1e-9; };
  for (const double contraction : {0.0, 1e-3, 0.1, -0.1, 0.4}) {
    EXPECT_EQ(ended([&](double x) { return (1 - contraction) * x + rounding(); }), Status::converged);
    EXPECT_EQ(ended([&](double x) { return (1 - contraction) * x + rounding(); }, 0), Status::converged);
  }
  // Controls: it turns around the solution, comes nearer too slowly, goes away from it, or there is none.
  // From 3e-8 on it stays below what may be rounding, and is kicked; from 1e-6 on it does not.
  for (const double start : {3e-8, 1e-6})
    for (const double contraction : {-1.0, -0.95, 0.8, 0.99, 1.0, 1.01, 1.5})
      EXPECT_NE(ended([&](double x) { return (1 - contraction) * x + 1e-10; }, start), Status::converged)
          << contraction << ", from " << start;
  for (const double gap : {1e-16, 1e-6, 1e-3, 1.0}) {
    const double width = std::sqrt(gap);
    EXPECT_NE(ended([gap](double x) { return (x * x + gap) / (2 * x); }, 1.3 * width), Status::converged);
    EXPECT_NE(ended([&](double x) { return (x * x + gap) / (2 * width); }, width), Status::converged);
  }
  EXPECT_EQ(ended([](double) { return std::numeric_limits<double>::quiet_NaN(); }), Status::non_finite);
}

}  // namespace
}  // namespace pfaff
