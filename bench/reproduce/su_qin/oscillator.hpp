// The damped oscillator's alpha, (95) and (97), through the plug-in's chart: R^ = dy_p, P^ = dy_r, R = mean
// y_r, P = -mean y_p.
#pragma once

#include <pfaff/bench/reproduce/su_qin/rows.hpp>

namespace pfaff::su_qin {

/// (R^, P^, R, P) of a pair of states at t1 and t0.
inline Numbers alpha_of(const Model& model, const Numbers& hat, const Numbers& z) {
  const Numbers y1 = value(*model.tape(Formula::chart), t1, hat),
                y0 = value(*model.tape(Formula::chart), t0, z);
  return {y1[1] - y0[1], y1[0] - y0[0], (y1[0] + y0[0]) / Quad(2), -(y1[1] + y0[1]) / Quad(2)};
}
/// (r^, p^, r, p) of (R^, P^, R, P).
inline Numbers alpha_inverse(const Model& model, const Numbers& w) {
  const Quad two(2);
  const Numbers y1{w[2] + w[1] / two, -w[3] + w[0] / two}, y0{w[2] - w[1] / two, -w[3] - w[0] / two};
  return joined(value(*model.tape(Formula::chart_inverse), t1, y1),
                value(*model.tape(Formula::chart_inverse), t0, y0));
}

}  // namespace pfaff::su_qin
