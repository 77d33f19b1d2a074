// Jacobi's functions and the motion x' = y z, y' = -x z, z' = -x y.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/elliptic.hpp>

namespace {
using namespace pfaff;

// A dozen transformations, each a few roundings: 20 units, 2e-33, for arguments of order one.
constexpr double transformation_bound = 4e-33;

double gap(Quad a, Quad b) { return static_cast<double>(abs(a - b)); }

TEST(Elliptic, AgreesWithPublishedDigits) {
  // K(1/2) = Gamma(1/4)^2 / (4 sqrt pi).
  Quad quarter, pi;
  ASSERT_TRUE(parse("1.85407467730137191843385034719526004621759882352", quarter));
  ASSERT_TRUE(parse("3.14159265358979323846264338327950288419716939937510", pi));
  const Quad half(0.5);
  const auto at = [&](Quad u) { return jacobi_functions(u, half, half); };
  EXPECT_LE(gap(at(quarter).sn, Quad(1)), transformation_bound);
  EXPECT_LE(gap(at(quarter).cn, Quad(0)), transformation_bound);
  EXPECT_LE(gap(at(quarter).dn, sqrt(half)), transformation_bound);
  EXPECT_LE(gap(at(quarter).mean, pi / Quad(2)), transformation_bound);
  EXPECT_LE(gap(at(quarter + quarter).sn, Quad(0)), transformation_bound);
  // At half the quarter period sn = 1/sqrt(1 + k') (abramowitz-stegun1964 16.5).
  EXPECT_LE(gap(at(quarter / Quad(2)).sn, Quad(1) / sqrt(Quad(1) + sqrt(half))), transformation_bound);
  EXPECT_GT(gap(at(quarter * Quad(1 + 1e-12)).cn, Quad(0)), 1e-13);  // control
}

TEST(Elliptic, SatisfiesIdentitiesAndEquationsForEveryModulus) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> argument(-6, 6), exponent(-75, 0);
  using D = Dual<Quad, 1>;
  for (int k = 0; k < 300; ++k) {
    // m or its complement is a power of ten down to 1e-75, below the limit of the transformations.
    const Quad small = exp(Quad(exponent(random)) * log(Quad(10))), u(argument(random));
    const bool near_one = k % 2 == 0;
    const Quad m = near_one ? Quad(1) - small : small, complement = near_one ? small : Quad(1) - small;
    const auto f = jacobi_functions(D::variable(u, 0), D(m), D(complement));
    const auto [sn, cn, dn] = std::array{f.sn.value, f.cn.value, f.dn.value};
    EXPECT_LE(gap(sn * sn + cn * cn, Quad(1)), transformation_bound);
    EXPECT_LE(gap(dn * dn + m * sn * sn, Quad(1)), transformation_bound);
    // cosh 6 = 200 magnifies the error of the derivative near the separatrix.
    EXPECT_LE(gap(f.sn.derivative[0], cn * dn), 2e-31);
    EXPECT_LE(gap(f.cn.derivative[0], -sn * dn), 2e-31);
    EXPECT_LE(gap(f.dn.derivative[0], -m * sn * cn), 2e-31);
    EXPECT_GT(dn, Quad(0));
  }
}

TEST(Elliptic, TheSeparatrixIsHyperbolic) {
  for (const double u : {-40.0, -3.0, 0.0, 0.5, 7.0}) {
    const Quad e = exp(Quad(u)), tanh = (e * e - Quad(1)) / (e * e + Quad(1)),
               secant = Quad(2) * e / (e * e + Quad(1));
    for (const double complement : {0.0, 1e-75, 1e-69}) {
      const auto f = jacobi_functions(Quad(u), Quad(1), Quad(complement));
      EXPECT_LE(gap(f.sn, tanh), transformation_bound) << u;
      EXPECT_LE(gap(f.cn, secant), transformation_bound) << u;
      EXPECT_LE(gap(f.dn, secant), transformation_bound) << u;
    }
  }
  // Far out nothing overflows into NaN.
  const auto far = jacobi_functions(2000.0, 1.0, 0.0);
  EXPECT_EQ(far.sn, 1);
  EXPECT_EQ(far.cn, 0);
}

TEST(Elliptic, AnglesAreThoseOfTheirSineAndCosine) {
  Quad pi;
  ASSERT_TRUE(parse("3.14159265358979323846264338327950288419716939937510", pi));
  for (int k = -400; k <= 400; ++k) {
    const Quad angle = Quad(k) / Quad(400) * pi * Quad(1 - 1e-9);
    EXPECT_LE(gap(angle_of(cos(angle), sin(angle)), angle), 2e-33) << k;
    const double rounded = static_cast<double>(angle);
    EXPECT_NEAR(angle_of(std::cos(rounded), std::sin(rounded)), rounded, 4.5e-16) << k;
  }
  EXPECT_EQ(angle_of(1.0, 0.0), 0);
  EXPECT_EQ(angle_of(1.0, 1e-200), 1e-200);
  EXPECT_DOUBLE_EQ(angle_of(0.0, -1.0), -std::acos(0.0));
  EXPECT_NEAR(std::fabs(angle_of(-1.0, 0.0)), std::acos(-1.0), 4.5e-16);
}

JacobiState<Quad> state_after(const JacobiState<Quad>& s, Quad t) { return jacobi_flow(t, s).state; }
double gap(const JacobiState<Quad>& a, const JacobiState<Quad>& b) {
  return std::max({gap(a.x, b.x), gap(a.y, b.y), gap(a.z, b.z)});
}

TEST(Elliptic, TheFlowIsAGroupAndKeepsItsInvariants) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int k = 0; k < 200; ++k) {
    JacobiState<Quad> s{Quad(number(random)), Quad(number(random)), Quad(number(random))};
    if (k % 10 == 0) s.y = k % 20 == 0 ? s.z : -s.z;  // the separatrix
    if (k % 10 == 1) s.z = Quad(0);
    if (k % 10 == 2) s.x = s.y = Quad(0);
    const Quad a(number(random)), b(number(random));
    const JacobiState<Quad> once = state_after(s, a + b), twice = state_after(state_after(s, a), b);
    // |state| |time| up to 10, and e^4 near the separatrix.
    EXPECT_LE(gap(once, twice), 1e-31) << k;
    EXPECT_LE(gap(state_after(state_after(s, a), -a), s), 1e-31) << k;
    EXPECT_LE(gap(once.x * once.x + once.y * once.y, s.x * s.x + s.y * s.y), 1e-32) << k;
    EXPECT_LE(gap(once.x * once.x + once.z * once.z, s.x * s.x + s.z * s.z), 1e-32) << k;
    EXPECT_EQ(gap(state_after(s, Quad(0)), s) < 1e-33, true) << k;
    // The field: x' = y z, y' = -x z, z' = -x y.
    using D = Dual<Quad, 1>;
    const auto d = jacobi_flow(D::variable(Quad(0), 0), JacobiState<D>{D(s.x), D(s.y), D(s.z)}).state;
    EXPECT_LE(
        gap({d.x.derivative[0], d.y.derivative[0], d.z.derivative[0]}, {s.y * s.z, -s.x * s.z, -s.x * s.y}),
        transformation_bound)
        << k;
  }
}

TEST(Elliptic, EquilibriaStay) {
  for (const JacobiState<double>& s : {JacobiState<double>{0, 0, 0},
                                       {1.5, 0, 0},
                                       {-1.5, 0, 0},
                                       {0, 2, 0},
                                       {0, -2, 0},
                                       {0, 0, 2},
                                       {0, 0, -2}})
    for (const double t : {-1000.0, 0.0, 0.1, 1e5}) {
      const auto e = jacobi_flow(t, s);
      EXPECT_DOUBLE_EQ(e.state.x, s.x);
      EXPECT_DOUBLE_EQ(e.state.y, s.y);
      EXPECT_DOUBLE_EQ(e.state.z, s.z);
    }
}

}  // namespace
