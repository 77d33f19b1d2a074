// Round-off without bias: the energy of Kepler ellipses by Gauss collocation of high order does a random
// walk, once truncation is out of sight. An ensemble of starts tells a mean from the spread.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace {
using namespace pfaff;
using State4 = std::vector<double>;

constexpr int starts = 16, revolutions = 512;

Quad energy(const State4& z) {
  const Quad a(z[0]), b(z[1]), c(z[2]), d(z[3]);
  return (c * c + d * d) / Quad(2) - Quad(1) / sqrt(a * a + b * b);
}

struct Ensemble {
  double rms = 0,
         early_rms = 0;     // of the relative error of the energy at the end and at an eighth of the time
  double significance = 0;  // the mean in units of its standard deviation
};

// Ellipses of major axis 2 and eccentricities about 0.6, in all directions. They start at the apocentre and
// are looked at there, where what is left of truncation is smallest. advance(start) makes a function that
// takes z over so many steps.
template <class Advance>
Ensemble ensemble(double step, unsigned seed, const Advance& advance) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> eccentricity(0.55, 0.65), direction(0, 2 * std::numbers::pi);
  std::vector<double> errors;
  double early = 0;
  for (int k = 0; k < starts; ++k) {
    const double e = eccentricity(random), angle = direction(random);
    const double q = 1 + e, p = std::sqrt((1 - e) / (1 + e));
    State4 z{q * std::cos(angle), q * std::sin(angle), -p * std::sin(angle), p * std::cos(angle)};
    const Quad start = energy(z);
    const auto relative_error = [&] { return static_cast<double>((energy(z) - start) / abs(start)); };
    auto run = advance();
    const auto steps = [&](int count) { return std::llround(count * 2 * std::numbers::pi / step); };
    run(z, 0, steps(revolutions / 8));
    early += relative_error() * relative_error() / starts;
    run(z, steps(revolutions / 8), steps(revolutions));
    errors.push_back(relative_error());
  }
  double mean = 0, square = 0;
  for (const double x : errors) {
    mean += x / starts;
    square += x * x / starts;
  }
  const double deviation = std::sqrt((square - mean * mean) * starts / (starts - 1.0));
  return {std::sqrt(square), std::sqrt(early), mean / (deviation / std::sqrt(double(starts)))};
}

Ensemble of_method(const std::string& name, const Assignments& parameters, double step, unsigned seed) {
  const auto model = systems().get("kepler", "").make({});
  const auto method = integrators().get(name, "").make(parameters);
  return ensemble(step, seed, [&] {
    return [stepper = std::shared_ptr<Stepper<double>>(method->stepper(model, 0.0)), step](
               State4& z, std::int64_t from, std::int64_t to) {
      std::int64_t completed = 0;
      EXPECT_EQ(stepper->advance(0.0, from, step, to - from, z, completed), Status::converged);
    };
  });
}

// A bias of the size that the control has is ten times what is allowed here; the spread is that of 1e4
// periods, 1.4e-14, scaled by the square root of the time, and a half more. The exponent of growth is told by
// the ratio over a factor of 8 in time: 2.8 for a random walk, 8 for a trend.
void expect_random_walk(const Ensemble& e, const std::string& what) {
  EXPECT_LE(std::abs(e.significance), 3) << what;
  EXPECT_LE(e.rms, 5e-15) << what;
  EXPECT_LE(e.rms, 5.5 * e.early_rms) << what;
}

TEST(RoundOff, OfGaussIsARandomWalk) {
  expect_random_walk(of_method("gauss", {{"stages", "8"}}, 0.1, 1), "8 stages");
  expect_random_walk(of_method("gauss", {{"stages", "6"}}, 0.05, 2), "6 stages");
  expect_random_walk(of_method("gauss-darboux", {{"stages", "8"}}, 0.1, 3), "8 stages, first order");
}

TEST(RoundOff, WithoutCompensationIsLarger) {
  EXPECT_GT(of_method("gauss", {{"stages", "8"}, {"compensated", "no"}}, 0.1, 1).rms, 1e-14);
}

// The control: the same collocation as it is usually written. Its coefficients a and b are rounded one by
// one, the iteration ends when the next correction would be lost, and the update takes the rates from before
// the last correction, added with compensation.
TEST(RoundOff, OfTheUsualIterationIsATrend) {
  const GaussCoefficients g = gauss_coefficients(8);
  static constexpr std::size_t s = 8;
  static constexpr double h = 0.1;
  std::vector<double> a, b;
  for (const Quad& x : g.matrix) a.push_back(static_cast<double>(x));
  for (const Quad& x : g.weights) b.push_back(static_cast<double>(x));
  const Ensemble usual = ensemble(h, 1, [&] {
    return [&a, &b, carry = State4(4), rate = std::vector<double>(4 * s), stage = std::vector<double>(4 * s)](
               State4& z, std::int64_t from, std::int64_t to) mutable {
      for (std::int64_t n = from; n < to; ++n) {
        double change = 1;
        for (int iteration = 0; iteration < 60 && change > 1e-15; ++iteration) {
          for (std::size_t i = 0; i < s; ++i) {
            const double x = z[0] + stage[4 * i], y = z[1] + stage[4 * i + 1], square = x * x + y * y;
            const double weight = -1 / (square * std::sqrt(square));
            rate[4 * i] = z[2] + stage[4 * i + 2];
            rate[4 * i + 1] = z[3] + stage[4 * i + 3];
            rate[4 * i + 2] = weight * x;
            rate[4 * i + 3] = weight * y;
          }
          change = 0;
          for (std::size_t i = 0; i < s; ++i)
            for (std::size_t k = 0; k < 4; ++k) {
              double sum = 0;
              for (std::size_t j = 0; j < s; ++j) sum += a[i * s + j] * rate[4 * j + k];
              change = std::max(change, std::abs(h * sum - stage[4 * i + k]));
              stage[4 * i + k] = h * sum;
            }
        }
        for (std::size_t k = 0; k < 4; ++k) {
          double sum = 0;
          for (std::size_t j = 0; j < s; ++j) sum += b[j] * rate[4 * j + k];
          add_to(z[k], carry[k], h * sum, true);
        }
      }
    };
  });
  EXPECT_GT(std::abs(usual.significance), 6);
  EXPECT_GT(usual.rms, 5.5 * usual.early_rms);
  EXPECT_GT(usual.rms, 1e-14);
}

}  // namespace
