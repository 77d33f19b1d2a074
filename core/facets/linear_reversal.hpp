// Which reversals a method carries over to its steps.
//
// A step that is symmetric and made of H, A and b alone is reversible under every reversal rho of the system
// that is linear, (q, p) -> (R q, -R^-T p): discrete Lagrangians at the middle, discrete gradients (where R
// is orthogonal, as reversals are that are their own inverse and keep kinetic energies) and Runge-Kutta
// methods commute with linear maps. A reversal that bends the phase space reverses the motion, but not its
// steps.
#pragma once

#include <random>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// True where the system states a reversal that is linear. `of_momenta_alone` asks that it leaves the
/// positions where they are, too.
inline bool linear_reversal(const Model& model, bool of_momenta_alone = false) {
  if (!model.given(Formula::reversal)) return false;
  Replay<Quad> reversal(model.tape(Formula::reversal));
  const auto n = static_cast<std::size_t>(model.dimension());
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Quad> a(n), b(n), sum(n), of_a(n), of_b(n), of_sum(n);
  for (std::size_t k = 0; k < n; ++k) {
    a[k] = Quad(number(random));
    b[k] = Quad(number(random));
    sum[k] = a[k] + Quad(2) * b[k];
  }
  reversal(Quad(0), a.data(), of_a.data());
  reversal(Quad(0), b.data(), of_b.data());
  reversal(Quad(0), sum.data(), of_sum.data());
  for (std::size_t k = 0; k < n; ++k) {
    const Quad round_off(1e-30);  // of sums of numbers of order one
    if (!(abs(of_sum[k] - (of_a[k] + Quad(2) * of_b[k])) <= round_off)) return false;
    if (of_momenta_alone && k < n / 2 && of_a[k] != a[k]) return false;
  }
  return true;
}

}  // namespace pfaff
