// What methods on a constraint surface have in common: the projection of momenta onto the constraints of
// velocities, hidden ones of holonomic constraints or A v + b = 0, and a test whether the velocity H_p is
// linear in the momenta.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>
#include <pfaff/integrators/support/coordinate_convergence.hpp>

namespace pfaff {

/// A time and positions at which nothing vanishes that is zero at the origin only.
template <class T>
T generic_time() {
  return T(Real::fraction(5, 8));
}
template <class T>
std::vector<T> generic_positions(std::size_t n) {
  std::vector<T> q(n);
  for (std::size_t k = 0; k < n; ++k) q[k] = T(Real::fraction(static_cast<std::int64_t>(1 + k % 7), 16));
  return q;
}

/// True where H_p at (t, q) is linear in p, to round-off and over scales from 1 to a million: one solve then
/// satisfies the constraints of velocities.
template <class T, class Constraints>
bool velocity_is_linear(Constraints& constraints, const T& t, In<T> q) {
  const std::size_t n = constraints.degrees();
  std::vector<T> p(n), sum(n), v(n);
  for (const double scale : {1.0, 1024.0, 1048576.0}) {
    Largest<Value<T>> largest, difference;
    // v(a) + v(b) - v(a + b) - v(0), which is zero where v is linear up to a constant
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

/// True where H_p does not depend on time, as is seen at two times.
template <class T, class Constraints>
bool velocity_is_steady(Constraints& constraints) {
  const std::size_t n = constraints.degrees();
  const std::vector<T> q = generic_positions<T>(n);
  std::vector<T> p(n), now(n), later(n);
  for (std::size_t k = 0; k < n; ++k) p[k] = T(1) + q[k];
  constraints.velocity(generic_time<T>(), q, p, now);
  constraints.velocity(T(2) * generic_time<T>(), q, p, later);
  bool same = true;
  for (std::size_t k = 0; k < n; ++k) same = same && value_of(now[k]) == value_of(later[k]);
  return same;
}

namespace detail {
// What constraints leave of the velocities' equations: phi~ of holonomic ones, psi of those of velocities.
template <class T>
void velocity_residuals(PositionConstraints<T>& c, const T& t, In<T> q, In<T> p, Out<T> residuals) {
  c.hidden_values(t, q, p, residuals);
}
template <class T>
void velocity_residuals(VelocityConstraints<T>& c, const T& t, In<T> q, In<T> p, Out<T> residuals) {
  c.values(t, q, p, residuals);
}
}  // namespace detail

/// The projection of momenta onto the constraints of velocities, with its buffers. The constraints are
/// PositionConstraints, of which phi~ is meant and B = phi_q, or VelocityConstraints, psi = A v + b and B =
/// A.
template <class T>
struct MomentumProjection {
  template <class Constraints>
  explicit MomentumProjection(const Constraints& constraints)
      : hidden(constraints.count()), reaction(constraints.degrees()) {}

  /// Finds the x with which p + change - B^T x satisfies the constraints phi~(q, p, t) = 0 or psi(q, p, t) =
  /// 0; they must have been placed at (t, q). `p` is the momentum before and `carry` what its additions have
  /// rounded off. `change` is left with what is to be added, change - B^T x; `moved` is a buffer. `linear`
  /// says that H_p is linear in p, so that one solve is enough.
  template <class Constraints>
  Status operator()(Constraints& constraints, const T& t, In<T> q, In<T> p, In<T> carry, Out<T> change,
                    Out<T> moved, bool linear) {
    CoordinateConvergence<T> convergence;
    do {
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = p[k] + (change[k] + carry[k]);
      detail::velocity_residuals<T>(constraints, t, q, moved, hidden);
      constraints.solve(hidden, hidden);
      convergence.kick(hidden);
      constraints.apply_transpose(hidden, reaction);
      VectorCorrections<T> kicked(convergence.each());
      for (std::size_t k = 0; k < moved.size(); ++k) {
        change[k] = change[k] - reaction[k];
        if (!linear) {
          kicked.against(p[k]);
          kicked.against(change[k]);
          kicked.add(reaction[k], p[k], change[k]);
        }
      }
      if (linear) break;
      convergence.begin_iteration();
      convergence.add(kicked);
    } while (!convergence.finished(50));
    return linear ? Status::converged : convergence.status();
  }

  std::vector<T> hidden, reaction;
};

}  // namespace pfaff
