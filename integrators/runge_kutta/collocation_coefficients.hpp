// The coefficients of implicit Runge-Kutta methods as the stages use them: divided by the weights, and
// rounded so that what makes a method symplectic holds exactly.
//
// With scaled rates L_j = h b_j X(stage_j) a step is
//   stage_i = z + sum_j mu_ij L_j,   z' = z + sum_j L_j,   mu_ij = a_ij / b_j,
// and with M_j = h^2 b_j f(stage_j), for q'' = f(q, t),
//   stage_i = q + c_i h q' + sum_j nu_ij M_j,   nu_ij = sum_k a_ik a_kj / b_j,
//   h q' becomes h q' + sum_j M_j,   q becomes q + h q' + sum_j beta_j M_j,   beta_j = sum_i b_i a_ij / b_j.
// Quadratic invariants and the symplectic structure are kept where mu_ij + mu_ji = 1, and in the second form
// where beta_j = 1 - c_j and nu_ij - nu_ji = c_i - c_j (hairer-lubich-wanner2006 IV.2). Numbers rounded one
// by one miss this by a unit of round-off, and a long run adds up what they miss. Here one triangle is
// rounded to multiples of a power of two, and the other follows by subtractions that are exact. Where a
// method is no more than nearly symplectic, its numbers are rounded one by one.
#pragma once

#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace pfaff {

/// x as a multiple of the spacing of numbers about `offset`, where x + offset lies between the same powers of
/// two as `offset`. Differences of such multiples are not rounded.
template <class Number>
Number on_grid(const Quad& x, const Number& offset) {
  return (Number(Real(x)) + offset) - offset;
}

template <class Number>
struct CollocationCoefficients {
  std::size_t stages;
  std::vector<Number> nodes;          // c
  std::vector<Number> scale;          // b_j, or 1 where b_j = 0
  std::vector<Number> counted;        // 1, or 0 where b_j = 0: what the update takes of L_j
  std::vector<Number> mu, nu, beta;   // matrices row-major
  std::vector<Number> extrapolation;  // of L to the step after, by the polynomial through the rates

  explicit CollocationCoefficients(const GaussCoefficients& tableau);
};
extern template struct CollocationCoefficients<double>;
extern template struct CollocationCoefficients<Quad>;

}  // namespace pfaff
