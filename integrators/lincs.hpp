// LINCS for H = T(p) + V(q, t) with constraints phi(q, t) = 0: the kicks and drifts of Stoermer-Verlet, with
// constraint forces from a truncated series instead of a solve,
//
//   S^-1 ~ (1 + A + A^2 + ... + A^k) D^-1,   A = 1 - D^-1 S,   D the diagonal of S
//
// (hess1997). A drift is first corrected to linear order, phi(q0) + B (q1 - q0) = 0, then by as many further
// corrections with phi(q1) as are asked for; a kick in the same way with phi~. The method of reference for
// what such corrections cost and leave behind: its residuals are what the series and the corrections make
// them, and it claims to keep nothing.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/rattle.hpp>

namespace pfaff {

/// Stoermer-Verlet with LINCS.
struct Lincs {
  /// The kick, the drift and the kick, in units of the step.
  std::array<Quad, 3> lengths{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)};
  int expansion = 4, iterations = 1;
  bool compensated = true;

  static constexpr bool fixed_sizes = false;

  static std::vector<Parameter> parameters() {
    return {parameter(&Lincs::expansion, "expansion", "", 0, 64, "highest power in the series for S^-1"),
            parameter(&Lincs::iterations, "iterations", "", 0, 64, "corrections after the linear one"),
            parameter(&Lincs::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    return refuses_constrained_motion("lincs", model);
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T first, drift, last;
    std::vector<T> carry, force, impulse, momentum, displacement, position, move;
    std::vector<T> residual, right, series, image, diagonal;
    std::vector<std::size_t> colour;  // no two constraints of a colour are coupled by S
    std::size_t colours = 0;

    Work(const Lincs& method, const P& p)
        : first(Real(method.lengths[0])),
          drift(Real(method.lengths[1])),
          last(Real(method.lengths[2])),
          carry(p.size()),
          force(n()),
          impulse(n()),
          momentum(n()),
          displacement(n()),
          position(n()),
          move(n()),
          residual(p.holonomic().count()),
          right(residual.size()),
          series(residual.size()),
          image(residual.size()),
          diagonal(residual.size()),
          colour(residual.size(), residual.size()) {
      // Greedily: at most one more colour than a constraint has couplings.
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
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }

    /// The diagonal of S at the constraints as placed: S times the sum of the units of a colour.
    void take_diagonal(const HolonomicConstraints<T>& c) {
      for (std::size_t one = 0; one < colours; ++one) {
        for (std::size_t i = 0; i < series.size(); ++i) series[i] = T(colour[i] == one ? 1 : 0);
        times(c, series, image);
        for (std::size_t i = 0; i < series.size(); ++i)
          if (colour[i] == one) diagonal[i] = image[i];
      }
    }
    /// r = S x
    void times(const HolonomicConstraints<T>& c, In<T> x, Out<T> r) {
      c.hidden_by_momentum_transpose(x, move);
      c.apply(move, r);
    }
    /// `series` = S^-1 r, up to the power `highest` of A.
    void expand(const HolonomicConstraints<T>& c, In<T> r, int highest) {
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
    HolonomicConstraints<T>& c = p.holonomic();
    const std::size_t n = w.n();
    const In<T> q(z.data(), n), p0(z.data() + n, n);
    if (const Status status = c.linearise(t, q, p0); status != Status::converged) return status;
    w.take_diagonal(c);
    c.force(t, q, p0, w.force);
    const T kick = w.first * h, length = w.drift * h, last = w.last * h;
    for (std::size_t k = 0; k < n; ++k) {
      w.impulse[k] = kick * w.force[k];
      w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
    }
    c.velocity(t, q, w.momentum, w.displacement);
    for (T& x : w.displacement) x = length * x;
    for (int correction = 0; correction <= iterations; ++correction) {
      if (correction == 0) {
        c.values(t, q, w.residual);
        c.apply(w.displacement, w.image);
        for (std::size_t i = 0; i < w.residual.size(); ++i) w.residual[i] = w.residual[i] + w.image[i];
      } else {
        for (std::size_t k = 0; k < n; ++k) w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
        c.values(t + h, w.position, w.residual);
      }
      w.expand(c, w.residual, expansion);
      c.hidden_by_momentum_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.displacement[k] = w.displacement[k] - w.move[k];
      c.apply_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.move[k] / length;
    }
    for (std::size_t k = 0; k < n; ++k) w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
    if (const Status status = c.linearise(t + h, w.position, w.momentum); status != Status::converged)
      return status;
    p.counters().factorisations += 2;
    p.counters().fields += 2;
    w.take_diagonal(c);
    c.force(t + h, w.position, w.momentum, w.force);
    for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] + last * w.force[k];
    for (int correction = 0; correction <= iterations; ++correction) {
      for (std::size_t k = 0; k < n; ++k) w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
      c.hidden_values(t + h, w.position, w.momentum, w.residual);
      w.expand(c, w.residual, expansion);
      c.apply_transpose(w.series, w.move);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.move[k];
    }
    for (std::size_t k = 0; k < n; ++k) {
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
    return Status::converged;
  }
};

}  // namespace pfaff
