// The inverse problem of Birkhoffian mechanics: an action form F.dz - B dt for equations K zdot + D = 0.
#pragma once

#include <span>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// An action form F.dz - B dt.
struct ActionForm {
  Tape one_form;     // F: n -> n
  Tape birkhoffian;  // B: n -> 1
};

/// F and B with dF = K and grad B + F_t = -D, on a region that is star-shaped about `centre` z*: with x = z -
/// z*
///
///   F_i(z, t) = int_0^1 s x_j K_ji(z* + s x, t) ds       (su-qin (17), whose printed factor 1/2 in place of
///                                                          the integral holds for K independent of z only)
///   B(z, t) = -int_0^1 x_i D_i(z* + s x, t) ds           (su-qin (18) with its sign corrected; the term
///                                                          with F_t vanishes because K is skew)
///
/// `structure`: n -> n x n, row-major, and `covector` D: n -> n must be self-adjoint (su-qin (8)), else F and
/// B do not reproduce them. F.x and B vanish at the centre, which fixes the gauge; the path from z* to z must
/// avoid singularities of K and D. The integrals are Gauss-Legendre sums of `nodes` >= 1 terms, recorded:
/// exact for integrands that are polynomials in s of degree 2 nodes - 1, and for analytic ones with an error
/// that falls geometrically with `nodes`. Comparing two numbers of nodes measures it.
ActionForm inverse_problem(const Tape& structure, const Tape& covector, std::span<const Real> centre,
                           int nodes = 24);

}  // namespace pfaff
