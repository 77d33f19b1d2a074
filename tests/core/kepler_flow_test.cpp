// Kepler's flow in universal variables, against the orbits of books by anomalies of their own kind: the
// eccentric one of ellipses, the hyperbolic one, and Barker's equation for parabolas. These put the end of
// the flow together from the elements of the orbit and share nothing with the f and g functions.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/kepler_flow.hpp>

namespace {
using namespace pfaff;

const Quad pi = Real(3.14159265358979323846264338327950288_r).quad();

/// Position and velocity in the plane.
template <class T>
using Orbit = std::array<T, 4>;

template <class T>
Status flow(const T& mu, const T& h, Orbit<T>& z) {
  std::array<T, 4> change;
  std::array<T, 2> bend;
  const Status status =
      kepler_change<T>(mu, h, std::span<const T>(z.data(), 2), std::span<const T>(&z[2], 2),
                       std::span<T>(change.data(), 2), std::span<T>(bend), std::span<T>(&change[2], 2));
  if (status != Status::converged) return status;
  for (std::size_t k = 0; k < 2; ++k)  // to the round-off of the larger of them
    EXPECT_LE(abs(value_of(T(change[k] - h * z[2 + k] - bend[k]))),
              Value<T>(4) * unit_roundoff<T>() * (abs(value_of(change[k])) + abs(value_of(T(h * z[2 + k])))));
  for (std::size_t k = 0; k < 4; ++k) z[k] = z[k] + change[k];
  return status;
}

template <class T>
double relative(const Orbit<T>& a, const Orbit<T>& b) {
  using std::sqrt;
  double worst = 0;
  for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
    const T size = sqrt(b[first] * b[first] + b[first + 1] * b[first + 1]);
    for (std::size_t k = first; k < first + 2; ++k)
      worst = std::max(worst, static_cast<double>(abs(a[k] - b[k]) / size));
  }
  return worst;
}

// The root of an increasing function, by bisection.
template <class F>
Quad root_of(F f, Quad low, Quad high) {
  for (int k = 0; k < 130; ++k) {
    const Quad middle = (low + high) / Quad(2);
    (f(middle) > Quad(0) ? high : low) = middle;
  }
  return (low + high) / Quad(2);
}

Quad sinh_of(const Quad& x) { return (exp(x) - exp(-x)) / Quad(2); }
Quad cosh_of(const Quad& x) { return (exp(x) + exp(-x)) / Quad(2); }

// The state a time after the pericentre, on the first axis, of the orbit with mu and the pericentre distance
// q.
Orbit<Quad> ellipse(const Quad& mu, const Quad& q, const Quad& e, const Quad& time) {
  const Quad a = q / (Quad(1) - e), n = sqrt(mu / (a * a * a)), root = sqrt(Quad(1) - e * e);
  const Quad mean = n * time;
  const Quad anomaly = root_of([&](const Quad& x) { return x - e * sin(x) - mean; }, mean - e, mean + e);
  const Quad s = sin(anomaly), c = cos(anomaly), rate = n / (Quad(1) - e * c);
  return {a * (c - e), a * root * s, -(a * rate * s), a * root * rate * c};
}
Orbit<Quad> hyperbola(const Quad& mu, const Quad& q, const Quad& e, const Quad& time) {
  const Quad a = q / (e - Quad(1)), n = sqrt(mu / (a * a * a)), root = sqrt(e * e - Quad(1));
  const Quad mean = n * time;
  const Quad f = root_of([&](const Quad& x) { return e * sinh_of(x) - x - mean; }, Quad(-40), Quad(40));
  const Quad s = sinh_of(f), c = cosh_of(f), rate = n / (e * c - Quad(1));
  return {a * (e - c), a * root * s, -(a * rate * s), a * root * rate * c};
}
// With u the tangent of half the true anomaly, u + u^3/3 = sqrt(mu/(2 q^3)) t.
Orbit<Quad> parabola(const Quad& mu, const Quad& q, const Quad& time) {
  const Quad n = sqrt(mu / (Quad(2) * q * q * q)), w = n * time;
  const Quad u = root_of([&](const Quad& x) { return x + x * x * x / Quad(3) - w; }, Quad(-100), Quad(100));
  const Quad rate = n / (Quad(1) + u * u);
  return {q * (Quad(1) - u * u), Quad(2) * q * u, -(Quad(2) * q * u * rate), Quad(2) * q * rate};
}

template <class T>
Orbit<T> in(const Orbit<Quad>& z) {
  Orbit<T> result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = T(z[k]);
  return result;
}

// Tolerances: the golden states are roots by bisection to round-off of quad, 1e-34, and of the order of 30
// operations; the flow is as good as the phase, whose error the fast pericentre multiplies by up to 1/(1 -
// e)^2 for ellipses, 400 for e = 0.95, and the differentiated times do the same on the other orbits.
TEST(KeplerFlow, FollowsEllipses) {
  const Quad mu(1.7), q(0.8);
  for (const double e : {0.0, 0.05, 0.3, 0.7, 0.95})
    for (const double from : {-1.3, 0.0, 0.4, 2.9})
      for (const double h : {0.01, 0.3, -0.9, 1.7, -3.1, 5.0}) {
        Orbit<Quad> z = ellipse(mu, q, Quad(e), Quad(from));
        const Orbit<Quad> start = z, expected = ellipse(mu, q, Quad(e), Quad(from) + Quad(h));
        EXPECT_EQ(flow(mu, Quad(h), z), Status::converged);
        EXPECT_LT(relative(z, expected), 3e-31) << e << " " << from << " " << h;
        Orbit<double> rounded = in<double>(start);
        EXPECT_EQ(flow(1.7, h, rounded), Status::converged);
        EXPECT_LT(relative(in<Quad>({rounded[0], rounded[1], rounded[2], rounded[3]}), expected), 3e-13)
            << e << " " << from << " " << h;
      }
}

TEST(KeplerFlow, FollowsHyperbolas) {
  const Quad mu(1.7), q(0.8);
  for (const double e : {1.05, 1.5, 3.0})
    for (const double from : {-2.0, 0.0, 0.4})
      for (const double h : {0.01, -0.9, 1.7, 4.0, 40.0}) {
        Orbit<Quad> z = hyperbola(mu, q, Quad(e), Quad(from));
        const Orbit<Quad> expected = hyperbola(mu, q, Quad(e), Quad(from) + Quad(h));
        EXPECT_EQ(flow(mu, Quad(h), z), Status::converged);
        EXPECT_LT(relative(z, expected), 3e-31) << e << " " << from << " " << h;
      }
}

TEST(KeplerFlow, FollowsParabolas) {
  const Quad mu(1.7), q(0.8);
  for (const double from : {-2.0, 0.0, 0.4})
    for (const double h : {0.01, -0.9, 1.7, 4.0, 400.0}) {
      Orbit<Quad> z = parabola(mu, q, Quad(from));
      const Orbit<Quad> expected = parabola(mu, q, Quad(from) + Quad(h));
      EXPECT_EQ(flow(mu, Quad(h), z), Status::converged);
      EXPECT_LT(relative(z, expected), 3e-31) << from << " " << h;
    }
}

// Through the parabola the flow is smooth: with eccentricities 1 - d, 1 and 1 + d the second difference of
// the ends is of the order d^2, and nothing is lost to round-off. A formula that divides by beta would lose
// d.
TEST(KeplerFlow, LosesNothingNearParabolas) {
  const Quad mu(1), q(1);
  for (const double d : {1e-6, 1e-10, 1e-14}) {
    const auto end = [&](const Quad& offset) {
      // At the pericentre v^2 = mu (1 + e)/q.
      Orbit<Quad> z{q, Quad(0), Quad(0), sqrt(mu * (Quad(2) + offset) / q)};
      EXPECT_EQ(flow(mu, Quad(2.5), z), Status::converged);
      return z;
    };
    const Orbit<Quad> below = end(Quad(-d)), on = end(Quad(0)), above = end(Quad(d));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT(static_cast<double>(abs(below[k] + above[k] - Quad(2) * on[k])), 2 * d * d + 1e-32) << d;
      EXPECT_GT(static_cast<double>(abs(above[k] - below[k])), d / 20) << d;
    }
  }
}

TEST(KeplerFlow, TakesWholePeriodsOff) {
  const Quad mu(1.7), q(0.8), e(0.3), a = q / (Quad(1) - e), period = Quad(2) * pi * sqrt(a * a * a / mu);
  const Orbit<Quad> start = ellipse(mu, q, e, Quad(0.4));
  for (const int turns : {1, -3, 1000, 1000000}) {
    Orbit<Quad> z = start, direct = start;
    EXPECT_EQ(flow(mu, Quad(turns) * period + Quad(0.7), z), Status::converged);
    EXPECT_EQ(flow(mu, Quad(0.7), direct), Status::converged);
    // The period is known to round-off of quad, in each turn; e = 0.3 doubles it.
    EXPECT_LT(relative(z, direct), 1e-31 + 2e-33 * std::abs(turns)) << turns;
  }
}

// From random states and for random times in double, of which the flow must make an orbit of the same energy
// and angular momentum and come back by a flow of the opposite time.
TEST(KeplerFlow, KeepsEnergyAndComesBackFromAnywhere) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int k = 0; k < 5000; ++k) {
    Orbit<double> z{1 + number(random) / 2, number(random), number(random), number(random)};
    const double r0 = std::hypot(z[0], z[1]), h = std::pow(10, 1.5 * number(random)) * (k % 2 == 0 ? 1 : -1);
    const auto energy = [](const Orbit<double>& x) {
      return (x[2] * x[2] + x[3] * x[3]) / 2 - 1 / std::hypot(x[0], x[1]);
    };
    const auto momentum = [](const Orbit<double>& x) { return x[0] * x[3] - x[1] * x[2]; };
    if (std::abs(momentum(z)) < 0.2) continue;  // falls that are nearly straight magnify every error
    const double before = energy(z), turn = momentum(z);
    Orbit<double> end = z;
    ASSERT_EQ(flow(1.0, h, end), Status::converged);
    const double r = std::hypot(end[0], end[1]);
    EXPECT_LT(std::abs(energy(end) - before), 1e-14 * (std::abs(before) + 1 / r + 1 / r0)) << k;
    EXPECT_LT(std::abs(momentum(end) - turn), 1e-14 * (1 + r * std::hypot(end[2], end[3]))) << k;
    ASSERT_EQ(flow(1.0, -h, end), Status::converged);
    EXPECT_LT(relative(end, z), 1e-11) << k << " " << h;  // phases of up to ten periods, slow and fast parts
  }
}

// The same numbers, whichever way the motion goes: a flow backwards is one forwards with the velocity turned.
TEST(KeplerFlow, IsReversibleToTheLastBit) {
  Orbit<double> forwards{0.9, 0.3, -0.2, 0.8}, turned{0.9, 0.3, 0.2, -0.8};
  flow(1.0, 0.37, forwards);
  flow(1.0, -0.37, turned);
  EXPECT_EQ(forwards[0], turned[0]);
  EXPECT_EQ(forwards[1], turned[1]);
  EXPECT_EQ(forwards[2], -turned[2]);
  EXPECT_EQ(forwards[3], -turned[3]);
}

TEST(KeplerFlow, HasTheDerivativesOfItsOwnDifferences) {
  using D = Dual<Quad, 4>;
  const Orbit<Quad> start{Quad(0.9), Quad(0.3), Quad(-0.2), Quad(0.8)};
  for (const double h : {0.4, -2.0, 30.0}) {  // of the last, periods are taken off
    Orbit<D> z;
    for (std::size_t k = 0; k < 4; ++k) z[k] = D::variable(start[k], static_cast<int>(k));
    ASSERT_EQ(flow(D(1), D(Quad(h)), z), Status::converged);
    for (std::size_t j = 0; j < 4; ++j) {
      const Quad shift(1e-9);
      Orbit<Quad> above = start, below = start;
      above[j] += shift;
      below[j] -= shift;
      flow(Quad(1), Quad(h), above);
      flow(Quad(1), Quad(h), below);
      for (std::size_t k = 0; k < 4; ++k) {
        const Quad slope = (above[k] - below[k]) / (Quad(2) * shift);
        // Central differences: third derivatives, up to 1e6 after five periods, times 1e-18.
        EXPECT_LT(static_cast<double>(abs(z[k].derivative[j] - slope)), 1e-11) << h << " " << k << " " << j;
      }
    }
  }
}

// Many steps of a fiftieth of a period: the energy is off by a random walk of roundings of the changes,
// and not by more in proportion to the steps.
TEST(KeplerFlow, DoesNotDriveTheEnergy) {
  Orbit<double> z{0.7, 0, 0, std::sqrt(1.3 / 0.7)}, carry{};
  double largest = 0;
  for (int k = 0; k < 200000; ++k) {
    std::array<double, 4> change{};
    std::array<double, 2> bend{};
    ASSERT_EQ(kepler_change<double>(1, 0.1256, std::span<const double>(z.data(), 2),
                                    std::span<const double>(&z[2], 2), std::span<double>(change.data(), 2),
                                    std::span<double>(bend), std::span<double>(&change[2], 2)),
              Status::converged);
    for (std::size_t i = 0; i < 4; ++i) {
      const double corrected = change[i] + carry[i], sum = z[i] + corrected;
      carry[i] = corrected - (sum - z[i]);
      z[i] = sum;
    }
    largest = std::max(largest, std::abs((z[2] * z[2] + z[3] * z[3]) / 2 - 1 / std::hypot(z[0], z[1]) + 0.5));
  }
  // A step changes the velocity by an eighth of itself and more near the pericentre, and rounds 4e-17 of the
  // energy off: a random walk of 2e5 steps is 450 times as far, 2e-14, and three times that is allowed. All
  // of one sign they would be 9e-12.
  EXPECT_LT(largest, 6e-14);
}

TEST(KeplerFlow, HasAStatusWhereThereIsNoOrbit) {
  Orbit<double> nowhere{0, 0, 1, 0};
  EXPECT_EQ(flow(1.0, 0.1, nowhere), Status::non_finite);
  Orbit<double> endless{1, 0, std::numeric_limits<double>::infinity(), 0};
  EXPECT_EQ(flow(1.0, 0.1, endless), Status::non_finite);
  Orbit<double> wrong{1, 0, 0, 1};
  EXPECT_EQ(flow(1.0, std::numeric_limits<double>::quiet_NaN(), wrong), Status::non_finite);
  Orbit<double> forever{1, 0, 0, 1};
  EXPECT_EQ(flow(1.0, 1e300, forever), Status::not_converged);  // more periods than a double counts
  // Without attraction the motion is straight.
  Orbit<double> free{1, 2, 0.5, -0.25};
  EXPECT_EQ(flow(0.0, 4.0, free), Status::converged);
  EXPECT_NEAR(free[0], 3, 1e-14);
  EXPECT_NEAR(free[1], 1, 1e-14);
}

}  // namespace
