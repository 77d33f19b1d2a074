// The contact oscillator (mclachlan-perlmutter2006): an oscillator of unit mass with the constraint of the
// contact distribution, and what its relatives share.
//
//   V = (x^2 + y^2 + z^2 + epsilon x^2 z^2)/2,   A = (1, 0, y)
#pragma once

#include <array>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/random_numbers.hpp>

namespace pfaff {

struct ContactOscillator {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 1;
  Real epsilon = 0.3_r;
  int seed = 0;
  static std::vector<std::string> velocity_constraint_names() { return {"contact"}; }

  /// The velocity at the start, x' = -y z'. Positions and velocities are numbers between -1 and 1 drawn by
  /// the seed; those of seed 0 are fixed.
  template <class T>
  void start(Out<T> q, Out<T> v) const {
    std::array<Real, 5> numbers{1.2_r, 0.5_r, 0.4_r, 0.7_r, 0.2_r};
    RandomNumbers random(seed);
    if (seed != 0)
      for (Real& number : numbers) number = random.next();
    for (std::size_t k = 0; k < 3; ++k) q[k] = T(numbers[k]);
    v[1] = T(numbers[3]);
    v[2] = T(numbers[4]);
    v[0] = -(q[1] * v[2]);
  }
  /// V.
  template <class T>
  T spring_energy(In<T> q) const {
    const T x = q[0] * q[0], z = q[2] * q[2];
    return (x + q[1] * q[1] + z + epsilon * x * z) / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = T(1);
    rows[1] = T(0);
    rows[2] = q[1];
  }
};

}  // namespace pfaff
