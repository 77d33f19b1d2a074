// LINCS for H = T(p, t) + V(q, t) with constraints phi(q, t) = 0: the kicks and drifts of Stoermer-Verlet,
// with constraint forces from a truncated series instead of a solve,
//
//   S^-1 ~ (1 + A + A^2 + ... + A^k) D^-1,   A = 1 - D^-1 S,   D the diagonal of S
//
// (hess1997). A drift is first corrected to linear order, phi(q0) + B (q1 - q0) = 0, then by as many further
// corrections with phi(q1) as are asked for; a kick in the same way with phi~. The method is here for
// comparison: it shows what such corrections cost and which residuals they leave. It does not iterate until
// the constraints hold to round-off, and therefore claims to keep nothing.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/constrained/constrained_verlet.hpp>

namespace pfaff {

/// Stoermer-Verlet with LINCS.
struct Lincs : ConstrainedVerlet {
  int expansion = 4, iterations = 1;

  static std::vector<Parameter> parameters() {
    return {
        parameter(&Lincs::expansion, "expansion", "", 0, 64, "highest power in the series for S^-1"),
        parameter(&Lincs::iterations, "iterations", "", 0, 64, "corrections after the linear one"),
        parameter(static_cast<bool Lincs::*>(&Lincs::compensated), "compensated", "compensated summation")};
  }
  /// Where constraints are coupled, the truncated series misses a part of their forces that does not shrink
  /// with the step: the order is then 1.
  [[nodiscard]] int order(const Model& model) const {
    return model.holonomic_constraints<double>()->pattern().couplings().empty() ? 2 : 1;
  }

  template <class P>
  struct Work : ConstrainedVerlet::Work<P> {
    using T = Scalar<P>;
    std::vector<T> move;
    std::vector<T> residual, right, series, image, diagonal;
    std::vector<std::size_t> colour;  // no two constraints of a colour are coupled by S
    std::size_t colours = 0;

    Work(const Lincs& method, const P& p)
        : ConstrainedVerlet::Work<P>(method, p),
          move(this->n()),
          residual(p.holonomic().count()),
          right(residual.size()),
          series(residual.size()),
          image(residual.size()),
          diagonal(residual.size()),
          colour(residual.size(), residual.size()) {
      // Greedy colouring: every constraint takes the first colour that none of those coupled to it has, so
      // that there are at most as many colours as the most couplings of one constraint, plus one.
      std::vector<std::vector<std::size_t>> coupled(colour.size());
      for (const auto& [i, j] : p.holonomic().pattern().couplings()) {
        coupled[i].push_back(j);
        coupled[j].push_back(i);
      }
      for (std::size_t i = 0; i < colour.size(); ++i) {
        std::vector<bool> taken(coupled[i].size() + 1);
        for (const std::size_t j : coupled[i])
          if (colour[j] < taken.size()) taken[colour[j]] = true;
        colour[i] = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
        colours = std::max(colours, colour[i] + 1);
      }
    }

    /// The diagonal of S where the constraints are placed. One product with S, of the vector that is 1 at all
    /// constraints of a colour and 0 elsewhere, gives the diagonal for the whole colour.
    void take_diagonal(const PositionConstraints<T>& c) {
      for (std::size_t one = 0; one < colours; ++one) {
        for (std::size_t i = 0; i < series.size(); ++i) series[i] = T(colour[i] == one ? 1 : 0);
        times(c, series, image);
        for (std::size_t i = 0; i < series.size(); ++i)
          if (colour[i] == one) diagonal[i] = image[i];
      }
    }
    /// r = S x
    void times(const PositionConstraints<T>& c, In<T> x, Out<T> r) {
      c.hidden_by_momentum_transpose(x, move);
      c.apply(move, r);
    }
    /// Sets `series` to the approximation of S^-1 r by powers of A up to `highest`.
    void expand(const PositionConstraints<T>& c, In<T> r, int highest) {
      for (std::size_t i = 0; i < series.size(); ++i) series[i] = right[i] = r[i] / diagonal[i];
      for (int power = 0; power < highest; ++power) {
        times(c, series, image);
        for (std::size_t i = 0; i < series.size(); ++i)
          series[i] = right[i] + (series[i] - image[i] / diagonal[i]);
      }
    }
  };

  template <HasHolonomic P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    PositionConstraints<T>& c = p.holonomic();
    const std::size_t n = w.n();
    const In<T> q(z.data(), n), p0(z.data() + n, n);
    if (const Status status = c.linearise(t, q, p0); status != Status::converged) return status;
    w.take_diagonal(c);
    c.force(t, q, p0, w.force);
    const T kick = w.first * h, length = w.drift * h;
    for (std::size_t k = 0; k < n; ++k) {
      w.impulse[k] = kick * w.force[k];
      w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
    }
    c.velocity(t + kick, q, w.momentum, w.displacement);
    for (T& x : w.displacement) x = length * x;
    for (int correction = 0; correction <= iterations; ++correction) {
      if (correction == 0) {
        c.values(t, q, w.residual);
        c.apply(w.displacement, w.image);
        for (std::size_t i = 0; i < w.residual.size(); ++i) w.residual[i] = w.residual[i] + w.image[i];
      } else {
        w.place_positions(z);
        c.values(t + h, w.position, w.residual);
      }
      w.expand(c, w.residual, expansion);
      c.hidden_by_momentum_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.displacement[k] = w.displacement[k] - w.move[k];
      c.apply_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.move[k] / length;
    }
    w.place_positions(z);
    if (const Status status = place_at_end(p, t + h, w); status != Status::converged) return status;
    p.counters().factorisations += 2;
    p.counters().fields += 2;
    w.take_diagonal(c);
    w.kick(w.last * h);
    for (int correction = 0; correction <= iterations; ++correction) {
      w.place_momenta(z);
      c.hidden_values(t + h, w.position, w.momentum, w.residual);
      w.expand(c, w.residual, expansion);
      c.apply_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.move[k];
    }
    add_changes(z, w);
    return Status::converged;
  }
};

}  // namespace pfaff
