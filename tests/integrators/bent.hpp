// A Birkhoffian system without any simplification that could hide an error: K depends on z and t, the chart
// on both, and B is not the Hamiltonian in the chart.
//
//   y = (q, e^t p (1 + q^2) + t q^3),  F = y_2 dq + d(t q p),  B = y_2^2/2 - cos q + q sin t - q p
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::testing {

struct Bent {
  static constexpr int dimension = 2;
  template <class T>
  T momentum(const T& t, In<T> z) const {
    return exp(t) * z[1] * (1 + z[0] * z[0]) + t * z[0] * z[0] * z[0];
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    const T p = momentum(t, z);
    return p * p / 2 - cos(z[0]) + z[0] * sin(t) - z[0] * z[1];
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = momentum(t, z) + t * z[1];
    form[1] = t * z[0];
  }
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = momentum(t, z);
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = exp(-t) * (y[1] - t * y[0] * y[0] * y[0]) / (1 + y[0] * y[0]);
  }
};

inline std::shared_ptr<const Model> bent() {
  return make_model({.name = "bent", .title = "", .reference = "", .initial = {1, 0.5_r}}, Bent{});
}

}  // namespace pfaff::testing
