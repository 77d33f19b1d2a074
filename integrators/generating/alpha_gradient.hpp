// The gradient of a truncated generating function, psi(w) = sum_{k <= m} tau^k phi_w^(k)(w), in the system's
// own coordinates z, for any transformation alpha: (z', z) -> (w^, w) and any order m. No chart is needed.
//
// As in generating_gradient.hpp, tau^k phi_w^(k)(w) is the degree-k part in tau of w^ = alpha_1(z', z, t0 +
// tau, t0) along the Gauss collocation of s = ceil(m/2) stages with w = alpha_2(z', z, t0 + tau, t0) held
// fixed: the collocation agrees with the flow up to tau^{2s} in any coordinates. Here the old state is
// itself an unknown series z = z_0 + tau z_1 + ..:
//
//   degree 0:      alpha_2(z_0, z_0, t0, t0) = w, by Newton's iteration to round-off
//   degree l + 1:  (z' - z)_{l+1} = sum_j b_j X_{j,l},  (Z_i - z)_{l+1} = sum_j a_ij X_{j,l}, and
//                  (C + D) z_{l+1} = -[alpha_2]_{l+1} with z_{l+1} = 0 in it, C + D at (z_0, z_0, t0, t0)
//
// with one factorisation of C + D for a psi. The series of alpha_1 is that of psi. Its term of degree 0
// vanishes for every alpha that takes equal states at equal times to w^ = 0, and is kept for the others
// (su-qin (79)-(82)). Regularity of C + D is the transversality condition (37) of the identity.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/series.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace pfaff {

/// psi for any scalar from the tapes of the field (n -> n) and of alpha (generating_map.hpp). Owns its
/// buffers.
template <class T>
class AlphaGradient {
 public:
  /// Truncated at degree `order`, at least 1, with the coefficients of ceil(order/2) stages.
  AlphaGradient(std::shared_ptr<const Tape> field, const std::shared_ptr<const Tape>& alpha, int order,
                const GaussCoefficients& gauss)
      : n_(static_cast<std::size_t>(field->inputs)),
        lanes_(static_cast<std::size_t>(gauss.stages)),
        levels_(static_cast<std::size_t>(order)),
        field_(std::move(field), order, gauss.stages),
        alpha_(alpha, order + 1, 1),
        start_(alpha),
        start_jacobian_(std::make_shared<const Tape>(jacobian_tape(*alpha))),
        diagonal_(n_),
        nodes_(numbers(gauss.nodes)),
        weights_(numbers(gauss.weights)),
        matrix_(numbers(gauss.matrix)),
        pair_(2 * n_ + 1),
        values_(2 * n_),
        jacobian_(2 * n_ * (2 * n_ + 1)),
        base_(lanes_),
        rate_(lanes_),
        stages_(n_ * lanes_),
        z_(n_),
        scale_(n_),
        residual_(n_),
        correction_(n_),
        tau_(0) {}

  [[nodiscard]] std::size_t size() const { return n_; }
  /// Field evaluations that one psi amounts to: nodes times levels of the series.
  [[nodiscard]] std::size_t evaluations() const { return lanes_ * levels_; }
  [[nodiscard]] std::size_t term_count() const { return levels_ + 1; }

  /// Sets the step; what depends on time alone is expanded here, once per step.
  void set_step(const T& t, const T& tau) {
    t0_ = t;
    tau_ = tau;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      base_[lane] = t;
      rate_[lane] = tau * nodes_[lane];
    }
    field_.set_time(base_.data(), rate_.data());
    alpha_.set_time(&t0_, &tau_);
  }

  /// Starts the search for z_0 from `z`, a state whose alpha_2(z, z, t0, t0) is near the next w. `scale` is a
  /// state of the size that each component has over the step. The search ends when corrections are at
  /// round-off in units of it, because z_0 itself may pass through 0.
  void search_from(In<T> z, In<T> scale) {
    std::copy(z.begin(), z.end(), z_.begin());
    std::copy(scale.begin(), scale.end(), scale_.begin());
  }

  /// psi(w): n numbers, where the status is `converged`.
  Status operator()(const T* w, T* psi) {
    for (std::size_t k = 0; k < n_; ++k) psi[k] = T(0);
    return expand(w, [&](std::size_t k, std::size_t /*degree*/, const T& term) { psi[k] = psi[k] + term; });
  }
  /// The terms tau^k phi_w^(k) one by one: terms[degree * n + component], term_count() degrees from 0.
  Status terms(const T* w, T* terms) {
    return expand(w,
                  [&](std::size_t k, std::size_t degree, const T& term) { terms[degree * n_ + k] = term; });
  }

 private:
  static std::vector<T> numbers(const std::vector<Quad>& exact) {
    std::vector<T> rounded;
    for (const Quad& x : exact) rounded.push_back(T(Real(x)));
    return rounded;
  }

  template <class Take>
  Status expand(const T* w, Take&& take) {
    if (const Status status = find_start(w); status != Status::converged) return status;
    for (std::size_t k = 0; k < n_; ++k) {
      pair_[k] = pair_[n_ + k] = z_[k];
      for (std::size_t lane = 0; lane < lanes_; ++lane) stages_[k * lanes_ + lane] = z_[k];
    }
    pair_[2 * n_] = t0_;
    alpha_.set_input(0, pair_.data());
    alpha_.advance(0);
    pair_[2 * n_] = T(0);
    for (std::size_t k = 0; k < n_; ++k) take(k, 0, *alpha_.output(k, 0));
    for (std::size_t level = 0; level < levels_; ++level) {
      field_.set_input(level, stages_.data());
      field_.advance(level);
      extend(level + 1);
      for (std::size_t k = 0; k < n_; ++k) take(k, level + 1, *alpha_.output(k, level + 1));
    }
    return Status::converged;
  }

  // Degree `level` of alpha, of the old state and of the stages, from degree level - 1 of the field.
  void extend(std::size_t level) {
    for (std::size_t k = 0; k < n_; ++k) {
      const T* x = field_.output(k, level - 1);
      pair_[k] = tau_ * combined(weights_.data(), x);
      pair_[n_ + k] = T(0);
    }
    alpha_.set_input(level, pair_.data());
    alpha_.advance(level);
    for (std::size_t k = 0; k < n_; ++k) residual_[k] = -*alpha_.output(n_ + k, level);
    diagonal_.solve(residual_.data(), correction_.data());
    for (std::size_t k = 0; k < n_; ++k) {
      pair_[k] = pair_[k] + correction_[k];
      pair_[n_ + k] = correction_[k];
      const T* x = field_.output(k, level - 1);
      for (std::size_t i = 0; i < lanes_; ++i)
        stages_[k * lanes_ + i] = tau_ * combined(&matrix_[i * lanes_], x) + correction_[k];
    }
    alpha_.set_input(level, pair_.data());
    alpha_.advance(level);
  }
  T combined(const T* weights, const T* x) const {
    T sum = weights[0] * x[0];
    for (std::size_t j = 1; j < lanes_; ++j) sum = sum + weights[j] * x[j];
    return sum;
  }

  // Solves alpha_2(z, z, t0, t0) = w, beginning at the z_0 of the last psi, and leaves C + D at the solution
  // factored.
  Status find_start(const T* w) {
    pair_[2 * n_] = t0_;
    Convergence<T> convergence;
    do {
      if (!factor()) return Status::singular;
      start_(t0_, pair_.data(), values_.data());
      for (std::size_t k = 0; k < n_; ++k) residual_[k] = w[k] - values_[n_ + k];
      diagonal_.solve(residual_.data(), correction_.data());
      convergence.begin_iteration();
      for (std::size_t k = 0; k < n_; ++k) {
        z_[k] = z_[k] + correction_[k];
        convergence.add(correction_[k], scale_[k], z_[k]);
      }
    } while (!convergence.finished(50));
    if (convergence.status() != Status::converged) return convergence.status();
    return factor() ? Status::converged : Status::singular;
  }
  bool factor() {
    for (std::size_t k = 0; k < n_; ++k) pair_[k] = pair_[n_ + k] = z_[k];
    start_jacobian_(t0_, pair_.data(), jacobian_.data());
    const std::size_t width = 2 * n_ + 1;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        diagonal_(i, j) = jacobian_[(n_ + i) * width + j] + jacobian_[(n_ + i) * width + n_ + j];
    return diagonal_.factor();
  }

  std::size_t n_, lanes_, levels_;
  SeriesReplay<T> field_, alpha_;
  Replay<T> start_, start_jacobian_;
  LU<T> diagonal_;  // C + D at equal states and times
  std::vector<T> nodes_, weights_, matrix_;
  std::vector<T> pair_;               // (z', z, t0), or one degree of it
  std::vector<T> values_, jacobian_;  // of alpha at equal states
  std::vector<T> base_, rate_;        // times of the nodes
  std::vector<T> stages_;             // one degree of the stages
  std::vector<T> z_, scale_;          // z_0, and what it is compared with
  std::vector<T> residual_, correction_;
  T t0_{0}, tau_;
};

}  // namespace pfaff
