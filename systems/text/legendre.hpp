// The Legendre transformation of a Lagrangian L(q, v, t) that is quadratic in the velocities, on tapes:
//
//   L = v.M v/2 + b.v + L_0,   p = M v + b,   H = (p - b).M^-1 (p - b)/2 - L_0,
//
// with M(q, t) = L_vv, b(q, t) = L_v at v = 0 and L_0(q, t) = L at v = 0 (landau-lifshitz1976 section 40).
// Where M is constant and b is zero, H = T(p) + V(q, t) is separable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff::text {

/// H as one tape of (q, p), or, where it is separable, as tapes of p and of q; the others are null.
struct LegendreTransform {
  std::shared_ptr<const Tape> hamiltonian, kinetic, potential;
  std::string refused;  // why there is none; empty where there is one
};

/// Transforms a Lagrangian, a tape of (q, v) with one result. The rank of M is looked at in the positions q;
/// where it is not full, or L is not quadratic, `refused` says so and names the rank.
LegendreTransform legendre_transform(const Tape& lagrangian, const std::vector<Real>& q);

/// p = L_v(q, v) at the time zero, for a Lagrangian, a tape of (q, v); exact where the numbers stay
/// fractions.
std::vector<Real> momenta_of_lagrangian(const Tape& lagrangian, const std::vector<Real>& q,
                                        const std::vector<Real>& v);

}  // namespace pfaff::text
