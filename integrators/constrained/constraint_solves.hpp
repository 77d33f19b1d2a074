// What methods on a constraint surface have in common: the projection of momenta onto the constraints of
// velocities, hidden ones of holonomic constraints or A v + b = 0, and a test whether the velocity H_p is
// linear in the momenta.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
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

/// The sizes of the terms of phi, by which positions in very different units are found to be on the surface.
///
/// Corrections of positions are judged by the largest of them, against the largest position (Largest). Where
/// one coordinate is counted in millionths of the units of another this passes over the corrections that
/// matter. phi_i is then judged against the sum over k of |B_ik| (|q_k| + |dq_k|), which is independent of
/// all units.
template <class T>
class ConstraintSizes {
 public:
  /// Leaves the constraints placed elsewhere.
  explicit ConstraintSizes(PositionConstraints<T>& c)
      : unit_(c.degrees()), column_(c.count()), values_(c.count()), sizes_(c.count()) {
    differ_ = coordinates_differ(c);
  }

  /// True where coordinates are in so different units that phi has to be judged.
  [[nodiscard]] bool units_differ() const { return differ_; }
  /// Takes the sizes at q, where the constraints are placed, and of what a step adds to it: at the origin of
  /// the coordinates there is nothing else to judge by.
  void place(PositionConstraints<T>& c, In<T> q, In<T> displacement) {
    std::fill(sizes_.begin(), sizes_.end(), T(0));
    for (std::size_t k = 0; k < q.size(); ++k) {
      take_column(c, k);
      for (std::size_t i = 0; i < sizes_.size(); ++i)
        sizes_[i] =
            sizes_[i] + T(abs(value_of(column_[i]))) * (size_of_parts(q[k]) + size_of_parts(displacement[k]));
    }
  }
  /// Keeps phi, before it is overwritten by what it leads to.
  void keep(In<T> phi) { std::copy(phi.begin(), phi.end(), values_.begin()); }
  /// Adds what was kept to the corrections of an iteration, and returns the largest.
  Value<T> add_to(Convergence<T>& convergence) const {
    Value<T> largest(0);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      convergence.add(values_[i], sizes_[i], sizes_[i]);
      largest = std::max(largest, relative_size(values_[i], sizes_[i], sizes_[i]));
    }
    return largest;
  }

 private:
  // At generic positions the slopes of a constraint differ by what the shape of the surface makes of them,
  // which is less than this where all coordinates are lengths or angles. Larger systems are not looked at:
  // they are molecules and chains, and looking would take longer than many steps.
  static constexpr double least_ratio = 16384;
  static constexpr std::size_t most_entries = 4096;

  bool coordinates_differ(PositionConstraints<T>& c) {
    const std::size_t n = c.degrees();
    if (n * c.count() > most_entries) return false;
    // S may be singular there; B is what is looked at.
    (void)c.linearise(generic_time<T>(), generic_positions<T>(n), std::vector<T>(n));
    std::vector<Value<T>> least(c.count(), std::numeric_limits<Value<T>>::infinity()), most(c.count());
    for (std::size_t k = 0; k < n; ++k) {
      take_column(c, k);
      for (std::size_t i = 0; i < column_.size(); ++i) {
        const Value<T> slope = abs(value_of(column_[i]));
        if (slope > Value<T>(0)) least[i] = std::min(least[i], slope);
        most[i] = std::max(most[i], slope);
      }
    }
    for (std::size_t i = 0; i < most.size(); ++i)
      if (isfinite(most[i]) && most[i] > Value<T>(least_ratio) * least[i]) return true;
    return false;
  }
  void take_column(PositionConstraints<T>& c, std::size_t k) {
    unit_[k] = T(1);
    c.apply(unit_, column_);
    unit_[k] = T(0);
  }
  static T size_of_parts(const T& x) {
    Largest<T> size;
    size.add(x);
    return size.get();
  }

  std::vector<T> unit_, column_, values_, sizes_;
  bool differ_ = false;
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
