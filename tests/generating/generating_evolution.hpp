// The evolution of a generating function in time, on tapes, for any transformation alpha: the theory behind
// generating_gradient.hpp written down literally. The schemes do not use it; it is what they are compared
// with.
//
// With w^ = alpha_1(z', z, t, t0), w = alpha_2(z', z, t, t0), w^ = phi_w(w, t, t0), N = phi_ww, alpha_* =
// [[A, B], [C, D]] and g = grad B + F_t (su-qin (59)-(61), with K^-1 g in place of the printed K^-1 D):
//
//   d/dt phi_w = a(phi_w, w, phi_ww, t, t0) = (A - N C) K^-1 g(z', t) + d_t alpha_1 - N d_t alpha_2.
//
// The scalar form says the same of phi, and shows a to be a gradient. With w^.dw = F(z', t).dz' - F(z, t0).dz
// + dS at fixed times:
//
//   d/dt phi = -[B(z', t) + w^.d_t alpha_2 - d_t S],
//
// for the chart's alpha -H(w - K_c^-1 phi_w/2, t) with the Hamiltonian H of the chart.
#pragma once

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// alpha and its inverse as tapes of time t: (z', z, t0) -> (w^, w) and back, n + n + 1 inputs, 2n outputs.
struct AlphaTapes {
  Tape forward, backward;
};

/// The standard alpha of a Darboux chart y: w^ = -K_c (y' - y), w = (y' + y)/2, K_c = [[0, -I], [I, 0]].
AlphaTapes chart_alpha(const Model& model);

/// a(X, w, Y, t, t0) of a Birkhoffian model: inputs (X, w, Y row-major, t0), 2n + n^2 + 1; n outputs; time t.
Tape evolution(const Model& model, const AlphaTapes& alpha);

/// The right side of the scalar form: inputs (X, w, t0), 2n + 1; one output; time t. `exact_part` is S:
/// inputs (z', z, t0), time t.
Tape scalar_evolution(const Model& model, const AlphaTapes& alpha, const Tape& exact_part);
/// The same for the chart's alpha from the Hamiltonian of the chart (n -> 1).
Tape scalar_evolution(const Tape& chart_hamiltonian);

}  // namespace pfaff
