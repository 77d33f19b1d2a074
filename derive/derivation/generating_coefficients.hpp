// The Taylor coefficients of a generating function, symbolically.
//
// In Darboux coordinates y = (q, p) with the Hamiltonian H(y, t), the midpoint form w = (y' + y)/2 has the
// function phi(w, tau, t0) that makes y' = y + (-phi_p, phi_q) the exact motion from t0 to t0 + tau. It obeys
//
//   d_tau phi = -H(w + (-phi_p, phi_q)/2, t0 + tau),   phi = 0 at tau = 0,        (su-qin (66), in the chart)
//
// so that phi = sum_k tau^k phi^(k)(w, t0) with (k + 1) phi^(k+1) = -[tau^k] H along the sum up to k.
#pragma once

#include <pfaff/derive/derivation/derivation.hpp>

namespace pfaff {

/// True where the Hamiltonian in Darboux coordinates is known: canonical systems, and charts with theirs.
bool has_chart_hamiltonian(const Model& model);

/// Fills in the tape: the rates of the Darboux coordinates, then phi^(1), .., phi^(degree) at (w, t0) as
/// further outputs phi1, phi2, .. Coordinates that are not the system's own are named y1, y2, .. InputError
/// for a degree that is not in 1 .. largest_derived_degree.
void expand_generating_function(const Model& model, int degree, Equations& equations);

}  // namespace pfaff
