// Holonomic constraints that follow from others: which are left out, and that the motion is that of the rest.
#include <gtest/gtest.h>

#include <array>

#include <pfaff/core/facets/redundant_constraints.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

#include "../falling_particle.hpp"
#include "../formula_values.hpp"
#include "../integrators/adaptive_samples.hpp"
#include "../integrators/methods.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::after_steps;
using pfaff::testing::evaluated;
using pfaff::testing::method_named;
using pfaff::testing::sample_of;

// A plate of three points at (0, 0), (1, 0) and (1/2, 1) from its corner, hung on three parallel cranks of
// length one: six rods, five of which are enough. Every point goes round a circle, at the angle a from the
// vertical with a'' = -g sin a. `Wrong` makes the third crank longer by itself, so that it contradicts the
// others; `Rods` are the first rods alone.
template <int Rods, bool Wrong = false>
struct Plate {
  static constexpr int dimension = 12, constraint_count = Rods;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (const T& x : p) sum = sum + x * x;
    return sum / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return 2 * (q[1] + q[3] + q[5]);
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const auto square = [](const T& x, const T& y) { return x * x + y * y; };
    const std::array<T, 6> lengths{square(q[0], q[1]) - 1,
                                   square(q[2] - 1, q[3]) - 1,
                                   square(q[0] - q[2], q[1] - q[3]) - 1,
                                   square(q[2] - q[4], q[3] - q[5]) - T(5) / 4,
                                   square(q[0] - q[4], q[1] - q[5]) - T(5) / 4,
                                   square(q[4] - T(1) / 2, q[5] - 1) - (Wrong ? T(3) / 2 : T(1))};
    for (std::size_t k = 0; k < static_cast<std::size_t>(Rods); ++k) phi[k] = lengths[k];
  }
};
// At rest at the angle whose sine is 3/5 and cosine 4/5.
std::vector<Real> hanging() {
  const Real x = Real::fraction(3, 5), y = -Real::fraction(4, 5), half = Real::fraction(1, 2);
  std::vector<Real> z{x, y, x + Real(1), y, x + half, y + Real(1)};
  z.resize(12, Real(0));
  return z;
}
TEST(RedundantConstraints, ARodTooManyIsLeftOutAndFollowed) {
  const auto model = sample_of(Plate<6>{}, hanging());
  EXPECT_EQ(model->source().redundant_constraints, std::vector<std::string>{"phi6"});
  EXPECT_EQ(model->source().constraint_names.size(), 5U);
  ASSERT_EQ(model->invariants().size(), 1U);
  EXPECT_EQ(model->invariants().front().name, "phi6");
  // It is what the author wrote: off the surface too.
  std::vector<Quad> z;
  for (int k = 0; k < 12; ++k) z.push_back(Quad(k) / Quad(7));
  const Quad expected =
      (z[4] - Quad(1) / Quad(2)) * (z[4] - Quad(1) / Quad(2)) + (z[5] - Quad(1)) * (z[5] - Quad(1)) - Quad(1);
  EXPECT_LT(static_cast<double>(abs(evaluated(model, Formula::invariants, z, 1, Quad(0))[0] - expected)),
            1e-32);
}
TEST(RedundantConstraints, EnoughRodsAreAllKept) {
  EXPECT_TRUE(sample_of(Plate<5>{}, hanging())->source().redundant_constraints.empty());
}

// Two positions in one: with the crank of the third point longer than the others the state is off its
// surface, and the dependence of the gradients, which the lengths do not change, is no redundancy.
TEST(RedundantConstraints, AContradictionIsKept) {
  EXPECT_TRUE((sample_of(Plate<6, true>{}, hanging())->source().redundant_constraints.empty()));
}

// A chain of two rods that is stretched between its ends: the gradients depend on each other in this position
// and nowhere else, for there is no motion that keeps both.
struct Stretched : pfaff::testing::FallingParticle {
  static constexpr int constraint_count = 2;
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = q[0] * q[0] + q[1] * q[1] - 1;
    phi[1] = (q[0] - 2) * (q[0] - 2) + q[1] * q[1] - 1;
  }
};
TEST(RedundantConstraints, ASingularPositionIsKept) {
  EXPECT_TRUE(sample_of(Stretched{}, {1, 0, 0, 0})->source().redundant_constraints.empty());
}

// a'' = -2 sin a from rest, for each formulation and for methods that keep the constraints themselves.
TEST(RedundantConstraints, TheMotionIsThatOfAPendulum) {
  const auto model = sample_of(Plate<6>{}, hanging());
  const auto expect_acceleration = [&](const std::vector<Quad>& rate, const std::string& name) {
    // At rest p' = a'' (cos a, sin a) at every point.
    const Quad turn = -Quad(2) * Quad(3) / Quad(5);
    for (std::size_t point = 0; point < 3; ++point) {
      EXPECT_LT(static_cast<double>(abs(rate[6 + 2 * point] - turn * Quad(4) / Quad(5))), 1e-31) << name;
      EXPECT_LT(static_cast<double>(abs(rate[7 + 2 * point] - turn * Quad(3) / Quad(5))), 1e-31) << name;
    }
  };
  std::vector<Quad> z;
  for (const Real& x : model->initial()) z.push_back(x.quad());
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"})
    expect_acceleration(evaluated(formulations().get(formulation, "formulation").apply(model, {}),
                                  Formula::field, z, 12, Quad(0)),
                        formulation);
  // A run of RATTLE in quad keeps the rod that was left out as well as the others.
  const auto end = after_steps<Quad>(*method_named("rattle"), model, Quad(1) / Quad(20), 100);
  EXPECT_LT(static_cast<double>(abs(evaluated(model, Formula::invariants, end, 1, Quad(0))[0])), 1e-30);
}
}  // namespace
