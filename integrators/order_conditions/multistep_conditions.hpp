// Order conditions and stability of linear multistep methods
//
//   sum_j rho_j z_{n+j} = h sum_j sigma_j X(z_{n+j}, t_{n+j}),   j = 0, ..., k
//
// (hairer-norsett-wanner1993 III.2, III.3). The method is of order p where
//   sum_j rho_j = 0 and sum_j (j^q rho_j - q j^(q-1) sigma_j) = 0 for q = 1, ..., p,
// and its solutions stay bounded as h -> 0 (zero-stability) where the roots of rho lie in the unit disc and
// those on the circle are simple.
#pragma once

#include <string>
#include <vector>

#include <pfaff/integrators/order_conditions/order_condition.hpp>

namespace pfaff {

/// The generating polynomials, lowest degree first, of the same length.
struct MultistepPolynomials {
  std::vector<Quad> rho, sigma;
};

/// The conditions up to `order`, divided by k^q so that all are of the same size.
std::vector<OrderCondition> multistep_conditions(const MultistepPolynomials& method, int order);

/// The conditions up to `order` of a method for second order equations, sum_j rho_j q_{n+j} = h^2 sum_j
/// sigma_j a_{n+j} (hairer-norsett-wanner1993 III.10): sum_j (j^q rho_j - q (q-1) j^(q-2) sigma_j) = 0 for q
/// = 0, ..., order + 1, divided by k^q.
std::vector<OrderCondition> second_order_multistep_conditions(const MultistepPolynomials& method, int order);

/// rho(x) / (x - 1), where 1 is a root of rho.
std::vector<Quad> without_root_one(const std::vector<Quad>& rho);

/// A complex number in quad.
struct ComplexQuad {
  Quad real{0}, imaginary{0};
};

/// The roots of a polynomial, lowest coefficient first, by the iteration of Durand and Kerner. A root of
/// multiplicity m is found to about the m-th root of round-off.
std::vector<ComplexQuad> polynomial_roots(const std::vector<Quad>& coefficients);

/// Why the method is not zero-stable, naming the root; empty where it is. Roots within 1e-6 of each other
/// count as one multiple root.
std::string instability(const MultistepPolynomials& method);

}  // namespace pfaff
