// What systems with constraints in tests are made of: a particle of mass one in a plane, which falls.
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::testing {

/// q = (x, y), H = |p|^2/2 + y.
struct FallingParticle {
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[1];
  }
};

}  // namespace pfaff::testing
