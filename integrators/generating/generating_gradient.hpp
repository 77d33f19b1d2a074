// The gradient of a truncated generating function, psi(w) = sum_{k <= m} tau^k phi_w^(k)(w), in Darboux
// coordinates, for any order m, from one truncated Taylor series of the field at s = ceil(m/2) nodes.
//
// tau^k phi_w^(k)(w) is the degree-k part in tau of the s-stage Gauss collocation solution taken at fixed
// w = P y' + (I - P) y, because the collocation agrees with the flow up to tau^{2s} in any coordinates; and
// level l + 1 of its stages needs only level l of the field, so the implicit collocation is one explicit
// pass. In these coordinates psi = y' - y; the paper's (R^, P^) of su-qin (95) is (psi_p, psi_q) at w = (R,
// -P).
//
// Variant P expands at t0 (su-qin (79)-(88)), any m; variant S at the mid-time t0 + tau/2, even m, P = I/2
// (generating_nodes.hpp). The same nodes also give degrees beyond m (`extra`). These terms are not those of
// the flow, but with them psi is still a gradient in Darboux coordinates, and closer to the flow's.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/tape/series.hpp>
#include <pfaff/integrators/generating/generating_nodes.hpp>
#include <pfaff/integrators/generating/generating_share.hpp>

namespace pfaff {

/// psi for any scalar, any size and any share P, from the tape of the field.
template <class T>
class GeneratingGradient {
 public:
  /// Truncated at degree `order` (+ `extra`) for the field in `chart_field` (n -> n), expanded at the
  /// mid-time when `symmetric`, which needs the midpoint form.
  GeneratingGradient(std::shared_ptr<const Tape> chart_field, int order, bool symmetric,
                     const GeneratingShare& share, const GaussCoefficients& gauss, int extra = 0)
      : nodes_(order, symmetric, extra, gauss),
        n_(static_cast<std::size_t>(chart_field->inputs)),
        series_(std::move(chart_field), static_cast<int>(nodes_.levels), static_cast<int>(nodes_.lanes)),
        share_(share, n_),
        node_(numbers(nodes_.node)),
        weight_(numbers(nodes_.weight)),
        even_(numbers(nodes_.even)),
        odd_(numbers(nodes_.odd)),
        term_(n_),
        input_(n_ * nodes_.lanes),
        base_(nodes_.lanes),
        rate_(nodes_.lanes),
        tau_(0) {}

  [[nodiscard]] std::size_t size() const { return n_; }
  /// Field evaluations that one psi amounts to: nodes times levels of the series.
  [[nodiscard]] std::size_t evaluations() const { return nodes_.evaluations(); }

  /// Sets the step; what depends on time alone is expanded here, once per step.
  void set_step(const T& t, const T& tau) {
    tau_ = tau;
    for (std::size_t lane = 0; lane < nodes_.lanes; ++lane) {
      base_[lane] = nodes_.symmetric ? t + tau / T(2) : t;
      rate_[lane] = tau * node_[lane];
    }
    series_.set_time(base_.data(), rate_.data());
  }

  /// psi(w): n numbers.
  void operator()(const T* w, T* psi) {
    for (std::size_t k = 0; k < n_; ++k) psi[k] = T(0);
    expand(w, [&](std::size_t k, std::size_t /*degree*/, const T& term) { psi[k] = psi[k] + term; });
  }

  /// The terms tau^k phi_w^(k) one by one: terms[degree * n + component], term_count() degrees from 0.
  void terms(const T* w, T* terms) {
    for (std::size_t k = 0; k < n_ * term_count(); ++k) terms[k] = T(0);
    expand(w, [&](std::size_t k, std::size_t degree, const T& term) { terms[degree * n_ + k] = term; });
  }
  [[nodiscard]] std::size_t term_count() const { return nodes_.levels + 2; }

 private:
  static std::vector<T> numbers(const std::vector<Quad>& exact) {
    std::vector<T> rounded;
    for (const Quad& x : exact) rounded.push_back(T(Real(x)));
    return rounded;
  }

  template <class Take>
  void expand(const T* w, Take&& take) {
    const std::size_t lanes = nodes_.lanes;
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane) input_[k * lanes + lane] = w[k];
    for (std::size_t level = 0; level < nodes_.levels; ++level) {
      series_.set_input(level, input_.data());
      series_.advance(level);
      if (nodes_.counts(level))
        for (std::size_t k = 0; k < n_; ++k) {
          const T* x = series_.output(k, level);
          term_[k] = weight_[0] * x[0];
          for (std::size_t j = 1; j < lanes; ++j) term_[k] = term_[k] + weight_[j] * x[j];
          term_[k] = tau_ * term_[k];
          take(k, level + 1, term_[k]);
        }
      if (level + 1 < nodes_.levels) next_stages(level);
    }
  }
  void next_stages(std::size_t level) {
    const std::size_t lanes = nodes_.lanes;
    const std::vector<T>& matrix = level % 2 == 0 ? even_ : odd_;
    for (std::size_t k = 0; k < n_; ++k) {
      const T* x = series_.output(k, level);
      // Variant P measures stages from w, which moves by P psi; in variant S that is folded into the
      // matrices.
      const T moved = nodes_.symmetric ? T(0) : share_.row(k, term_.data());
      for (std::size_t i = 0; i < lanes; ++i) {
        T sum = matrix[i * lanes] * x[0];
        for (std::size_t j = 1; j < lanes; ++j) sum = sum + matrix[i * lanes + j] * x[j];
        input_[k * lanes + i] = nodes_.symmetric ? tau_ * sum : tau_ * sum - moved;
      }
    }
  }

  GeneratingNodes nodes_;
  std::size_t n_;
  SeriesReplay<T> series_;
  ShareMatrix<T> share_;
  std::vector<T> node_, weight_, even_, odd_;
  std::vector<T> term_, input_, base_, rate_;
  T tau_;
};

}  // namespace pfaff
