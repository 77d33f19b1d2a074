// The drift estimator on series whose drift is known. Seeds are fixed; drift.hpp says how often it is right
// over many seeds.
#include <algorithm>
#include <complex>

#include "drift_series.hpp"

namespace {
using namespace pfaff::testing::drift;

/// Least squares with independent residuals: the textbook interval, wrong here. Unit step.
struct Naive {
  double slope, half_width, residual_rms;
};
Naive naive(const std::vector<double>& e) {
  const double n = double(e.size()), middle = (n - 1) / 2;
  double mean = 0, xx = 0, xy = 0, residual = 0;
  for (double value : e) mean += value / n;
  for (std::size_t k = 0; k < e.size(); ++k) {
    xx += (double(k) - middle) * (double(k) - middle);
    xy += (double(k) - middle) * (e[k] - mean);
  }
  for (std::size_t k = 0; k < e.size(); ++k)
    residual += std::pow(e[k] - mean - xy / xx * (double(k) - middle), 2);
  return {xy / xx, 1.96 * std::sqrt(residual / (n - 2) / xx), std::sqrt(residual / n)};
}

TEST(Drift, FastOscillationIsBounded) {
  for (double period : {7.3, 20.0, 20.3, 64.0, 400.0}) {
    const Drift drift = measure(20000, [=](double t) { return 1e-6 * (1 - std::cos(2 * pi * t / period)); });
    EXPECT_CLASS(drift, "bounded") << period;
    EXPECT_TRUE(covers(drift, 0)) << period;
    EXPECT_NEAR(drift.oscillation_amplitude, 1e-6, 3e-8);
    EXPECT_NEAR(drift.oscillation_rms, 1e-6 / std::sqrt(2.0), 1e-8);
    EXPECT_EQ(drift.exponent.value().value, 0.0);
  }
  for (double beats : {1.0, 1.5, 3.0, 10.0}) {
    const Drift drift =
        measure(20000, [=](double t) { return std::sin(t / 3) * std::sin(pi * beats * t / 20000); });
    EXPECT_CLASS(drift, "bounded") << beats;
  }
}

// The trend comes to 3 % of the oscillation: beside less than 1 % nobody would see it.
TEST(Drift, TrendUnderAThirtyfoldOscillation) {
  const double slope = -3.0 / 20000;
  int held = 0;
  for (double period : {17.77, 19.3, 20.0, 20.3, 30.1, 77.7})
    for (double phase : {0.0, 0.7, 1.4, 2.1, 2.8}) {
      const Drift drift =
          measure(20000, [=](double t) { return slope * t + 100 * std::sin(2 * pi * t / period + phase); });
      EXPECT_CLASS(drift, "linear") << period;
      EXPECT_NEAR(drift.slope, slope, 0.02 * std::abs(slope)) << period;
      EXPECT_NEAR(drift.oscillation_amplitude, 100, 2);  // samples miss the tops by up to 1.3 %
      held += covers(drift, slope);
    }
  EXPECT_GE(held, 27);  // of 30
}

TEST(Drift, RandomWalk) {
  int named = 0, near_half = 0, held = 0, naively_held = 0;
  double exponents = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<double> errors = autoregression(seed, 4000, 1);
    const Drift drift = measure(errors);
    held += covers(drift, 0);
    const Naive textbook = naive(errors);
    naively_held += std::abs(textbook.slope) < textbook.half_width;
    if (drift.drift_class != DriftClass::random_walk) continue;
    ++named;
    exponents += drift.exponent.value().value;
    near_half += std::abs(drift.exponent.value().value - 0.5) < 0.25;
  }
  EXPECT_GE(named, 170);  // 85 %
  EXPECT_NEAR(exponents / named, 0.5, 0.08);
  EXPECT_GE(near_half, 0.9 * named);
  EXPECT_GE(held, 168);         // 84 %
  EXPECT_LE(naively_held, 30);  // control: the textbook interval, 95 % by name
}

TEST(Drift, LineInWhiteNoise) {
  const double error = std::sqrt(12.0 / 3000) / 3000;  // standard error of the slope
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Drift drift = measure(autoregression(seed, 3000, 0, 20 * error));
    EXPECT_CLASS(drift, "linear") << seed;
    EXPECT_NEAR(drift.exponent.value().value, 1, 0.25) << seed;
    EXPECT_NEAR(drift.slope, 20 * error, 6 * error) << seed;
  }
  Noise noise{std::mt19937_64(0)};  // levelling off: no line, and a slope that may be zero is not called one
  EXPECT_CLASS(measure(3000, [&](double t) { return 1 - std::exp(-t / 3000) + 0.03 * noise(); }),
               "undetermined");
}

TEST(Drift, IntervalCoversTheSlopeUnderCorrelatedNoise) {
  for (double phi : {0.0, 0.9, 0.97}) {
    int held = 0, naively_held = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const std::vector<double> errors = autoregression(seed, 1000, phi, 1e-3);
      held += covers(measure(errors), 1e-3);
      const Naive textbook = naive(errors);
      naively_held += std::abs(textbook.slope - 1e-3) < textbook.half_width;
    }
    EXPECT_GE(held, 270) << phi;  // 90 %
    // Control: where the textbook is right, it agrees; where this test matters, it fails.
    EXPECT_EQ(naively_held >= 270, phi == 0) << phi << ": " << naively_held;
    EXPECT_EQ(naively_held <= 180, phi > 0) << phi << ": " << naively_held;
  }
}

TEST(Drift, ExponentialGrowth) {
  const double rate = std::log(1e12) / 5000;
  Noise noise{std::mt19937_64(1)};
  const std::vector<std::function<double(double)>> growths{
      [=](double t) { return 1e-12 * std::exp(rate * t); },
      [=](double t) { return 1e-12 * std::exp(rate * t) * std::cos(t / 3); },
      [&, rate](double t) { return 1e-12 * std::exp(rate * t) + 1e-9 * noise(); }};
  for (const auto& growth : growths) {
    const Drift drift = measure(5000, growth);
    EXPECT_CLASS(drift, "exponential");
    EXPECT_NEAR(drift.rate.value().value, rate, 0.05 * rate);
    EXPECT_FALSE(drift.exponent.has_value());
  }
  const Drift early = measure(5000, [](double t) { return std::expm1(3 * t / 5000); });
  EXPECT_CLASS(early, "exponential");
  EXPECT_NEAR(early.rate.value().value, 3.0 / 5000, 0.05 * 3.0 / 5000);
}

TEST(Drift, PolynomialGrowthReportsItsExponent) {
  Noise noise{std::mt19937_64(1)};
  for (double power : {1.5, 2.0}) {
    const Drift smooth = measure(5000, [=](double t) { return -1e-20 * std::pow(t, power); });
    EXPECT_CLASS(smooth, "polynomial") << power << smooth.evidence;
    EXPECT_NEAR(smooth.exponent.value().value, power, 0.04 * power);  // half a step of the grid
    const Drift noisy = measure(5000, [&](double t) { return std::pow(t / 5000, power) + 0.03 * noise(); });
    EXPECT_CLASS(noisy, "polynomial") << power;
    EXPECT_NEAR(noisy.exponent.value().value, power, 0.2);
  }
  const Drift growing_oscillation = measure(20000, [](double t) { return 1e-9 * t * std::cos(t / 3); });
  EXPECT_CLASS(growing_oscillation, "linear");
  EXPECT_NEAR(growing_oscillation.exponent.value().value, 1, 0.05);
  EXPECT_NEAR(growing_oscillation.slope, 0, 1e-12);
}

// Of Störmer/Verlet, and of RK4, which loses the same on every swing.

// Of Störmer/Verlet, and of RK4, which loses the same on every swing.
TEST(Drift, EnergyOfThePendulum) {
  constexpr double h = 0.1;
  using State = std::complex<double>;  // q + i p
  const auto energy = [](State z) { return z.imag() * z.imag() / 2 - std::cos(z.real()); };
  const auto field = [](State z) { return State(z.imag(), -std::sin(z.real())); };
  State verlet(1.2, 0.3), rk4 = verlet;
  DriftAccumulator of_verlet, of_rk4;
  const double start = energy(verlet);
  for (int k = 0; k < 50000; ++k) {
    of_verlet.add(k * h, energy(verlet) - start);
    of_rk4.add(k * h, energy(rk4) - start);
    const double middle = verlet.imag() - h / 2 * std::sin(verlet.real()), q = verlet.real() + h * middle;
    verlet = {q, middle - h / 2 * std::sin(q)};
    const State a = field(rk4), b = field(rk4 + h / 2 * a), c = field(rk4 + h / 2 * b),
                d = field(rk4 + h * c);
    rk4 += h / 6 * (a + 2.0 * b + 2.0 * c + d);
  }
  EXPECT_CLASS(of_verlet.result(), "bounded");
  EXPECT_CLASS(of_rk4.result(), "linear");
  EXPECT_LT(of_rk4.result().slope_high, 0);
}

TEST(Drift, ExactAndTooFew) {
  EXPECT_CLASS(measure(2, [](double) { return 0.0; }), "exact");
  for (std::size_t samples : {0u, 1u, 2u, 3u, 4u, 31u}) {
    const Drift drift = measure(samples, [](double t) { return 2 * t + 1; });
    EXPECT_CLASS(drift, "undetermined") << samples;
    EXPECT_FALSE(drift.non_finite_time.has_value());
    EXPECT_EQ(drift.samples, samples);
    EXPECT_NEAR(drift.slope, samples < 2 ? 0 : 2, 1e-13) << samples;
    EXPECT_TRUE(std::isinf(drift.slope_high)) << samples;
  }
  EXPECT_CLASS(measure(32, [](double t) { return 2 * t + 1; }), "linear");
  EXPECT_CLASS(measure(100, [](double) { return 1e-16; }), "bounded");
}

TEST(Drift, NonFiniteSamplesAreFlagged) {
  for (double bad : {std::nan(""), infinity, -infinity, 1e200}) {
    const Drift drift = measure(1000, [=](double t) { return t == 500 || t == 700 ? bad : t; });
    EXPECT_CLASS(drift, "undetermined");
    EXPECT_TRUE(drift.non_finite == 2 && drift.samples == 500);
    EXPECT_EQ(drift.non_finite_time, 500.0);
    EXPECT_EQ(drift.maximum, 499);
    EXPECT_NEAR(drift.slope, 1, 1e-12);
  }
  DriftAccumulator zeros;
  zeros.add(0, 0), zeros.add(std::nan(""), 0);
  EXPECT_CLASS(zeros.result(), "undetermined");
}

TEST(Drift, MergingBlocksLosesNothing) {
  std::vector<double> errors = autoregression(5, 100003, 0.9, 1e-4);
  double square = 0, largest = 0;
  for (double e : errors) square += e * e / double(errors.size()), largest = std::max(largest, std::abs(e));
  const Naive reference = naive(errors);
  for (std::size_t capacity : {1u, 64u, 1001u, 4096u}) {
    DriftAccumulator drift(capacity);
    for (std::size_t k = 0; k < errors.size(); ++k) drift.add(double(k), errors[k]);
    EXPECT_LE(drift.blocks().size(), std::max<std::size_t>(capacity + 1, 64));
    const Drift result = drift.result();
    EXPECT_NEAR(result.rms, std::sqrt(square), 1e-12 * result.rms);
    EXPECT_EQ(result.maximum, largest);
    EXPECT_EQ(result.final_value, errors.back());
    EXPECT_NEAR(result.oscillation_rms, reference.residual_rms, 1e-10);
    EXPECT_CLASS(result, "linear");
    EXPECT_TRUE(covers(result, 1e-4));
  }
}

TEST(Drift, UnitsAndDirectionOfTimeDoNotMatter) {
  std::vector<double> errors = autoregression(3, 2000, 0.5, 1e-2);
  const Drift plain = measure(errors);
  for (double& e : errors) e *= 0x1p-60;
  const Drift scaled = measure(errors, -0x1p10);
  EXPECT_EQ(plain.drift_class, scaled.drift_class);
  EXPECT_NEAR(scaled.slope * -0x1p70, plain.slope, 1e-12);
  EXPECT_NEAR(scaled.slope_low * -0x1p70, plain.slope_high, 1e-9);
  EXPECT_EQ(scaled.slope_low, measure(errors, -0x1p10).slope_low);  // deterministic
}

// No line of least squares through errors in a range is steeper than 3/2 of that over the time.
TEST(Drift, SlopesStayWithinTheErrors) {
  for (const int count : {100, 1000, 15000})
    for (const double leaves : {0.001, 0.01, 0.05, 0.2})
      for (const double swing : {0.0, 1e-3, 1e-2}) {
        DriftAccumulator errors;
        double smallest = 0, largest = 0;
        for (int k = 0; k <= count; ++k) {
          const double t = static_cast<double>(k) / count;
          const double e = -std::exp(-0.5 * t) * (1 - std::exp(-t / leaves)) + swing * std::sin(300 * t);
          errors.add(t, e);
          smallest = std::min(smallest, e), largest = std::max(largest, e);
        }
        const Drift drift = errors.result();
        EXPECT_LE(std::abs(drift.slope), 1.5 * (largest - smallest))
            << count << ' ' << leaves << ' ' << swing;
        EXPECT_LE(drift.slope_low, drift.slope);
        EXPECT_GE(drift.slope_high, drift.slope);
        EXPECT_LE(drift.oscillation_amplitude, 1.5 * (largest - smallest));
      }
}

}  // namespace
