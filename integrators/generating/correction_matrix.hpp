// The matrix of the corrections of w = y + P psi(w), the equation of a step y' = y + psi(w).
//
// Newton's method multiplies the residual by (I - P psi')^-1. Up to order 2, psi is h times the field at w
// and psi' is h A, A the field's Jacobian at the predicted w and the mid-time. For higher orders that would
// leave O(h^3). Where the step is the flow with Jacobian M = I + D, psi' = D (I + P D)^-1, so that Newton's
// correction is (I + P D) times the residual. M is found to order 4 from A_1 and A_2 at the two Gauss points
// of the step (Magnus' expansion, hairer-lubich-wanner2006 section IV.7):
//
//   M = e^Omega,   Omega = h/2 (A_1 + A_2) + sqrt(3)/12 h^2 (A_2 A_1 - A_1 A_2),
//   D = e^Omega - I = (I - Omega/2 + Omega^2/12)^-1 Omega + O(Omega^5),
//
// The states at the Gauss points are those of the parabola from y, along the field there, to the predicted
// y'. They miss by O(h^3), and the correction by O(h^4), by O(h^5) where the field is symmetric enough.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/linear/lu.hpp>
#include <pfaff/integrators/generating/generating_share.hpp>

namespace pfaff {

template <class P>
class CorrectionMatrix {
 public:
  using T = Scalar<P>;
  using Number = Value<T>;

  /// For n coordinates and schemes of an order above 2, or up to it; buffers are made here.
  CorrectionMatrix(std::size_t n, bool high_order)
      : high_order_(high_order),
        rate_(n),
        state_(n),
        image_(n),
        solved_(n),
        jacobian_(n * n),
        first_(n * n),
        second_(n * n),
        omega_(n * n),
        factors_(n) {}

  /// For the step of size h from y at time t, with w and the change of y as they are expected.
  Status factor(const P& p, const T& t, const T& h, const ShareMatrix<T>& share, const State<P>& y,
                const State<P>& w, const State<P>& change) {
    if (!high_order_) return factor_midpoint(p, t, h, share, w);
    p.chart_field(t, y, rate_);
    const Number offset = sqrt(Number(3)) / Number(6), middle = Number(1) / Number(2);
    for (Square<Number>* scaled : {&first_, &second_}) {
      const T theta(scaled == &first_ ? middle - offset : middle + offset);
      for (std::size_t k = 0; k < size(); ++k) {
        const T straight = h * rate_[k];
        state_[k] = y[k] + theta * (straight + theta * (change[k] - straight));
      }
      p.chart_field_jacobian(t + theta * h, state_, jacobian_);
      if (!scale(value_of(h), *scaled)) return Status::non_finite;
    }
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < size(); ++j) {
        Number commutator(0);
        for (std::size_t k = 0; k < size(); ++k)
          commutator = commutator + second_[i * size() + k] * first_[k * size() + j] -
                       first_[i * size() + k] * second_[k * size() + j];
        omega_[i * size() + j] =
            (first_[i * size() + j] + second_[i * size() + j] + offset * commutator) / Number(2);
      }
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < size(); ++j) {
        Number square(0);
        for (std::size_t k = 0; k < size(); ++k)
          square = square + omega_[i * size() + k] * omega_[k * size() + j];
        factors_(i, j) = identity(i, j) - omega_[i * size() + j] / Number(2) + square / Number(12);
      }
    return factors_.factor() ? Status::converged : Status::singular;
  }

  /// correction = (I - P psi')^-1 residual, with what factor() knows of psi'.
  void solve(const ShareMatrix<T>& share, const State<P>& residual, State<P>& correction) {
    if (!high_order_) return factors_.solve(residual.data(), correction.data());
    for (std::size_t i = 0; i < size(); ++i) {
      T sum(0);
      for (std::size_t k = 0; k < size(); ++k) sum = sum + T(omega_[i * size() + k]) * residual[k];
      image_[i] = sum;
    }
    factors_.solve(image_.data(), solved_.data());
    for (std::size_t k = 0; k < size(); ++k) correction[k] = residual[k] + share.row(k, solved_.data());
  }

 private:
  template <class X>
  using Square = Vector<X, P::extent == dynamic ? dynamic : P::extent * P::extent>;

  [[nodiscard]] std::size_t size() const { return rate_.size(); }
  static Number identity(std::size_t i, std::size_t j) { return Number(i == j ? 1 : 0); }
  // scaled = h times the Jacobian; false where that is not finite.
  bool scale(const Number& h, Square<Number>& scaled) const {
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      if (!isfinite(value_of(jacobian_[i]))) return false;
      scaled[i] = h * value_of(jacobian_[i]);
    }
    return true;
  }
  Status factor_midpoint(const P& p, const T& t, const T& h, const ShareMatrix<T>& share, const State<P>& w) {
    p.chart_field_jacobian(t + h / T(2), w, jacobian_);
    if (!scale(value_of(h), omega_)) return Status::non_finite;
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < size(); ++j) {
        Number sum(0);
        for (std::size_t k = 0; k < size(); ++k)
          if (k == i || !share.diagonal()) sum = sum + value_of(share(i, k)) * omega_[k * size() + j];
        factors_(i, j) = identity(i, j) - sum;
      }
    return factors_.factor() ? Status::converged : Status::singular;
  }

  bool high_order_;
  State<P> rate_, state_, image_, solved_;
  Square<T> jacobian_;
  Square<Number> first_, second_, omega_;  // h A_1, h A_2, Omega
  LU<Number> factors_;
};

}  // namespace pfaff
