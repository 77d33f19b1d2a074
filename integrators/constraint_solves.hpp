// What methods on the constraint surface have in common: the momenta without their normal part, and whether a
// kinetic energy is quadratic.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/largest.hpp>

namespace pfaff {

/// True where H_p at (t, q) is linear in p, to round-off and over scales from 1 to a million: one solve then
/// satisfies the hidden constraints.
template <class T>
bool velocity_is_linear(HolonomicConstraints<T>& constraints, const T& t, In<T> q) {
  const std::size_t n = constraints.degrees();
  std::vector<T> p(n), sum(n), v(n);
  for (const double scale : {1.0, 1024.0, 1048576.0}) {
    Largest<Value<T>> largest, difference;
    // v(a) + v(b) - v(a + b) - v(0)
    for (const int part : {0, 1, 2, 3}) {
      for (std::size_t k = 0; k < n; ++k) {
        const double a = scale * (1 + static_cast<double>(k % 7) / 8),
                     b = scale * (static_cast<double>(k % 5) / 4 - 0.5);
        p[k] = T((part == 0 || part == 2 ? a : 0) + (part == 1 || part == 2 ? b : 0));
      }
      constraints.velocity(t, q, p, v);
      for (std::size_t k = 0; k < n; ++k) {
        sum[k] = part < 2 ? sum[k] + v[k] : sum[k] - v[k];
        largest.add(value_of(v[k]));
      }
    }
    for (const T& x : sum) difference.add(value_of(x));
    if (!(difference.get() <= Value<T>(64) * unit_roundoff<T>() * largest.get())) return false;
  }
  return true;
}

/// The buffers of momentum projections.
template <class T>
struct MomentumProjection {
  explicit MomentumProjection(const HolonomicConstraints<T>& constraints)
      : hidden(constraints.count()), reaction(constraints.degrees()) {}

  /// p += change - B^T x with hidden constraints phi~(q, p, t) = 0, the constraints being placed at (t, q).
  /// `p` is the momentum before, `carry` what it has rounded off; `change` is left with what is to be added,
  /// and `moved` with the sum. `linear`: H_p is linear in p.
  Status operator()(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, In<T> carry,
                    Out<T> change, Out<T> moved, bool linear) {
    Convergence<T> convergence;
    do {
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = p[k] + (change[k] + carry[k]);
      constraints.hidden_values(t, q, moved, hidden);
      constraints.solve(hidden, hidden);
      constraints.apply_transpose(hidden, reaction);
      Largest<T> correction, reference;
      for (std::size_t k = 0; k < moved.size(); ++k) {
        change[k] = change[k] - reaction[k];
        if (!linear) {
          correction.add(reaction[k]);
          reference.add(p[k]);
          reference.add(change[k]);
        }
      }
      if (linear) break;
      convergence.begin_iteration();
      convergence.add(correction.get(), reference.get(), reference.get());
    } while (!convergence.finished(50));
    return linear ? Status::converged : convergence.status();
  }

  std::vector<T> hidden, reaction;
};

}  // namespace pfaff
