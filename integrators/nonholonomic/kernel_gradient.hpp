// The discrete gradient method of celledoni-farre-hoiseth-martin2019 for H quadratic in p with constraints
// A(q, t) v = 0. In coordinates (q, pi) of the surface (kernel_coordinates.hpp), with D = z1 - z0 and zm =
// (z0
// + z1)/2 for z = (q, pi), a step is
//
//   q1 - q0 = h X(qm) g_pi,   pi1 - pi0 = h (-X(qm)^T g_q + Gam(zm) g_pi)
//   g = grad H_d(zm) + D [H_d(z1) - H_d(z0) - grad H_d(zm).D] / |D|^2      (gonzalez1996)
//
// Since Gam is skew, H_d(z1) = H_d(z0) exactly where H does not depend on time; A(q1) v1 = 0 holds because p1
// is made of (q1, pi1). Order 2, symmetric, and reversible where the reversal is orthogonal. Where |D| is so
// small that the quotient is only round-off, grad H_d(zm) alone is used; the energy changes by less than
// round-off then. With the mean value of grad H_d along D in place of g (mean_value.hpp) the energy is kept
// as exactly as the mean value is taken. D is iterated to round-off from what is extrapolated from past
// steps. The update of (q, pi) is compensated.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/nonholonomic/kernel_coordinates.hpp>
#include <pfaff/integrators/nonholonomic/mean_value.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/support/coordinate_convergence.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>
#include <pfaff/integrators/support/settling_convergence.hpp>

namespace pfaff {

/// The method of the opening comment.
struct KernelDiscreteGradient {
  bool compensated = true;
  Quad length{1};  // of D, in units of the step
  int nodes = 0;   // of the mean value of grad H_d; 0 for the g of the opening comment

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::size_t n, r;
    Replay<T> energy, at_middle, momentum, reduced;
    std::optional<Replay<T>> gradient;  // of the energy, where mean values are taken
    std::vector<T> pi, carry;           // of the state, and what the sums of q and pi have rounded off
    // D and what replaces it, z0 + D/2 and z0 + D, and the results of `middle`
    std::vector<T> change, next, middle, end, slopes;
    MeanValue<T> mean;
    std::vector<T> point, value;                                          // on the way along D
    DifferencePredictor<T, dynamic, difference_levels<T> + 2> predictor;  // of D/h
    RememberedContraction<Value<T>> contraction;
    Continuation<P> continuation;
    T last_h{0}, length;

    Work(const KernelDiscreteGradient& method, const P& p)
        : Work(method, p, *kernel_coordinates(*p.model())) {}
    /// Forgets past steps; the next one is iterated from its state alone.
    void forget() {
      predictor.forget();
      contraction.forget();
      continuation.forget();
    }

   private:
    Work(const KernelDiscreteGradient& method, const P& p, const KernelCoordinates& coordinates)
        : n(coordinates.degrees),
          r(coordinates.rank),
          energy(coordinates.energy),
          at_middle(coordinates.middle),
          momentum(coordinates.momentum),
          reduced(coordinates.reduced),
          pi(r),
          carry(n + r),
          change(n + r),
          next(n + r),
          middle(n + r),
          end(n + r),
          slopes(n + r + n * r + r * r),
          mean(method.nodes),
          point(n + r),
          value(n + r),
          predictor(n + r, static_cast<std::size_t>(difference_levels<T>) + 2),
          continuation(p),
          length(Real(method.length)) {
      if (method.nodes > 0) gradient.emplace(gradient_tape(*coordinates.energy));
    }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t size = w.n + w.r;
    const T middle_time = t + h / T(2);
    start(t, h, z, w);
    for (std::size_t k = 0; k < size; ++k) w.end[k] = at_start(z, w, k);
    T energy(0);
    if (!w.gradient) w.energy(middle_time, w.end.data(), &energy);
    if (!w.predictor.knows()) {
      w.at_middle(middle_time, w.end.data(), w.slopes.data());
      rates(w.length * h, T(0), w, w.change);
    }
    CoordinateConvergence<T, SettlingConvergence<T>> convergence(Corrections::uneven);
    do {
      ++p.counters().fields;
      for (std::size_t k = 0; k < size; ++k) {
        const T begin = at_start(z, w, k);
        w.middle[k] = begin + w.change[k] / T(2);
        w.end[k] = begin + w.change[k];
      }
      w.at_middle(middle_time, w.middle.data(), w.slopes.data());
      T s(0);
      if (!w.gradient) {
        T end_energy(0);
        w.energy(middle_time, w.end.data(), &end_energy);
        s = secant(end_energy - energy, z, w);
      } else {
        w.mean([&](std::size_t k) { return at_start(z, w, k); }, w.change, w.point, w.value,
               Out<T>(w.slopes).first(size),
               [&](const T* at, T* slopes) { (*w.gradient)(middle_time, at, slopes); });
      }
      rates(w.length * h, s, w, w.next);
      convergence.begin_iteration();
      judge(convergence, z, w);
      std::swap(w.change, w.next);
      ++p.counters().iterations;
    } while (!convergence.finished(100, w.contraction));
    if (convergence.status() != Status::converged) {
      // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
      w.forget();
      return Status::not_converged;
    }
    w.contraction.remember_slowest(convergence.contraction());
    w.predictor.remember([&](std::size_t k) { return w.change[k] / h; });
    w.last_h = h;
    for (std::size_t k = 0; k < w.n; ++k) add_to(z[k], w.carry[k], w.change[k], compensated);
    for (std::size_t a = 0; a < w.r; ++a) add_to(w.pi[a], w.carry[w.n + a], w.change[w.n + a], compensated);
    for (std::size_t k = 0; k < size; ++k) w.end[k] = k < w.n ? z[k] : w.pi[k - w.n];
    w.momentum(t + h, w.end.data(), z.data() + w.n);
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  // Component k of (q, pi) at the start of the step.
  template <class W, class Z>
  static auto at_start(const Z& z, const W& w, std::size_t k) {
    return (k < w.n ? z[k] : w.pi[k - w.n]) + w.carry[k];
  }

  // Makes pi0 where the state is another one than after the last step. Fills D.
  template <class P>
  static void start(const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    if (value_of(h) != value_of(w.last_h)) {
      w.predictor.forget();
      w.contraction.forget();  // longer steps contract more slowly
    }
    if (!w.continuation.holds_at(t, h, z)) {
      w.reduced(t, z.data(), w.pi.data());
      for (T& x : w.carry) x = T(0);
    }
    for (std::size_t k = 0; k < w.change.size(); ++k) w.change[k] = h * w.predictor.expected(k);
  }

  // `out` = h times the right-hand side with the slopes at the middle, s the factor of D in g.
  template <class T, class W>
  static void rates(const T& h, const T& s, W& w, std::vector<T>& out) {
    const std::size_t n = w.n, r = w.r;
    T* gradient = w.slopes.data();
    const T *x = gradient + n + r, *gamma = x + n * r;
    for (std::size_t k = 0; k < n + r; ++k) gradient[k] = gradient[k] + s * w.change[k];
    for (std::size_t a = 0; a < r; ++a) {
      T sum(0);
      for (std::size_t b = 0; b < r; ++b) sum = sum + gamma[a * r + b] * gradient[n + b];
      for (std::size_t k = 0; k < n; ++k) sum = sum - x[k * r + a] * gradient[k];
      out[n + a] = h * sum;
    }
    for (std::size_t k = 0; k < n; ++k) {
      T sum(0);
      for (std::size_t a = 0; a < r; ++a) sum = sum + x[k * r + a] * gradient[n + a];
      out[k] = h * sum;
    }
  }

  // The factor of D in g. `gain` is H_d(z1) - H_d(z0).
  template <class T, class Z, class W>
  static T secant(const T& gain, const Z& z, const W& w) {
    T square(0), linear(0);
    Value<T> length(0);
    for (std::size_t k = 0; k < w.change.size(); ++k) {
      square = square + w.change[k] * w.change[k];
      linear = linear + w.slopes[k] * w.change[k];
      const Value<T> begin = value_of(at_start(z, w, k));
      length = length + begin * begin;
    }
    const auto unit = static_cast<double>(unit_roundoff<T>());
    if (!(value_of(square) > Value<T>(std::pow(unit, 2.0 / 3)) * length)) return T(0);
    return (gain - linear) / square;
  }

  // Positions and momenta are judged each by their own largest component. Derivatives of either may be zero
  // but for round-off, and are judged together.
  template <class T, class Z, class W>
  static void judge(CoordinateConvergence<T, SettlingConvergence<T>>& convergence, const Z& z, const W& w) {
    VectorCorrections<T> moved(convergence.each()), kicked(convergence.each());
    for (std::size_t k = 0; k < w.n + w.r; ++k) {
      const T begin = at_start(z, w, k);
      auto &own = k < w.n ? moved : kicked, &other = k < w.n ? kicked : moved;
      for (const T& x : {begin, w.next[k]}) {
        own.against(x);
        other.against_derivatives(x);
      }
      own.add(w.next[k] - w.change[k], begin, w.next[k]);
    }
    convergence.add(moved);
    convergence.add(kicked);
  }
};

}  // namespace pfaff
