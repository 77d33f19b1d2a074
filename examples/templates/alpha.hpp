// A transformation alpha of an author's own for K = m e^{c t/m} [[0, -1], [1, 0]]: w takes the new position
// and the old momentum. docs/generating-functions.md takes this code; check_lagrangian tests it.
#pragma once

#include <pfaff/integrators/generating/lagrangian_transformation.hpp>

namespace pfaff::examples {

struct NewPositionOldMomentum {
  Real mass = 2, damping = 0.3_r;
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T new_p = mass * exp(damping / mass * t) * new_z[1];
    const T old_p = mass * exp(damping / mass * t0) * old_z[1];
    w_hat[0] = new_p - old_p;
    w_hat[1] = old_z[0] - new_z[0];
    w[0] = new_z[0];
    w[1] = old_p;
  }
};

}  // namespace pfaff::examples
