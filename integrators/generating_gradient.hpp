// The gradient of a truncated generating function, psi(w) = sum_{k <= m} tau^k phi_w^(k)(w), in Darboux
// coordinates, for any order m, from one truncated Taylor series of the field at s = ceil(m/2) nodes.
//
// tau^k phi_w^(k)(w) is the degree-k part in tau of the s-stage Gauss collocation solution taken at fixed
// w = P y' + (I - P) y, because the collocation agrees with the flow up to tau^{2s} in any coordinates; and
// level l + 1 of its stages needs only level l of the field, so the implicit collocation is one explicit
// pass. In these coordinates psi = y' - y; the paper's (R^, P^) of su-qin (95) is (psi_p, psi_q) at w = (R,
// -P).
//
// Variant P expands at t0 (su-qin (79)-(88)), any m; variant S at the mid-time t0 + tau/2, even m, P = I/2:
// the stages mirror each other under tau -> -tau, so half of them are kept and only odd degrees of psi
// remain.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/tape/series.hpp>
#include <pfaff/integrators/gauss_coefficients.hpp>

namespace pfaff {

/// Which mix of old and new coordinates the generating function takes: w = P y' + (I - P) y with P = I/2
/// (Poincare's midpoint form), diag(I, 0) (new q with old p) or diag(0, I) (old q with new p).
enum class GeneratingForm { midpoint, new_q_old_p, old_q_new_p };

template <class T>
class GeneratingGradient {
 public:
  /// Of order `order` for the field in `chart_field` (n -> n), expanded at the mid-time when `symmetric`.
  GeneratingGradient(std::shared_ptr<const Tape> chart_field, int order, bool symmetric, GeneratingForm form,
                     const GaussCoefficients& gauss)
      : symmetric_(symmetric),
        n_(static_cast<std::size_t>(chart_field->inputs)),
        s_(static_cast<std::size_t>(gauss.stages)),
        lanes_(symmetric ? (s_ + 1) / 2 : s_),
        levels_(static_cast<std::size_t>(symmetric ? order - 1 : order)),
        series_(std::move(chart_field), static_cast<int>(levels_), static_cast<int>(lanes_)),
        share_(n_),
        input_(n_ * lanes_),
        base_(lanes_),
        rate_(lanes_),
        t_(0),
        tau_(0) {
    for (std::size_t k = 0; k < n_; ++k) {
      const bool is_q = k < n_ / 2;
      share_[k] = form == GeneratingForm::midpoint                ? T(Real::fraction(1, 2))
                  : (form == GeneratingForm::new_q_old_p) == is_q ? T(1)
                                                                  : T(0);
    }
    fold(gauss);
  }

  /// P_k: the weight of the new coordinate k in w.
  [[nodiscard]] const T& share(std::size_t k) const { return share_[k]; }
  [[nodiscard]] std::size_t size() const { return n_; }
  /// Field evaluations that one psi amounts to: nodes times levels of the series.
  [[nodiscard]] std::size_t evaluations() const { return lanes_ * levels_; }

  /// Sets the step; what depends on time alone is expanded here, once per step.
  void set_step(const T& t, const T& tau) {
    t_ = t;
    tau_ = tau;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      base_[lane] = symmetric_ ? t + tau / T(2) : t;
      rate_[lane] = tau * node_[lane];
    }
    series_.set_time(base_.data(), rate_.data());
  }

  /// psi(w): n numbers.
  void operator()(const T* w, T* psi) {
    for (std::size_t k = 0; k < n_; ++k) psi[k] = T(0);
    expand(w, [&](std::size_t k, std::size_t /*degree*/, const T& term) { psi[k] = psi[k] + term; });
  }

  /// The terms tau^k phi_w^(k) one by one: terms[degree * n + component], degrees 0 .. order.
  void terms(const T* w, T* terms) {
    for (std::size_t k = 0; k < n_ * (levels_ + 2); ++k) terms[k] = T(0);
    expand(w, [&](std::size_t k, std::size_t degree, const T& term) { terms[degree * n_ + k] = term; });
  }
  [[nodiscard]] std::size_t term_count() const { return levels_ + 2; }

 private:
  // Coefficients for the lanes kept. With a~_ij = a_ij - b_j/2 and mirrored stages X_j'(-s) = X_j(s), lane j
  // stands for j and j': a~_ij + a~_ij' acts on even levels, a~_ij - a~_ij' on odd ones; the centre node
  // counts once.
  void fold(const GaussCoefficients& g) {
    const std::size_t first = s_ - lanes_;
    for (std::size_t i = first; i < s_; ++i) {
      node_.push_back(T(Real(symmetric_ ? g.nodes[i] - Quad(1) / Quad(2) : g.nodes[i])));
      const bool centre = s_ - 1 - i == i;
      weight_.push_back(T(Real(symmetric_ && !centre ? g.weights[i] + g.weights[s_ - 1 - i] : g.weights[i])));
      for (std::size_t j = first; j < s_; ++j) {
        if (!symmetric_) {
          even_.push_back(T(Real(g.matrix[i * s_ + j])));
          odd_.push_back(even_.back());
          continue;
        }
        const std::size_t mirror = s_ - 1 - j;
        const Quad half = Quad(1) / Quad(2);
        const Quad a = g.matrix[i * s_ + j] - g.weights[j] * half;
        const Quad b = mirror == j ? Quad(0) : g.matrix[i * s_ + mirror] - g.weights[mirror] * half;
        even_.push_back(T(Real(a + b)));
        odd_.push_back(T(Real(a - b)));
      }
    }
  }

  template <class Take>
  void expand(const T* w, Take&& take) {
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t lane = 0; lane < lanes_; ++lane) input_[k * lanes_ + lane] = w[k];
    for (std::size_t level = 0; level < levels_; ++level) {
      series_.set_input(level, input_.data());
      series_.advance(level);
      const bool even = level % 2 == 0;
      const std::vector<T>& matrix = even ? even_ : odd_;
      for (std::size_t k = 0; k < n_; ++k) {
        const T* x = series_.output(k, level);
        T term(0);
        if (!symmetric_ || even) {
          for (std::size_t j = 0; j < lanes_; ++j) term = term + weight_[j] * x[j];
          term = tau_ * term;
          take(k, level + 1, term);
        }
        if (level + 1 == levels_) continue;
        for (std::size_t i = 0; i < lanes_; ++i) {
          T sum(0);
          for (std::size_t j = 0; j < lanes_; ++j) sum = sum + matrix[i * lanes_ + j] * x[j];
          input_[k * lanes_ + i] = symmetric_ ? tau_ * sum : tau_ * sum - share_[k] * term;
        }
      }
    }
  }

  bool symmetric_;
  std::size_t n_, s_, lanes_, levels_;
  SeriesReplay<T> series_;
  std::vector<T> share_, node_, weight_, even_, odd_;
  std::vector<T> input_, base_, rate_;
  T t_, tau_;
};

}  // namespace pfaff
