// Verlet loops as someone would write them for one system and nothing else, with the arithmetic of the
// systems' own formulas. Compensated loops carry along what each addition rounds off. Merged loops make one
// drift of the last half of a step and the first half of the next one, as a person would who needs no state
// in between; they are the limit of what any path can reach.
#include "cases.hpp"

#include <cmath>

namespace {
using namespace pfaff;
using namespace pfaff::micro;

struct Plain {
  static constexpr const char* method = "verlet-plain";
  double sum;
  void add(double increment) { sum += increment; }
};

struct Compensated {
  static constexpr const char* method = "verlet";
  double sum, carry = 0;
  void add(double increment) {
    const double corrected = increment + carry;
    const double total = sum + corrected;
    carry = corrected - (total - sum);
    sum = total;
  }
};

template <class Number>
void oscillator(std::array<double, 2>& z, double h, double omega) {
  Number q{z[0]}, p{z[1]};
  const double half = h / 2;
  for (std::int64_t k = 0; k < chunk; ++k) {
    q.add(half * p.sum);
    p.add(h * -(omega * (omega * q.sum)));
    q.add(half * p.sum);
  }
  z = {q.sum, p.sum};
}

template <class Number>
void pendulum(std::array<double, 2>& z, double h, double omega) {
  Number q{z[0]}, p{z[1]};
  const double half = h / 2;
  for (std::int64_t k = 0; k < chunk; ++k) {
    q.add(half * p.sum);
    p.add(h * -(omega * (omega * std::sin(q.sum))));
    q.add(half * p.sum);
  }
  z = {q.sum, p.sum};
}

template <class Number>
void kepler(std::array<double, 4>& z, double h) {
  Number x{z[0]}, y{z[1]}, u{z[2]}, v{z[3]};
  const double half = h / 2;
  for (std::int64_t k = 0; k < chunk; ++k) {
    x.add(half * u.sum);
    y.add(half * v.sum);
    const double square = x.sum * x.sum + y.sum * y.sum;
    const double scale = -1 / (square * std::sqrt(square));
    u.add(h * (scale * x.sum));
    v.add(h * (scale * y.sum));
    x.add(half * u.sum);
    y.add(half * v.sum);
  }
  z = {x.sum, y.sum, u.sum, v.sum};
}

// Steps of which neighbouring half drifts are merged, for a problem that drifts by (time, state) and kicks.
template <class State, class Drift, class Kick>
void merged(State& z, double h, Drift drift, Kick kick) {
  State local = z;
  drift(h / 2, local);
  for (std::int64_t k = 1; k < chunk; ++k) {
    kick(h, local);
    drift(h, local);
  }
  kick(h, local);
  drift(h / 2, local);
  z = local;
}

void add_merged_loops() {
  const char* method = "verlet-merged";
  const volatile double unknown = 1;
  const double omega = unknown;
  const auto drift = [](double h, std::array<double, 2>& z) { z[0] += h * z[1]; };
  add<HarmonicOscillator>(method, "by-hand", [=](auto& z, double h) {
    merged(z, h, drift, [=](double step, auto& s) { s[1] += step * -(omega * (omega * s[0])); });
  });
  add<Pendulum>(method, "by-hand", [=](auto& z, double h) {
    merged(z, h, drift, [=](double step, auto& s) { s[1] += step * -(omega * (omega * std::sin(s[0]))); });
  });
  add<Kepler>(method, "by-hand", [](auto& z, double h) {
    merged(
        z, h,
        [](double step, auto& s) {
          s[0] += step * s[2];
          s[1] += step * s[3];
        },
        [](double step, auto& s) {
          const double square = s[0] * s[0] + s[1] * s[1];
          const double scale = -1 / (square * std::sqrt(square));
          s[2] += step * (scale * s[0]);
          s[3] += step * (scale * s[1]);
        });
  });
}

template <class Number>
void add_loops() {
  const volatile double unknown = 1;
  const double omega = unknown;
  add<HarmonicOscillator>(Number::method, "by-hand",
                          [=](auto& z, double h) { oscillator<Number>(z, h, omega); });
  add<Pendulum>(Number::method, "by-hand", [=](auto& z, double h) { pendulum<Number>(z, h, omega); });
  add<Kepler>(Number::method, "by-hand", [](auto& z, double h) { kepler<Number>(z, h); });
}

[[maybe_unused]] const bool added = (add_loops<Plain>(), add_loops<Compensated>(), add_merged_loops(), true);
}  // namespace
