// Random instances of registered systems, with parameters near their defaults and states near the initial
// one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <pfaff/core/system.hpp>

namespace pfaff::testing {

class Samples {
 public:
  explicit Samples(unsigned seed) : random_(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Quad quad(double low, double high) { return Quad(number(low, high)) + Quad(number(-1, 1)) * Quad(0x1p-60); }

  /// Real parameters between half and twice their defaults, as short decimals; choices and integers stay.
  Assignments parameters(const SystemPlugin& plugin) {
    const auto defaults = plugin.make({})->parameters();
    Assignments assignments;
    for (const Parameter& p : plugin.parameters()) {
      if (p.kind != Parameter::Kind::real) continue;
      const auto found =
          std::find_if(defaults.begin(), defaults.end(), [&](const auto& d) { return d.first == p.name; });
      const double usual = Real::parse(found->second)->value();
      const double value = std::clamp(usual * std::exp2(number(-1, 1)), p.minimum, p.maximum);
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", value);
      assignments.emplace_back(p.name, text);
    }
    return assignments;
  }

  /// A state within `spread` (1 + |z|) of the initial one.
  std::vector<Quad> state(const Model& model, double spread) {
    std::vector<Quad> z(static_cast<std::size_t>(model.dimension()));
    for (std::size_t k = 0; k < z.size(); ++k) {
      const Quad usual = k < model.initial().size() ? model.initial()[k].quad() : Quad(0);
      z[k] = usual + quad(-spread, spread) * (Quad(1) + abs(usual));
    }
    return z;
  }

  /// A state from which the exact solution is asked for: any, where the system has it everywhere.
  std::vector<Quad> start(const Model& model) {
    if (model.name() == "kepler") return kepler_ellipse(number(0, 0.9));
    if (model.name() == "pendulum") return {quad(-7, 7), quad(-3, 3)};
    return state(model, 1.5);
  }

  /// Position and velocity at a random point of an ellipse of eccentricity e, in any direction.
  std::vector<Quad> kepler_ellipse(double e) {
    const double a = number(0.5, 2), anomaly = number(-3, 3), turn = number(-3, 3), b = std::sqrt(1 - e * e);
    const double x = a * (std::cos(anomaly) - e), y = a * b * std::sin(anomaly);
    const double speed = std::sqrt(a) / (a * (1 - e * std::cos(anomaly)));
    const double u = -speed * std::sin(anomaly), v = speed * b * std::cos(anomaly);
    const double c = std::cos(turn), s = std::sin(turn);
    return {Quad(c * x - s * y), Quad(s * x + c * y), Quad(c * u - s * v), Quad(s * u + c * v)};
  }

 private:
  std::mt19937_64 random_;
};

inline std::string describe(const Assignments& assignments, const std::vector<Quad>& z) {
  std::string text;
  for (const auto& [name, value] : assignments) text += name + "=" + value + " ";
  for (const Quad x : z) text += to_string(x, 6) + " ";
  return text;
}

}  // namespace pfaff::testing
