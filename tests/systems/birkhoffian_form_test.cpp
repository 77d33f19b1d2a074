// The Birkhoffian form of a system at a point: K, D, F, B, degeneracy with its kernel, class.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include <pfaff/brackets/birkhoffian/birkhoffian_form.hpp>
#include <pfaff/core/linear/singular_values.hpp>

#include "../eigen/decompositions.hpp"
#include "samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Samples;

template <class T>
Matrix<T> matrix(std::size_t n, const std::vector<double>& entries) {
  return Matrix<T>(n, std::vector<T>(entries.begin(), entries.end()));
}

TEST(SingularValues, AgreeWithEigen) {
  Samples samples(7);
  for (const int n : {1, 2, 4, 7, 10}) {
    Eigen::MatrixXd a(n, n);
    Matrix<double> mine(static_cast<std::size_t>(n), static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        mine(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = a(i, j) = samples.number(-1, 1);
    if (n == 7) {  // a column twice: rank 6
      a.col(6) = a.col(2);
      for (std::size_t i = 0; i < 7; ++i) mine(i, 6) = mine(i, 2);
    }
    auto values = singular_values(mine).values;
    std::sort(values.rbegin(), values.rend());
    const Eigen::VectorXd expected = pfaff::testing::singular_values_by_eigen(a);
    for (int k = 0; k < n; ++k)
      EXPECT_NEAR(values[static_cast<std::size_t>(k)], expected[k], 1e-14 * n) << n << ' ' << k;
  }
}

TEST(Degeneracy, RegularAndItsCondition) {
  const auto canonical = degeneracy(matrix<double>(2, {0, -1, 1, 0}));
  EXPECT_TRUE(canonical.regular);
  EXPECT_EQ(canonical.condition, 1);
  EXPECT_TRUE(canonical.kernel.empty());
  const auto quad = degeneracy(matrix<Quad>(4, {0, -3, 0, 0, 3, 0, 0, 0, 0, 0, 0, -0.5, 0, 0, 0.5, 0}));
  EXPECT_TRUE(quad.regular);
  EXPECT_LE(abs(quad.condition - Quad(6)), Quad(1e-32));
  // Units alone: pairs of coordinates in units that differ by 1e20 do not make K degenerate in double.
  const auto units =
      degeneracy(matrix<double>(4, {0, -1e10, 0, 0, 1e10, 0, 0, 0, 0, 0, 0, -1e-10, 0, 0, 1e-10, 0}));
  EXPECT_TRUE(units.regular);
  EXPECT_NEAR(units.condition / 1e20, 1, 1e-13);
}

template <class T>
void expect_kernel(const std::vector<double>& entries, const std::vector<std::vector<double>>& kernel) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(entries.size()))));
  const auto found = degeneracy(matrix<T>(n, entries));
  EXPECT_FALSE(found.regular);
  ASSERT_EQ(found.kernel.size(), kernel.size());
  for (const auto& expected : kernel) {
    bool there = false;
    for (const auto& direction : found.kernel) {
      T worst(0);
      for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, T(abs(direction[i] - T(expected[i]))));
      there = there || worst <= T(100) * std::numeric_limits<T>::epsilon();
    }
    EXPECT_TRUE(there) << expected[0] << ' ' << expected[1];
  }
}

TEST(Degeneracy, KernelInTheCoordinates) {
  // All zero; a skew matrix of odd size, a x v with a = (1, 2, 4); z1 and z2 beside a pair; rank two in four
  // dimensions, dK = (dz1 + dz2/2) ^ dz3.
  expect_kernel<double>({0, 0, 0, 0}, {{1, 0}, {0, 1}});
  expect_kernel<double>({0, -4, 2, 4, 0, -1, -2, 1, 0}, {{0.25, 0.5, 1}});
  expect_kernel<Quad>({0, -4, 2, 4, 0, -1, -2, 1, 0}, {{0.25, 0.5, 1}});
  expect_kernel<double>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0}, {{1, 0, 0, 0}, {0, 1, 0, 0}});
  expect_kernel<Quad>({0, 0, 1, 0, 0, 0, 0.5, 0, -1, -0.5, 0, 0, 0, 0, 0, 0},
                      {{-0.5, 1, 0, 0}, {0, 0, 0, 1}});
  EXPECT_EQ(degeneracy(matrix<double>(2, {0, 0, 0, 0})).condition, std::numeric_limits<double>::infinity());
  // Control: nearly degenerate is regular, with the condition that says so.
  const auto near =
      degeneracy(matrix<double>(4, {0, 0, 1, 0, 0, 0, 0.5, 1e-9, -1, -0.5, 0, 0, 0, -1e-9, 0, 0}));
  EXPECT_TRUE(near.regular);
  EXPECT_GT(near.condition, 1e8);
}

// dz1 ^ dz3 + (1 + e) dz2 ^ dz4 + dz1 ^ dz4 + dz2 ^ dz3: entries of one size, so that no choice of units
// helps, and a smallest singular value of e/2.
TEST(Degeneracy, IsJudgedByRoundOff) {
  const auto near = [](double e) {
    return degeneracy(matrix<double>(4, {0, 0, 1, 1, 0, 0, 1, 1 + e, -1, -1, 0, 0, -1, -1 - e, 0, 0}));
  };
  EXPECT_TRUE(near(0x1p-46).regular);
  EXPECT_FALSE(near(0x1p-51).regular);
}

TEST(Degeneracy, WhatIsNotFiniteIsNotRegular) {
  const auto broken = degeneracy(matrix<double>(2, {0, -NAN, 1, 0}));
  EXPECT_FALSE(broken.regular);
  EXPECT_TRUE(std::isnan(broken.condition));
  EXPECT_TRUE(broken.kernel.empty());
}

// One pair of coordinates, F and B with and without time.
struct Pair {
  static constexpr int dimension = 2;
  bool form_moves = false, function_moves = false;
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    const T energy = (z[0] * z[0] + z[1] * z[1]) / 2;
    return function_moves ? energy + z[0] * sin(t) : energy;
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = form_moves ? exp(t) * z[1] : z[1];
  }
};
// K zdot + D = 0 with K_12 = -q (degenerate on q = 0) and D = (q f(t), 0).
struct Written {
  static constexpr int dimension = 2;
  bool structure_moves = false, covector_moves = false;
  template <class T>
  void structure(const T& t, In<T> z, Out<T> K) const {
    K[1] = structure_moves ? -(z[0] * exp(t)) : -z[0];
    K[2] = -K[1];
  }
  template <class T>
  void covector(const T& t, In<T> z, Out<T> D) const {
    D[0] = covector_moves ? z[0] * sin(t) : -z[0];
    D[1] = -z[1];
  }
};
template <class S>
std::shared_ptr<const Model> oscillator_of(const S& object) {
  SystemDescriptor descriptor;
  descriptor.name = "test";
  descriptor.coordinates = {{"q", ""}, {"p", ""}};
  descriptor.initial = {1, 0};
  return make_model(descriptor, object);
}

TEST(BirkhoffianClass, IsThatOfTheDefinition) {
  using enum BirkhoffianClass;
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Pair{})), autonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Pair{.function_moves = true})), semi_autonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Pair{.form_moves = true})), nonautonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Pair{.form_moves = true, .function_moves = true})),
            nonautonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Written{})), autonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Written{.covector_moves = true})), semi_autonomous);
  EXPECT_EQ(birkhoffian_class(*oscillator_of(Written{.structure_moves = true})), nonautonomous);
}

template <class T>
void expect_damped_oscillator(double tolerance) {
  const auto model = systems().get("damped-oscillator", "system").make({{"nu", "0.25"}});
  const T t(0.5), r(1.5), p(-0.75), e = exp(T(0.125)), nu(0.25);
  const std::vector<T> z{r, p};
  const auto form = birkhoffian_form<T>(*model, std::nullopt, t, z);
  const auto near = [&](const T& a, const T& b) { EXPECT_LE(abs(a - b), T(tolerance)); };
  near(form.structure(0, 1), -e);
  near(form.structure(1, 0), e);
  near(form.structure(0, 0), T(0));
  near(form.one_form[0], e * p / T(2));
  near(form.one_form[1], -(e * r) / T(2));
  near(form.one_form_rate[0], nu * e * p / T(2));
  near(form.one_form_rate[1], -(nu * e * r) / T(2));
  near(form.birkhoffian, e * (r * r + nu * r * p + p * p) / T(2));
  near(form.covector[0], -(e * (r + nu * p)));
  near(form.covector[1], -(e * p));
  EXPECT_TRUE(form.degeneracy.regular);
  EXPECT_EQ(birkhoffian_class(*model), BirkhoffianClass::nonautonomous);
  // About the origin K = e^{nu t} J and linear D give back F, symmetric as it is, and B = -x.D/2.
  const auto inverse = birkhoffian_form<T>(*model, std::vector<Real>(2), t, z);
  near(inverse.one_form[0], form.one_form[0]);
  near(inverse.one_form[1], form.one_form[1]);
  near(inverse.birkhoffian, form.birkhoffian);
  const auto moved = birkhoffian_form<T>(*model, std::vector<Real>{1, 1}, t, z);  // control: another gauge
  EXPECT_GT(abs(moved.one_form[0] - form.one_form[0]), T(0.1));
}

TEST(BirkhoffianForm, OfTheDampedOscillator) {
  expect_damped_oscillator<double>(1e-14);
  expect_damped_oscillator<Quad>(1e-31);
}

TEST(BirkhoffianForm, DegenerateAndWithoutACentre) {
  const auto model = oscillator_of(Written{});
  const std::vector<double> edge{0, 2}, inside{0.5, 2};
  const std::vector<Real> centre{1, 0};
  const auto there = birkhoffian_form<double>(*model, centre, 0, edge);
  EXPECT_FALSE(there.degeneracy.regular);
  EXPECT_EQ(there.degeneracy.kernel.size(), 2U);
  EXPECT_TRUE(birkhoffian_form<double>(*model, centre, 0, inside).degeneracy.regular);
  EXPECT_THROW(birkhoffian_form<double>(*model, std::nullopt, 0, inside), std::invalid_argument);
}

}  // namespace
