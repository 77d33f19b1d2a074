#include "synthetic_series.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace pfaff::testing {

namespace {

constexpr double pi = std::numbers::pi;

/// Random numbers that are the same with every standard library: only the generator of the library is used.
struct Random {
  std::mt19937_64 generator;
  double uniform(double low, double high) {
    return low + (high - low) * double(generator() >> 11) / 9007199254740992.0;
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  double normal() {  // by the method of Box and Muller
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(uniform(0, 2 * pi));
  }
  double sign() { return generator() % 2 == 0 ? 1 : -1; }
};

using Function = std::function<double(double)>;

/// A sum of sines of least ... most periods, scaled to amplitude 1.
Function oscillation(Random& random, double least, double most) {
  struct Sine {
    double weight, periods, phase;
  };
  std::vector<Sine> sines(std::size_t(random.uniform(1, 6)));
  double sum = 0;
  for (Sine& sine : sines) {
    sine = {random.uniform(0.1, 1), random.log_uniform(least, most), random.uniform(0, 2 * pi)};
    sum += sine.weight;
  }
  return [sines, sum](double s) {
    double value = 0;
    for (const Sine& sine : sines)
      value += sine.weight / sum * std::sin(2 * pi * sine.periods * s + sine.phase);
    return value;
  };
}

}  // namespace

SyntheticSeries make_series(std::size_t kind, std::uint64_t seed, std::size_t fewest, std::size_t most) {
  Random random{std::mt19937_64(seed * 1000003 + kind)};
  for (int k = 0; k < 8; ++k) (void)random.generator();
  const auto n = std::size_t(random.log_uniform(double(fewest), double(most)));
  const double length = double(n), sign = random.sign();
  const double size = random.log_uniform(1e-9, 1e3), noise = random.uniform(0, 0.3);
  SyntheticSeries series;
  // Trend + amplitude (oscillation + noise), from 0 at the start. Without an oscillation the trend is one.
  const auto fill = [&](const Function& trend, double amplitude, const Function& swing) {
    double first = 0, square = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double s = double(k) / length, value = swing ? swing(s) : trend(s);
      square += value * value / length;
    }
    const double spread = noise * std::sqrt(square);
    for (std::size_t k = 0; k < n; ++k) {
      const double s = double(k) / length;
      const double e = sign * trend(s) + amplitude * ((swing ? swing(s) : 0) + spread * random.normal());
      if (k == 0) first = e;
      series.times.push_back(double(k));
      series.errors.push_back(size * (e - first));
    }
  };
  const Function none = [](double) { return 0.0; };
  const auto fast = [&] { return oscillation(random, 10, length / 4); };
  const auto slow = [&] { return oscillation(random, 3, 15); };
  const auto walk = [&](double correlation, const std::function<double()>& step) {
    double x = 0;
    for (std::size_t k = 0; k < n; ++k) {
      series.times.push_back(double(k));
      series.errors.push_back(x);
      x = correlation * x + step();
    }
    series.slope = 0;
  };
  switch (kind) {
    case 0:
      fill(none, 1, fast());
      series.slope = 0;
      break;
    case 1:
      fill(none, 1, slow());
      series.slope = 0;
      break;
    case 2: {
      const double time = random.log_uniform(1, length / 30);
      walk(std::exp(-1 / time), [&] { return size * random.normal(); });
      break;
    }
    case 3: {
      const double tau = random.log_uniform(0.01, 0.1), a = random.log_uniform(0.01, 1);
      fill([tau](double s) { return 1 - std::exp(-s / tau); }, a, fast());
      break;
    }
    case 4:
      walk(1, [&] { return size * random.normal(); });
      break;
    case 5: {
      const double a = random.log_uniform(0.01, 5);
      fill([](double s) { return s; }, a, fast());
      series.slope = sign * size / length;
      series.exponent = 1;
      break;
    }
    case 6: {
      const double a = random.log_uniform(0.01, 0.3);
      fill([](double s) { return s; }, a, slow());
      series.slope = sign * size / length;
      series.exponent = 1;
      break;
    }
    case 7: {
      const double periods = random.log_uniform(20, length / 4), phase = random.uniform(0, 2 * pi);
      fill([=](double s) { return s * std::cos(2 * pi * periods * s + phase); }, 1, {});
      series.slope = 0;
      series.exponent = 1;
      break;
    }
    case 8: {
      const double p = random.uniform(1.4, 4), a = random.log_uniform(0.003, 0.3);
      fill([p](double s) { return std::pow(s, p); }, a, fast());
      series.exponent = p;
      break;
    }
    case 9: {
      const double rate = random.uniform(4, 25), a = random.log_uniform(1e-6, 1e-3);
      const double b = random.log_uniform(0.01, 0.2);
      const Function beside = fast();
      fill([&](double s) { return std::exp(rate * (s - 1)) * (1 + b * beside(s)); }, a, fast());
      series.rate = rate / length;
      break;
    }
    case 10: {
      const double most_units = random.uniform(0.5, 3);
      series.unit = 0x1p-53;
      series.scale = size;
      walk(1, [&] { return series.unit * size * random.uniform(-most_units, most_units); });
      break;
    }
    case 12: {
      const double periods = random.uniform(0.6, 1.2), phase = random.uniform(0, 2 * pi);
      const double a = random.log_uniform(0.1, 1);
      fill([=](double s) { return std::sin(2 * pi * periods * s + phase); }, a, fast());
      break;
    }
    case 13:
    case 14: {
      const double periods = random.log_uniform(10, length / 4);
      const double beat = kind == 13 ? random.log_uniform(2, 8) : random.log_uniform(0.3, 2);
      const double r = random.uniform(0.1, 1), c = random.sign() * random.log_uniform(0.05, 2);
      const double phase = random.uniform(0, 2 * pi), other = random.uniform(0, 2 * pi);
      fill(none, 1, [=](double s) {
        const double x =
            std::sin(2 * pi * periods * s + phase) + r * std::sin(2 * pi * (periods + beat) * s + other);
        return x + c * x * x;
      });
      series.slope = 0;
      break;
    }
    default: {
      const double periods = random.uniform(0.15, 1.2), phase = random.uniform(0, 2 * pi);
      fill([=](double s) { return std::sin(2 * pi * periods * s + phase); }, 1, {});
      series.slope = 0;
      break;
    }
  }
  return series;
}

}  // namespace pfaff::testing
