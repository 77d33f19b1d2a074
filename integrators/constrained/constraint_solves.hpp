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
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/support/largest.hpp>

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

/// Whether an iteration still brings positions nearer to the surface, where their units do not let the sizes
/// of corrections tell it.
///
/// Corrections of positions are judged by the largest of them, against the largest position (Largest). Where
/// one coordinate is counted in millionths of the units of another this passes over the corrections that
/// matter. There an iteration that has converged by that measure goes on while a constraint, or a derivative
/// of it, is left at less than half of the smallest value that it has been left at. This depends on no units,
/// and needs no bound for the rounding of phi, which only its formula has.
template <class T>
class ApproachToSurface {
 public:
  /// Leaves the constraints placed elsewhere.
  explicit ApproachToSurface(PositionConstraints<T>& c) : smallest_(c.count()) { watches_ = units_differ(c); }

  void begin() {
    if (!watches_) return;
    more_ = 0;
    for (T& x : smallest_)
      for_each_part(x, x, [](const Value<T>&, Value<T>& smallest) {
        smallest = std::numeric_limits<Value<T>>::infinity();
      });
  }
  /// Takes phi of one iteration more.
  void take(In<T> phi) {
    if (!watches_) return;
    nearer_ = false;
    for (std::size_t i = 0; i < smallest_.size(); ++i)
      for_each_part(phi[i], smallest_[i], [this](const Value<T>& left, Value<T>& smallest) {
        nearer_ = nearer_ || abs(left) < smallest / Value<T>(2);
        smallest = std::min(smallest, Value<T>(abs(left)));
      });
  }
  /// True where an iteration that has converged goes on.
  [[nodiscard]] bool goes_on() { return watches_ && nearer_ && ++more_ <= most_more; }

 private:
  // At generic positions the slopes of constraints differ by what the shape of the surface makes of them,
  // which is less than this where all coordinates are lengths or angles. Larger systems are not looked at:
  // they are molecules and chains, and looking would take longer than many steps.
  static constexpr double least_ratio = 16384;
  static constexpr std::size_t most_entries = 4096;
  static constexpr int most_more = 16;

  static bool units_differ(PositionConstraints<T>& c) {
    const std::size_t n = c.degrees();
    if (n * c.count() > most_entries) return false;
    // S may be singular there; B is what is looked at.
    (void)c.linearise(generic_time<T>(), generic_positions<T>(n), std::vector<T>(n));
    Value<T> least = std::numeric_limits<Value<T>>::infinity(), most(0);
    std::vector<T> unit(n), column(c.count());
    for (std::size_t k = 0; k < n; ++k) {
      unit[k] = T(1);
      c.apply(unit, column);
      unit[k] = T(0);
      Value<T> largest(0);
      for (const T& entry : column) {
        const Value<T> slope = abs(value_of(entry));
        if (slope > Value<T>(0)) least = std::min(least, slope);
        largest = std::max(largest, slope);
      }
      if (largest == Value<T>(0)) return true;  // of a position that is not in phi nothing is known
      most = std::max(most, largest);
    }
    return isfinite(most) && most > Value<T>(least_ratio) * least;
  }
  // The values of two numbers, and their derivatives in each direction.
  template <class Do>
  static void for_each_part(const T& a, T& b, const Do& act) {
    if constexpr (std::is_same_v<T, Value<T>>) {
      act(a, b);
    } else {
      act(a.value, b.value);
      for (std::size_t k = 0; k < a.derivative.size(); ++k) act(a.derivative[k], b.derivative[k]);
    }
  }

  std::vector<T> smallest_;  // of |phi| and of its derivatives, since begin()
  bool watches_ = false, nearer_ = false;
  int more_ = 0;
};

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
    Convergence<T> convergence;
    do {
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = p[k] + (change[k] + carry[k]);
      detail::velocity_residuals<T>(constraints, t, q, moved, hidden);
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
