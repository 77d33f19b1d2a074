// The chaotic quartic nonholonomic system of 2 n + 1 degrees of freedom (mclachlan-perlmutter2006), q = (x,
// y_1,
// ..., y_n, z_1, ..., z_n), and what its relatives share:
//
//   V = (|q|^2 + z_1^2 z_2^2 + sum_i y_i^2 z_i^2)/2
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/numbers/random_numbers.hpp>

namespace pfaff {

struct QuarticNonholonomic {
  static constexpr int velocity_constraint_count = 1;
  int n = 3, seed = 1;
  [[nodiscard]] int dimension() const { return 4 * n + 2; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(n); }
  [[nodiscard]] std::size_t degrees() const { return 2 * size() + 1; }
  static std::vector<std::string> velocity_constraint_names() { return {"contact"}; }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> list;
    for (const auto& [prefix, unit] : {std::pair("", "m"), std::pair("p_", "kg m/s")}) {
      list.push_back({std::string(prefix) + "x", unit});
      for (const char* name : {"y", "z"})
        for (int k = 1; k <= n; ++k) list.push_back({prefix + (name + std::to_string(k)), unit});
    }
    return list;
  }
  /// Numbers between -1 and 1 drawn by the seed for all positions and all velocities but x'.
  template <class T>
  void start(Out<T> q, Out<T> v) const {
    RandomNumbers random(seed);
    for (std::size_t k = 0; k < degrees(); ++k) q[k] = T(random.next());
    v[0] = T(0);
    for (std::size_t k = 1; k < degrees(); ++k) v[k] = T(random.next());
  }
  /// V.
  template <class T>
  T spring_energy(In<T> q) const {
    const In<T> y = q.subspan(1, size()), z = q.subspan(1 + size(), size());
    T sum = z[0] * z[0] * (z[1] * z[1]);
    for (std::size_t k = 0; k < degrees(); ++k) sum = sum + q[k] * q[k];
    for (std::size_t i = 0; i < size(); ++i) sum = sum + y[i] * y[i] * (z[i] * z[i]);
    return sum / 2;
  }
};

}  // namespace pfaff
