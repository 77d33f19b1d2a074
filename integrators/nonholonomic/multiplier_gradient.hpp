// A discrete gradient method for H(q, p, t) with constraints psi(q, p, t) = A(q, t) v + b(q, t) = 0 of the
// velocities v = H_p.
//
// Nonholonomic motion is z' = Pi grad H with a skew tensor Pi on the surface psi = 0 (not a Poisson tensor):
//
//   Pi = J - sum_ij (J c_i) (W^-1)_ij (J c_j)^T,  W_ij = c_i^T J c_j,  c the rows of psi_z and of (A, 0).
//
// This is the form of Dirac's bracket, but of one-forms c of which those that are A dq need not be gradients.
// Pi c = 0 says that the motion keeps psi = 0 and A v = 0. The method replaces grad H and psi_z by discrete
// gradients, in the direction D = z1 - z0 and with zm = (z0 + z1)/2, and A by A(qm):
//
//   z1 - z0 = h J (H_bar - sum_j x_j psi_bar_j - sum_j y_j (A_j(qm), 0)),
//   psi(z1) = 0,   A(qm) (q1 - q0) + h b(qm) = 0
//   f_bar = grad f(zm) + D [f(z1) - f(z0) - grad f(zm).D] / |D|^2      (gonzalez1996)
//
// where x = O(h^2) and y are the multipliers that satisfy the second line. Since the matrix that W stands for
// is skew, H(z1) = H(z0) follows exactly, whatever A is, where b = 0 and H does not depend on time. psi = 0
// holds exactly too. celledoni-farre-hoiseth-martin2019 keep the energy in coordinates of ker A, which need a
// basis of it; here none is chosen, and the result depends on none. Of their method this is another member of
// order 2 with the same properties.
//
// With mean values along D (mean_value.hpp) in place of f_bar both hold as exactly as the mean values are
// taken, the energy of constraints A(q) that do not move.
//
// Order 2, symmetric, and reversible where the reversal is orthogonal. Where |D| is so small that the
// quotient is only round-off, grad H(zm) alone is used; the energy changes by less than round-off then. All
// unknowns are iterated to round-off from what is extrapolated from past steps, the multipliers by Newton's
// method with S at the middle. The update is compensated.
#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/nonholonomic/energy_slopes.hpp>
#include <pfaff/integrators/nonholonomic/mean_value.hpp>
#include <pfaff/integrators/support/coordinate_convergence.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>
#include <pfaff/integrators/support/settling_convergence.hpp>

namespace pfaff {

/// The tape (q, p, x, t) -> gradient in (q, p) of sum_j x_j psi_j, with the constraints in the order of
/// VelocityConstraints: holonomic ones at the level of velocities, then those of velocities.
inline std::shared_ptr<const Tape> weighted_constraint_gradient(const Model& model) {
  const auto all = model.tape(Formula::constraints);
  const std::size_t n = static_cast<std::size_t>(model.dimension()), count = all->outputs.size(),
                    velocity = model.tape(Formula::velocity_offsets)->outputs.size(),
                    hidden = (count - velocity) / 2;  // holonomic ones are each followed by the hidden one
  return std::make_shared<const Tape>(record(static_cast<int>(n + hidden + velocity), static_cast<int>(n),
                                             [&](const Recorded& t, In<Recorded> in, Out<Recorded> out) {
                                               std::vector<Recorded> weights(count);
                                               for (std::size_t k = 0; k < hidden; ++k)
                                                 weights[2 * k + 1] = in[n + k];
                                               for (std::size_t k = 0; k < velocity; ++k)
                                                 weights[2 * hidden + k] = in[n + hidden + k];
                                               const auto slopes = gradient(*all, t, in.first(n), weights);
                                               for (std::size_t k = 0; k < n; ++k) out[k] = slopes[k];
                                             }));
}

/// The method of the opening comment.
struct MultiplierDiscreteGradient {
  bool compensated = true;
  Quad length{1};  // of D, in units of the step
  int nodes = 0;   // of mean values along D; 0 for the f_bar of the opening comment

  template <class P>
  struct Work {
    using T = Scalar<P>;
    Replay<T> energy;  // the tape, since compiled energies of many bodies may allocate
    EnergySlopes<T> energy_slopes;
    Replay<T> weighted;    // the gradient of x.psi
    std::vector<T> carry;  // what the sums of q and p have rounded off
    // D, what corrects it, z0 + D/2 followed by x, z0 + D, and the gradient of x.psi: (q, p)
    std::vector<T> change, next, middle, end, slopes;
    std::vector<T> y, residual, reaction;
    MeanValue<T> mean;
    // A point along D followed by x, the slopes there, and the mean of those of H: (H_p, -H_q)
    std::vector<T> point, along, energy_mean;
    DifferencePredictor<T, dynamic, difference_levels<T>> predictor;  // of D/h, x, y
    RememberedContraction<Value<T>> contraction;
    T last_h{0}, length;

    Work(const MultiplierDiscreteGradient& method, const P& p)
        : energy(p.model()->tape(Formula::hamiltonian)),
          energy_slopes(p.model()),
          weighted(weighted_constraint_gradient(*p.model())),
          carry(p.size()),
          change(p.size()),
          next(p.size()),
          middle(p.size() + p.nonholonomic().count()),
          end(p.size()),
          slopes(p.size()),
          y(p.nonholonomic().count()),
          residual(y.size()),
          reaction(n()),
          mean(method.nodes),
          point(middle.size()),
          along(p.size()),
          energy_mean(p.size()),
          predictor(p.size() + 2 * y.size(), static_cast<std::size_t>(difference_levels<T>)),
          length(Real(method.length)) {}
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
    [[nodiscard]] T& x(std::size_t j) { return middle[carry.size() + j]; }
    [[nodiscard]] T energy_at(const T& t, const std::vector<T>& z) {
      T value(0);
      energy(t, z.data(), &value);
      return value;
    }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t size = w.carry.size();
    const T middle_time = t + h / T(2);  // of both energies, so that only z makes their difference
    if (Status status = predict(p, t, h, z, w); status != Status::converged) return status;
    for (std::size_t k = 0; k < size; ++k) w.end[k] = z[k] + w.carry[k];
    const T energy = w.energy_at(middle_time, w.end);
    for (std::size_t k = 0; k < size; ++k) w.middle[k] = w.end[k] + w.change[k] / T(2);
    weigh(middle_time, z, w);
    CoordinateConvergence<T, SettlingConvergence<T>> convergence(Corrections::uneven);
    Status status = Status::converged;
    do {
      status = improve(p, t, h, energy, z, w);
      if (status != Status::converged) break;
      convergence.begin_iteration();
      for (const std::size_t begin : {std::size_t{0}, size / 2}) {
        VectorCorrections<T> corrections(convergence.each());
        for (std::size_t k = begin; k < begin + size / 2; ++k) {
          corrections.against(z[k]);
          corrections.against(w.next[k]);
          corrections.add(w.next[k] - w.change[k], z[k], w.next[k]);
        }
        convergence.add(corrections);
      }
      std::swap(w.change, w.next);
      ++p.counters().iterations;
    } while (!convergence.finished(100, w.contraction));
    w.contraction.remember_slowest(convergence.contraction());
    // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
    if (status == Status::converged && convergence.status() != Status::converged)
      status = Status::not_converged;
    if (status != Status::converged) {
      w.predictor.forget();
      return status;
    }
    w.predictor.remember([&](std::size_t k) {
      return k < size ? w.change[k] / h : k < size + w.y.size() ? w.x(k - size) : w.y[k - size - w.y.size()];
    });
    w.last_h = h;
    for (std::size_t k = 0; k < size; ++k) add_to(z[k], w.carry[k], w.change[k], compensated);
    return Status::converged;
  }

 private:
  // D, x and y from which the iteration starts.
  template <class P>
  static Status predict(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n(), size = 2 * n;
    if (value_of(h) != value_of(w.last_h)) {
      w.predictor.forget();
      w.contraction.forget();  // longer steps contract more slowly
    }
    for (std::size_t k = 0; k < size; ++k) w.change[k] = h * w.predictor.expected(k);
    for (std::size_t j = 0; j < w.y.size(); ++j) {
      w.x(j) = w.predictor.expected(size + j);
      w.y[j] = w.predictor.expected(size + w.y.size() + j);
    }
    if (w.predictor.knows()) return Status::converged;
    VelocityConstraints<T>& c = p.nonholonomic();
    ++p.counters().factorisations;
    if (const Status status = c.place(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
        status != Status::converged)
      return status;
    c.solve(c.rates(), w.y);
    c.apply_transpose(w.y, w.reaction);
    for (std::size_t k = 0; k < n; ++k) {
      w.change[k] = h * c.velocities()[k];
      w.change[n + k] = h * (c.forces()[k] - w.reaction[k]);
    }
    return Status::converged;
  }

  // One iteration: from D in `change`, x and y to D in `next`, x and y.
  template <class P>
  static Status improve(const P& p, const Scalar<P>& t, const Scalar<P>& h, const Scalar<P>& energy,
                        const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.n(), size = 2 * n;
    const T half = T(1) / T(2), time = t + half * h;
    for (std::size_t k = 0; k < size; ++k) {
      w.middle[k] = z[k] + (half * w.change[k] + w.carry[k]);
      w.end[k] = z[k] + (w.change[k] + w.carry[k]);
    }
    ++p.counters().fields;
    ++p.counters().factorisations;
    if (const Status status = c.place(time, In<T>(w.middle.data(), n), In<T>(w.middle.data() + n, n));
        status != Status::converged)
      return status;
    const T reach = w.length * h, per_step = T(1) / reach;
    c.apply_transpose(w.y, w.reaction);
    if (w.mean.places.empty()) {
      const T s = secant(c, w.energy_at(time, w.end) - energy, z, w);
      for (std::size_t j = 0; j < w.y.size(); ++j) w.residual[j] = w.x(j);
      c.by_momentum_transpose(w.residual, Out<T>(w.end.data(), n));
      for (std::size_t k = 0; k < n; ++k) {
        w.next[k] = reach * (c.velocities()[k] + (s * w.change[n + k] - w.end[k]));
        w.next[n + k] = reach * ((c.forces()[k] - w.reaction[k]) + (w.slopes[k] - s * w.change[k]));
      }
    } else {
      average(z, w, w.energy_mean, [&](const T* at, T* slopes) {
        w.energy_slopes(time, In<T>(at, n), In<T>(at + n, n), Out<T>(slopes, n), Out<T>(slopes + n, n));
      });
      for (std::size_t k = 0; k < n; ++k) {
        w.next[k] = reach * (w.energy_mean[k] - w.slopes[n + k]);
        w.next[n + k] = reach * ((w.energy_mean[n + k] - w.reaction[k]) + w.slopes[k]);
      }
    }
    if (w.energy_slopes.separable()) follow(c, time, reach, z, w);
    // x, by which A(qm) (q1 - q0) + h b(qm) = 0, where b = psi - A v.
    for (std::size_t k = 0; k < n; ++k) w.reaction[k] = per_step * w.next[k] - c.velocities()[k];
    c.apply(w.reaction, w.residual);
    for (std::size_t j = 0; j < w.y.size(); ++j) w.residual[j] = w.residual[j] + c.residuals()[j];
    c.solve(w.residual, w.residual);
    c.by_momentum_transpose(w.residual, w.reaction);
    for (std::size_t j = 0; j < w.y.size(); ++j) w.x(j) = w.x(j) + w.residual[j];
    for (std::size_t k = 0; k < n; ++k) w.next[k] = w.next[k] - reach * w.reaction[k];
    // The same x in the momenta.
    for (std::size_t k = 0; k < n; ++k) w.next[n + k] = w.next[n + k] - reach * w.slopes[k];
    weigh(time, z, w);
    for (std::size_t k = 0; k < n; ++k) w.next[n + k] = w.next[n + k] + reach * w.slopes[k];
    // y, by which psi(z1) = 0.
    for (std::size_t k = 0; k < size; ++k) w.end[k] = z[k] + (w.next[k] + w.carry[k]);
    c.values(t + h, In<T>(w.end.data(), n), In<T>(w.end.data() + n, n), w.residual);
    c.solve(w.residual, w.residual);
    c.apply_transpose(w.residual, w.reaction);
    for (std::size_t j = 0; j < w.y.size(); ++j) w.y[j] = w.y[j] + per_step * w.residual[j];
    for (std::size_t k = 0; k < n; ++k) w.next[n + k] = w.next[n + k] - w.reaction[k];
    return Status::converged;
  }

  // The mean of f along D.
  template <class P, class T = Scalar<P>, class F>
  static void average(const State<P>& z, Work<P>& w, std::vector<T>& mean, const F& f) {
    w.mean([&](std::size_t k) { return z[k] + w.carry[k]; }, w.change, w.point, w.along, mean, f);
  }
  // Fills `slopes` with the gradient of x.psi, at the middle or as a mean.
  template <class P, class T = Scalar<P>>
  static void weigh(const T& time, const State<P>& z, Work<P>& w) {
    if (w.mean.places.empty()) {
      w.weighted(time, w.middle.data(), w.slopes.data());
      return;
    }
    for (std::size_t j = 0; j < w.y.size(); ++j) w.point[w.carry.size() + j] = w.x(j);
    average(z, w, w.slopes, [&](const T* at, T* slopes) { w.weighted(time, at, slopes); });
  }

  // Moves the positions of `next` with the velocity at the new middle of its momenta. Where H = T(p, t) +
  // V(q, t) this costs little, and corrections then contract by h^2 and not by h.
  template <class T>
  static void follow(const VelocityConstraints<T>& c, const T& time, const T& h, const auto& z, auto& w) {
    const std::size_t n = w.n();
    for (std::size_t k = n; k < 2 * n; ++k) w.end[k] = z[k] + (w.next[k] / T(2) + w.carry[k]);
    w.energy_slopes.velocity(time, In<T>(w.end.data() + n, n), w.reaction);
    for (std::size_t k = 0; k < n; ++k) w.next[k] = w.next[k] + h * (w.reaction[k] - c.velocities()[k]);
  }

  // The factor of D in H_bar - sum_j x_j psi_bar_j, where psi is zero at both ends of the step. `gain` is
  // H(z1) - H(z0).
  template <class P, class T = Scalar<P>>
  static T secant(const VelocityConstraints<T>& c, const T& gain, const State<P>& z, const Work<P>& w) {
    const std::size_t n = w.n();
    T square(0), linear(0);
    Value<T> length(0);
    for (std::size_t k = 0; k < n; ++k) {
      const T &dq = w.change[k], &dp = w.change[n + k];
      square = square + (dq * dq + dp * dp);
      linear = linear + ((c.velocities()[k] - w.slopes[n + k]) * dp - (c.forces()[k] + w.slopes[k]) * dq);
      length = length + value_of(z[k]) * value_of(z[k]) + value_of(z[n + k]) * value_of(z[n + k]);
    }
    const auto unit = static_cast<double>(unit_roundoff<T>());
    if (!(value_of(square) > Value<T>(std::pow(unit, 2.0 / 3)) * length)) return T(0);
    return (gain - linear) / square;
  }
};

}  // namespace pfaff
