// Nguyen & Turski, section 4 as printed: energies, (4.5) and the numbers of its text.
#pragma once

#include <cmath>

#include <pfaff/papers/printed/rods.hpp>

namespace pfaff::printed {

/// a q_i q_j / r + epsilon [(sigma/r)^12 - (sigma/r)^6], corrected.
struct PairEnergy {
  std::vector<Quad> charges;
  Quad strength, epsilon, sigma;  // a, epsilon, sigma
};

/// (4.3) of a chain, without an external field; `sign` is -1 for the signs of (sigma/r)^6 and (sigma/r)^12
/// as printed and 1 for the corrected ones.
inline Quad chain_energy(const Rods& rods, const PairEnergy& potential, int sign) {
  const std::size_t d = rods.dimension;
  Quad energy = dot(rods.p, rods.velocity()) / 2;
  for (std::size_t i = 0; i < rods.beads(); ++i)
    for (std::size_t j = i + 2; j < rods.beads(); ++j) {
      Quad square(0);
      for (std::size_t x = 0; x < d; ++x) {
        const Quad along = rods.q[i * d + x] - rods.q[j * d + x];
        square += along * along;
      }
      const Quad ratio = potential.sigma * potential.sigma / square, sixth = ratio * ratio * ratio;
      energy += potential.strength * potential.charges[i] * potential.charges[j] / sqrt(square) +
                potential.epsilon * Quad(sign) * (sixth * sixth - sixth);
    }
  return energy;
}
/// The Hamiltonian of appendix B.1.
inline Quad pendulum_energy(const Rods& rods) {
  Quad energy = dot(rods.p, rods.velocity()) / 2;
  for (std::size_t i = 0; i < rods.beads(); ++i)
    energy += rods.gravity * rods.masses[i] * rods.q[i * rods.dimension + rods.dimension - 1];
  return energy;
}

/// (4.5): c on the diagonal and b cos(alpha_i) beside it.
inline Table<Quad> equal_beads(const Quad& c, const Quad& b, const std::vector<Quad>& cosines) {
  Table<Quad> m = zero_table<Quad>(cosines.size() + 1, cosines.size() + 1);
  for (std::size_t i = 0; i < m.size(); ++i) {
    m[i][i] = c;
    if (i < cosines.size()) m[i][i + 1] = m[i + 1][i] = b * cosines[i];
  }
  return m;
}

/// The components that the text before table 1 gives to the beads 1 to `count` in d dimensions, and those
/// that it should, one after the other; all count from 1.
struct FrictionIndices {
  std::vector<std::size_t> bead, as_printed, corrected;
};
inline FrictionIndices friction_indices(std::size_t count, std::size_t d) {
  FrictionIndices indices;
  for (std::size_t i = 1; i <= count; ++i)
    for (std::size_t x = 1; x <= d; ++x) {
      indices.bead.push_back(i);
      indices.as_printed.push_back(i * (d - 1) + x);
      indices.corrected.push_back(d * (i - 1) + x);
    }
  return indices;
}

/// The fits of the discussion, in seconds, for K constraints.
inline double fitted_inversion(int k) { return 0.028 * std::exp(0.49 * k); }
inline double fitted_recursion(int k) { return 0.00046 * std::exp(1.06 * k); }

}  // namespace pfaff::printed
