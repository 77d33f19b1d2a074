// Projection of a method's steps onto the surface of constraints of a formulated system.
//
// With the base method's step Phi_h there are two forms, whatever the constraints:
//   after the step (hairer-lubich-wanner2006 IV.4, algorithm 4.2): z1 is Phi_h(z0) projected;
//   symmetric (V.4.1): z1 = Phi_h(z0 + D(z0) m) + D(z1) m with multipliers m.
// Both keep the order of the method. The first keeps the constraints and nothing else; the second is
// symmetric where the method is, and follows time-reversible systems without drift. Neither is symplectic.
//
// What is projected is a class template Shift<T>, which knows the directions D and has the multipliers:
//   SurfaceShift (below)     onto phi = 0, phi~ = 0: positions along H_pp B^T, momenta along B^T, so that the
//                            masses weigh the projection; D m = (H_pp B^T x, B^T y), m = (x, y)
//   VelocityShift (nonholonomic/velocity_projection.hpp)    onto A v + b = 0: momenta along A^T alone
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>

namespace pfaff {

/// The shift for holonomic constraints: of positions and momenta.
template <class T>
class SurfaceShift {
 public:
  using Constraints = PositionConstraints<T>;
  template <class P>
  static constexpr bool fits = HasHolonomic<P>;
  static constexpr bool moves_positions = true;

  template <class P>
  static Constraints& of(const P& p) {
    return p.holonomic();
  }
  static std::unique_ptr<Constraints> made(const Model& model) {
    return model.template holonomic_constraints<T>();
  }
  explicit SurfaceShift(const Constraints& c)
      : by_position_(c.count()),
        by_momentum_(c.count()),
        residual_(c.count()),
        rate_(c.count()),
        move_(c.degrees()),
        kick_(c.degrees()) {}

  /// state += D m, with H_pp and B of the point where the constraints `at` were placed.
  void apply(const Constraints& at, auto& state) {
    const std::size_t n = move_.size();
    at.hidden_by_momentum_transpose(by_position_, move_);
    at.apply_transpose(by_momentum_, kick_);
    for (std::size_t k = 0; k < n; ++k) {
      state[k] = state[k] + move_[k];
      state[n + k] = state[n + k] + kick_[k];
    }
  }
  /// Corrects the multipliers by what the constraints lack at (q, p). They act at both ends of the step, so
  /// that half the correction at each is enough. `move` and `kick` are what is to be taken from (q, p).
  void correct(Constraints& c, const T& t, In<T> q, In<T> p, const CoordinateConvergence<T>& convergence) {
    c.values(t, q, residual_);
    c.hidden_values(t, q, p, rate_);
    c.solve(residual_, residual_, rate_, rate_);
    convergence.kick(residual_);
    convergence.kick(rate_);
    for (std::size_t i = 0; i < rate_.size(); ++i) {
      by_position_[i] = by_position_[i] - residual_[i] / T(2);
      by_momentum_[i] = by_momentum_[i] - rate_[i] / T(2);
    }
    c.hidden_by_momentum_transpose(residual_, move_);
    c.apply_transpose(rate_, kick_);
  }
  /// Moves positions onto phi = 0, along H_pp B^T as it is placed. The step began at `start`.
  Status project_positions(Constraints& c, const T& t, const auto& start, Out<T> q, auto& iterations) {
    CoordinateConvergence<T> convergence;
    do {
      c.values(t, q, residual_);
      c.solve(residual_, residual_);
      convergence.kick(residual_);
      c.hidden_by_momentum_transpose(residual_, move_);
      VectorCorrections<T> moved(convergence.each());
      for (std::size_t k = 0; k < q.size(); ++k) {
        moved.against(q[k]);
        moved.add(move_[k], q[k], q[k] - start[k]);
        q[k] = q[k] - move_[k];
      }
      convergence.begin_iteration();
      convergence.add(moved);
      ++iterations;
    } while (!convergence.finished(50));
    return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
  }
  [[nodiscard]] const T& move(std::size_t k) const { return move_[k]; }
  [[nodiscard]] const T& kick(std::size_t k) const { return kick_[k]; }
  void forget() {
    for (T& x : by_position_) x = T(0);
    for (T& x : by_momentum_) x = T(0);
  }

 private:
  std::vector<T> by_position_, by_momentum_;  // x, y
  std::vector<T> residual_, rate_, move_, kick_;
};

/// Steps of Base, each followed by a projection.
template <class Base, template <class> class Shift>
struct Projected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    State<P> end;
    Shift<T> shift;
    std::vector<T> change, no_carry, moved;
    MomentumProjection<T> onto_velocities;

    Work(const Projected& method, const P& p)
        : base(method, p),
          end(p.make_state()),
          shift(Shift<T>::of(p)),
          change(p.size() / 2),
          no_carry(change.size()),
          moved(change.size()),
          onto_velocities(Shift<T>::of(p)) {}
  };

  template <class P>
  requires(Shift<Scalar<P>>::template fits<P>&& Steps<Base, P>) Status
      step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w)
  const {
    using T = Scalar<P>;
    auto& c = Shift<T>::of(p);
    const std::size_t n = w.change.size();
    std::copy(z.begin(), z.end(), w.end.begin());
    if (const Status status = Base::step(p, t, h, w.end, w.base); status != Status::converged) return status;
    const Out<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    ++p.counters().factorisations;
    Status status = c.linearise(t + h, q, momentum);
    if constexpr (Shift<T>::moves_positions) {
      if (status == Status::converged)
        status = w.shift.project_positions(c, t + h, z, q, p.counters().iterations);
      if (status == Status::converged) {
        ++p.counters().factorisations;
        status = c.linearise(t + h, q, momentum);
      }
    }
    if (status != Status::converged) return status;
    for (T& x : w.change) x = T(0);
    constexpr bool linear = false;  // a second solve removes what the first rounds off
    status = w.onto_velocities(c, t + h, q, momentum, w.no_carry, w.change, w.moved, linear);
    if (status != Status::converged) return status;
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = q[k];
      z[n + k] = momentum[k] + w.change[k];
    }
    return Status::converged;
  }
};

/// Steps of Base, projected symmetrically. The workspace of Base has to offer restart(): it is started afresh
/// in every iteration, so that the step depends on its state alone and not on the iterations before.
template <class Base, template <class> class Shift>
struct SymmetricallyProjected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    // Placed at z0; those of the problem are placed at z1.
    std::unique_ptr<typename Shift<T>::Constraints> at_start;
    State<P> start, end;
    Shift<T> shift;

    Work(const SymmetricallyProjected& method, const P& p)
        : base(method, p),
          at_start(Shift<T>::made(*p.model())),
          start(p.make_state()),
          end(p.make_state()),
          shift(Shift<T>::of(p)) {}
  };

  template <class P>
  requires(Shift<Scalar<P>>::template fits<P>&& Steps<Base, P>) Status
      step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w)
  const {
    using T = Scalar<P>;
    constexpr bool moves_positions = Shift<T>::moves_positions;
    auto& c = Shift<T>::of(p);
    const std::size_t n = z.size() / 2;
    const In<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    Status status = w.at_start->linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    if (status == Status::converged) status = c.linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    p.counters().factorisations += 2;
    // z1 and D(z1) are improved in turns: D(z1) is one iteration behind.
    CoordinateConvergence<T> convergence(Corrections::in_turns);
    while (status == Status::converged) {
      std::copy(z.begin(), z.end(), w.start.begin());
      w.shift.apply(*w.at_start, w.start);
      std::copy(w.start.begin(), w.start.end(), w.end.begin());
      w.base.restart();
      status = Base::step(p, t, h, w.end, w.base);
      if (status != Status::converged) break;
      if constexpr (moves_positions) w.shift.apply(c, w.end);
      ++p.counters().factorisations;
      status = c.linearise(t + h, q, momentum);
      if (status != Status::converged) break;
      if constexpr (!moves_positions) w.shift.apply(c, w.end);
      // Corrections are judged against the shift, too: at rest it holds what the base method adds, so that
      // the state is far smaller than what was rounded on the way to it.
      VectorCorrections<T> moved(convergence.each()), kicked(convergence.each());
      for (std::size_t k = 0; k < n; ++k) {
        if constexpr (moves_positions) moved.against(w.shift.move(k));
        kicked.against(w.shift.kick(k));
      }
      w.shift.correct(c, t + h, q, momentum, convergence);
      for (std::size_t k = 0; k < n; ++k) {
        if constexpr (moves_positions) {
          moved.against(q[k]);
          moved.add(w.shift.move(k), q[k], q[k] - z[k]);
        }
        kicked.against(momentum[k]);
        kicked.against(z[n + k]);
        kicked.add(w.shift.kick(k), momentum[k], momentum[k] - z[n + k]);
      }
      convergence.begin_iteration();
      if constexpr (moves_positions) convergence.add(moved);
      convergence.add(kicked);
      ++p.counters().iterations;
      if (convergence.finished(50)) {
        status = convergence.status() == Status::converged ? Status::converged : Status::not_converged;
        break;
      }
    }
    if (status != Status::converged) {
      w.shift.forget();
      return status;
    }
    for (std::size_t k = 0; k < n; ++k) {  // w.end lacks the last correction, which is added here
      if constexpr (moves_positions) {
        z[k] = w.end[k] - w.shift.move(k);
      } else {
        z[k] = w.end[k];
      }
      z[n + k] = w.end[n + k] - w.shift.kick(k);
    }
    return Status::converged;
  }
};

}  // namespace pfaff
