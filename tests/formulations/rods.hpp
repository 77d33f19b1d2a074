// A hanging chain of rods in the plane, written as an author would write it. It is the pendulum of the golden
// file, in Cartesian coordinates, bob by bob, the second coordinate pointing up.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

#include "../golden_numbers.hpp"

namespace pfaff::testing {

struct Rods {
  std::vector<Real> masses, lengths, drag;
  Real gravity = 9.81_r;
  [[nodiscard]] int dimension() const { return static_cast<int>(4 * masses.size()); }
  [[nodiscard]] int constraint_count() const { return static_cast<int>(masses.size()); }

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (std::size_t k = 0; k < masses.size(); ++k)
      sum = sum + (p[2 * k] * p[2 * k] + p[2 * k + 1] * p[2 * k + 1]) / (2 * masses[k]);
    return sum;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    T sum(0);
    for (std::size_t k = 0; k < masses.size(); ++k) sum = sum + masses[k] * (gravity * q[2 * k + 1]);
    return sum;
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const T x = k == 0 ? q[0] : q[2 * k - 2] - q[2 * k], y = k == 0 ? q[1] : q[2 * k - 1] - q[2 * k + 1];
      phi[k] = (x * x + y * y - lengths[k] * lengths[k]) / 2;
    }
  }
  template <class T>
  void friction(const T& /*t*/, In<T> /*z*/, Out<T> lambda) const {
    for (std::size_t k = 0; k < drag.size(); ++k) lambda[2 * k] = lambda[2 * k + 1] = T(drag[k]);
  }
};

inline nlohmann::json golden_pendulum() { return golden("pendulum4_2d"); }
inline Rods golden_rods() {
  const nlohmann::json file = golden_pendulum();
  return {reals_of(file["masses"]), reals_of(file["lengths"]), reals_of(file["Lambda"]), real_of(file["g"])};
}
inline std::shared_ptr<const Model> model_of(const Rods& rods) {
  return make_model(SystemDescriptor{.name = "rods", .title = "", .reference = ""}, rods);
}

/// Some hundred roundings of numbers of order one.
template <class T>
inline constexpr double bound = std::is_same_v<T, double> ? 1e-14 : 1e-31;

/// The motion of a model in a formulation.
inline std::shared_ptr<const Model> motion(const std::shared_ptr<const Model>& model, const char* formulation,
                                           const Assignments& set = {}) {
  return formulations().get(formulation, "formulation").apply(model, set);
}

}  // namespace pfaff::testing
