// The alpha of (95) as an author writes it for the engine, which records and differentiates it.
#pragma once

#include <pfaff/core/facets/generating_map.hpp>

namespace pfaff::su_qin {

/// w^ = (R^, P^), w = (R, P), z = (r, p), nu = 3/10; w^ multiplied by `factor`.
struct PapersAlpha {
  int factor = 1;
  template <class T>
  void alpha(const T& t, const T& t_old, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const Real rate = Real::fraction(3, 10);
    const T e = exp(rate * t), e0 = exp(rate * t_old);
    w_hat[0] = factor * (e * new_z[1] - e0 * old_z[1]);
    w_hat[1] = factor * (new_z[0] - old_z[0]);
    w[0] = (new_z[0] + old_z[0]) / 2;
    w[1] = -(e * new_z[1] + e0 * old_z[1]) / 2;
  }
};

}  // namespace pfaff::su_qin
