// The kinetic energy, the weight and the constraints of beads on rods, in which masses, lengths and gravity
// are constants (Real) or numbers of the scalar, such as symbols.
#pragma once

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff {

/// sum_i |p_i|^2/(2 m_i), with 2 m_i = twice_mass(i).
template <class T, class Mass>
T rod_kinetic_energy(const BeadRodDescription& d, const Mass& twice_mass, In<T> p) {
  T sum(0);
  for (std::size_t i = 0, at = 0, axes = d.axes(); i < d.beads(); ++i) {
    T square(0);
    for (std::size_t x = 0; x < axes; ++x, ++at) square = square + p[at] * p[at];
    sum = sum + square / twice_mass(i);
  }
  return sum;
}

/// phi_k = (|D_k|^2 - l_k^2)/2, with l_k = length(k).
template <class T, class Length>
void rod_constraint_values(const BeadRodDescription& d, const Length& length, In<T> q, Out<T> phi) {
  for (std::size_t k = 0; k < d.rods.size(); ++k) {
    const Rod& rod = d.rods[k];
    T square(0);
    for (std::size_t x = 0; x < d.axes(); ++x) {
      const T along = q[rod.first * d.axes() + x] - (rod.second < d.beads() ? q[rod.second * d.axes() + x]
                                                                            : T(d.coordinate(rod.second, x)));
      square = square + along * along;
    }
    phi[k] = (square - length(k) * T(length(k))) / 2;
  }
}

}  // namespace pfaff
