// Traps: series that a fit alone, or a rule that is a little off, would give a wrong class, some for every
// class. What they are is known because it was put in; where a series may honestly be called more than one
// thing, every such class is admitted.
#include <set>
#include <string>
#include <vector>

#include "drift_series.hpp"

namespace {
using namespace pfaff::testing::drift;
using pfaff::RoundOff;

constexpr double u = 0x1p-53;

struct Trap {
  const char* name;
  std::size_t samples;
  std::function<double(double)> error;  // at the scaled time s = k/samples
  std::set<std::string_view> classes;   // that are admitted
  RoundOff round_off = {};
};

/// A quantity of this range, of which nothing is known of its rounding.
RoundOff of_range(double range, double scale) { return {u, scale, 1, {}, range}; }

Drift drift_of(const Trap& trap) {
  DriftAccumulator drift;
  for (std::size_t k = 0; k < trap.samples; ++k)
    drift.add(double(k), trap.error(double(k) / double(trap.samples)));
  return drift.result(trap.round_off);
}

void expect_admitted(const std::vector<Trap>& traps) {
  for (const Trap& trap : traps) {
    const Drift drift = drift_of(trap);
    EXPECT_TRUE(trap.classes.contains(to_string(drift.drift_class)))
        << trap.name << ": " << to_string(drift.drift_class) << ": " << drift.evidence;
  }
}

double sine(double periods, double s) { return std::sin(2 * pi * periods * s); }

TEST(DriftTraps, OfExact) {
  expect_admitted({
      {"one error at the end", 500, [](double s) { return s > 0.997 ? 1e-9 : 0; }, {"undetermined"}},
      {"a shift after the first sample", 500, [](double s) { return s > 0 ? 1e-3 : 0; }, {"bounded"}},
  });
}

// RK4 loses energy each time that it leaves a hill, from whose top a run may last for less than one more.
TEST(DriftTraps, OfASeparatrix) {
  const auto rate = [](double q) { return q - q * q * q; };
  for (const int steps : {80, 150, 160}) {
    constexpr double h = 0.1;
    double q = std::sqrt(2.0), p = 0;
    DriftAccumulator drift;
    drift.add(0, 0);
    for (int n = 1; n <= steps; ++n) {
      const double a = p, b = rate(q), c = p + h / 2 * b, d = rate(q + h / 2 * a), e = p + h / 2 * d,
                   f = rate(q + h / 2 * c), g = p + h * f, k = rate(q + h * e);
      q += h / 6 * (a + 2 * c + 2 * e + g);
      p += h / 6 * (b + 2 * d + 2 * f + k);
      drift.add(h * n, p * p / 2 + q * q * q * q / 4 - q * q / 2);
    }
    const Drift found = drift.result({u, 2, steps, 2.0});
    EXPECT_EQ(found.drift_class, DriftClass::undetermined) << steps << " steps: " << found.evidence;
  }
}

// A rest energy of 1e6, whose roundings are 1.1e-10, beside a motion of size 1.
TEST(DriftTraps, OfRoundOff) {
  const RoundOff beside_rest{u, 1e6, 20000, 1.0}, alone{u, 1, 20000, 1.0}, unknown{u, 1, 20000};
  const auto evaluated = [](double e) { return (1e6 + e) - 1e6; };
  Noise noise{std::mt19937_64(31)};
  const auto rounding = [&](double) { return 1e-10 * std::round(noise()); };
  expect_admitted({
      {"a loss of 5e-8 beside 1e6",
       2000,
       [=](double s) { return -evaluated(5e-8 * s); },
       {"linear"},
       beside_rest},
      {"a loss of 4e-7 beside 1e6",
       2000,
       [=](double s) { return -evaluated(4e-7 * s); },
       {"linear"},
       beside_rest},
      {"a loss of 20 levels",
       2000,
       [=](double s) { return -evaluated(2.4e-9 * s); },
       {"linear"},
       beside_rest},
      {"an oscillation of 1e-7 beside 1e6",
       2000,
       [=](double s) { return evaluated(1e-7 * sine(90, s)); },
       {"bounded"},
       beside_rest},
      {"an oscillation of 24 levels",
       500,
       [=](double s) { return evaluated(1.4e-9 * sine(30, s)); },
       {"bounded"},
       beside_rest},
      {"a parabola beside 1e6",
       2000,
       [=](double s) { return evaluated(1e-7 * s * s); },
       {"polynomial"},
       beside_rest},
      {"roundings of the evaluation alone", 2000, rounding, {"round-off"}, beside_rest},
      {"the same without a rest energy", 2000, rounding, {"bounded"}, alone},
      {"a line within the allowance", 2000, [](double s) { return 8e-14 * s; }, {"round-off"}, alone},
      {"a line within the allowance where nothing is known",
       2000,
       [](double s) { return 8e-14 * s; },
       {"round-off"},
       unknown},
  });
}

TEST(DriftTraps, OfBiasedRoundOff) {
  const RoundOff alone{u, 1, 100000, 1.0}, small{u, 1, 100000, 1e-3};
  expect_admitted({
      {"half a unit a step", 5000, [](double s) { return 0.5e5 * u * s; }, {"biased-round-off"}, alone},
      {"a parabola of half a unit a step",
       5000,
       [](double s) { return 0.5e5 * u * s * s; },
       {"biased-round-off"},
       alone},
      {"three units a step", 5000, [](double s) { return 3e5 * u * s; }, {"linear"}, alone},
      {"half a unit a step of what hardly propagates",
       5000,
       [](double s) { return 0.5e5 * u * s; },
       {"linear"},
       small},
      {"an oscillation of that size",
       5000,
       [](double s) { return 0.5e5 * u * sine(120, s); },
       {"bounded"},
       alone},
  });
}

// What is lost levels off, which is the shape of what is bounded.
TEST(DriftTraps, OfBounded) {
  const std::set<std::string_view> lost{"linear", "polynomial", "exponential", "undetermined"};
  const auto decay = [](double rate) { return [=](double s) { return std::expm1(-rate * s); }; };
  const auto slowing = [](double rate) { return [=](double s) { return 1 / std::sqrt(1 + rate * s) - 1; }; };
  expect_admitted({
      {"lost within a tenth of the run", 3000, decay(30), lost, of_range(1, 1)},
      {"lost within a hundredth of a long run", 300000, decay(400), {"linear"}, of_range(1, 9)},
      {"lost after some thousand of a million", 1000000, decay(700), {"linear"}, of_range(1, 1)},
      {"lost within ten samples", 200000, decay(2e4), {"undetermined"}, of_range(1, 1)},
      {"a loss that slows down", 400000, slowing(1000), {"linear"}, of_range(1, 3)},
      {"from -.5 to -.02 beside terms of 4.5",
       20000,
       [](double s) { return 0.48 * -std::expm1(-9 * s); },
       {"linear"},
       of_range(0.5, 4.5)},
      {"the same beside an oscillation", 20000,
       [](double s) { return 0.48 * -std::expm1(-9 * s) + 0.02 * sine(900, s); }, lost, of_range(0.5, 4.5)},
      {"lost in one step", 2000, [](double s) { return s < 0.3 ? 0 : -1; }, {"undetermined"}, of_range(1, 1)},
      {"gained and kept", 2000, [](double s) { return -2 * std::expm1(-40 * s); }, lost, of_range(1, 1)},
      {"nine tenths come and go",
       2000,
       [](double s) { return -0.45 * (1 - std::cos(2 * pi * 80 * s)); },
       {"bounded"},
       of_range(1, 1)},
      {"ten times come and go",
       2000,
       [](double s) { return 5 * (1 - std::cos(2 * pi * 80 * s)); },
       {"bounded"},
       of_range(1, 1)},
      {"a shift by a tenth",
       2000,
       [](double s) { return 0.1 * std::expm1(-30 * s); },
       {"undetermined"},
       of_range(1, 1)},
      {"a shift by a tenth of the terms of a quantity that has none at the start",
       2000,
       [](double s) { return 0.1 * std::expm1(-30 * s); },
       {"undetermined"},
       of_range(0, 1)},
      {"a shift by a tenth beside an oscillation that goes on",
       2000,
       [](double s) { return 0.1 * std::expm1(-30 * s) + 0.01 * sine(200, s); },
       {"bounded"},
       of_range(1, 1)},
      {"a shift by a ten-thousandth",
       2000,
       [](double s) { return 1e-4 * std::expm1(-30 * s); },
       {"undetermined"},
       of_range(1, 1)},
      {"a shift by a ten-thousandth beside an oscillation of a hundredth of it",
       2000,
       [](double s) { return 1e-4 * std::expm1(-30 * s) + 1e-6 * sine(200, s); },
       {"bounded"},
       of_range(1, 1)},
      {"a loss once in a period of which less than one is seen",
       140,
       [](double s) { return -1e-5 * s * s * s / (s * s * s + 1e-3); },
       {"undetermined"},
       of_range(1, 1)},
      {"bursts of a hundredth at regular times",
       2000,
       [](double s) { return 0.01 * std::exp(-400 * (1 + std::cos(2 * pi * 4.5 * s))); },
       {"bounded"},
       of_range(1, 1)},
      {"a trend of half a per cent", 5000, [](double s) { return sine(200, s) + 0.005 * s; }, {"bounded"}},
      {"beats", 20000, [](double s) { return sine(900, s) * sine(0.75, s); }, {"bounded"}},
  });
}

TEST(DriftTraps, OfRandomWalk) {
  const auto correlated = autoregression(8, 2000, 1 - 30.0 / 2000), walk = autoregression(9, 2000, 1);
  expect_admitted({
      {"a correlation time of a thirtieth",
       2000,
       [&](double s) { return correlated[std::size_t(std::lround(2000 * s))]; },
       {"bounded"}},
      {"levels off under noise",
       600,
       [n = Noise{std::mt19937_64(2)}](double s) mutable { return -std::expm1(-25 * s) + 0.05 * n(); },
       {"bounded"}},
      {"a walk", 2000, [&](double s) { return walk[std::size_t(std::lround(2000 * s))]; }, {"random-walk"}},
      {"a walk on a slope",
       2000,
       [&](double s) { return walk[std::size_t(std::lround(2000 * s))] + 600 * s; },
       {"linear"}},
  });
}

TEST(DriftTraps, OfLinear) {
  std::vector<Trap> traps;
  for (const double period : {1.3, 1.2})  // of the length of the run
    for (int phase = 0; phase < 12; ++phase)
      for (const double periods : {12.3, 37.7})
        for (const double fast : {0.1, 1.0, 3.0})
          traps.push_back({"a slow sine under a fast one",
                           400,
                           [=](double s) {
                             return std::sin(2 * pi * s / period + 0.55 * phase) + fast * sine(periods, s);
                           },
                           {"undetermined"}});
  traps.push_back({"half a period", 500, [](double s) { return 1 - std::cos(pi * s); }, {"undetermined"}});
  traps.push_back({"a cliff", 500, [](double s) { return s < 0.6 ? 0 : 1; }, {"undetermined"}});
  traps.push_back({"saturates", 500, [](double s) { return std::sqrt(s); }, {"undetermined"}});
  expect_admitted(traps);
}

TEST(DriftTraps, OfPolynomial) {
  const auto grows = [](double rate) { return [=](double s) { return std::expm1(rate * s); }; };
  const std::set<std::string_view> trend{"linear", "polynomial"};
  std::vector<Trap> traps{
      {"e^(t/100) to t = 100", 1000, grows(1), trend},
      {"e^(.7 t/T)", 1000, grows(0.7), trend},
      {"e^(1.6 t/T)", 20000, grows(1.6), trend},
      {"e^(t/T) under an oscillation", 1000, [=](double s) { return grows(1)(s) + 0.05 * sine(101, s); },
       trend},
      {"an oscillation that grows as t^2",
       4000,
       [](double s) { return s * s * sine(301, s); },
       {"polynomial"}},
  };
  for (const double power : {1.4, 1.5, 2.0, 2.2, 3.0, 3.3, 4.0, 5.0})
    for (const std::size_t n : {200U, 1000U, 20000U})
      traps.push_back(
          {"a clean power", n, [=](double s) { return 3e-7 * std::pow(s, power); }, {"polynomial"}});
  expect_admitted(traps);
}

TEST(DriftTraps, OfExponential) {
  expect_admitted({
      {"a power of six", 1000, [](double s) { return std::pow(s, 6); }, {"polynomial", "undetermined"}},
      {"e^(3 t/T)", 1000, [](double s) { return std::expm1(3 * s); }, {"exponential"}},
      {"from a floor",
       2000,
       [n = Noise{std::mt19937_64(3)}](double s) mutable { return 1e-9 * n() + 1e-12 * std::exp(25 * s); },
       {"exponential"}},
      {"blows up",
       500,
       [](double s) { return 1e-3 * std::exp(std::exp(5.5 * s)); },
       {"exponential"},
       of_range(1, 1)},
      {"a thousand times the quantity and back",
       500,
       [](double s) { return 2000 * (1 - std::cos(2 * pi * 40 * s)); },
       {"bounded"},
       of_range(1, 1)},
  });
}

TEST(DriftTraps, OfUndetermined) {
  const auto last = [](double s) { return s > 0.5 ? std::numeric_limits<double>::quiet_NaN() : s; };
  expect_admitted({
      {"thirty-one samples of a line", 31, [](double s) { return s; }, {"undetermined"}},
      {"thirty-two samples of a line", 32, [](double s) { return s; }, {"linear"}},
      {"ends in what is no number", 500, last, {"undetermined"}},
      {"a line of a sixth of a slow oscillation",
       1000,
       [](double s) { return sine(4.75, s) + 0.3 * sine(6.2, s) + 0.2 * s; },
       {"undetermined"}},
      {"a jump of one sample at the end of an oscillation",
       1000,
       [](double s) { return (s > 0.998 ? 400 : 1) * (1 - std::cos(2 * pi * 30 * s)) + s / 100; },
       {"undetermined", "exponential"}},
  });
}

// An oscillation about one level of a quantity that it exceeds, with a phase, a number of periods and a
// second harmonic that are drawn: it loses nothing, since it comes back, and what its windows leave is no arc
// of a slow one. Runs of hardly three periods may be too short to tell.
TEST(DriftTraps, PureOscillationsAreBounded) {
  std::mt19937_64 random(7);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * double(random() >> 11) * 0x1p-53;
  };
  constexpr int count = 600;
  int other = 0;
  for (int k = 0; k < count; ++k) {
    const double samples = std::floor(100 * std::pow(20.0, uniform(0, 1)));
    const double periods = 3 * std::pow(samples / 12, uniform(0, 1)), phase = uniform(0, 2 * pi);
    const double second = uniform(0, 0.5);
    const auto value = [&](double s) {
      return std::cos(2 * pi * periods * s + phase) + second * std::cos(2 * (2 * pi * periods * s + phase));
    };
    const Drift drift = drift_of(
        {"", std::size_t(samples), [&](double s) { return value(s) - value(0); }, {}, of_range(1, 1)});
    other += drift.drift_class != DriftClass::bounded;
  }
  EXPECT_LE(other, count / 100);
}

}  // namespace
