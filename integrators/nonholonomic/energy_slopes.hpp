// The slopes of an energy H(q, p, t): the velocity v = H_p and the force f = -H_q, without reactions of
// constraints.
//
// Where H = T(p, t) + V(q, t) the two are formulas of their own, in double the author's code, and each is
// evaluated by itself. Any other H has one formula for both.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

template <class T>
class EnergySlopes {
 public:
  explicit EnergySlopes(const std::shared_ptr<const Model>& model)
      : separable_(model->separable_energy()),
        n_(static_cast<std::size_t>(model->dimension()) / 2),
        state_(2 * n_),
        slopes_(2 * n_) {
    if (separable_) {
      force_ = make_evaluator<T>(model, Formula::force);
      velocity_ = make_evaluator<T>(model, Formula::velocity);
    } else {
      gradient_ = make_evaluator<T>(model, Formula::hamiltonian_gradient);
    }
  }

  /// True where the velocity depends on p alone and the force on q and t alone.
  [[nodiscard]] bool separable() const { return separable_; }

  /// v = H_p and f = -H_q at (q, p, t).
  void operator()(const T& t, In<T> q, In<T> p, Out<T> v, Out<T> f) {
    if (separable_) {
      velocity(t, p, v);
      force(t, q, f);
      return;
    }
    for (std::size_t k = 0; k < n_; ++k) {
      state_[k] = q[k];
      state_[n_ + k] = p[k];
    }
    gradient_.call(gradient_.context, t, state_.data(), slopes_.data());
    for (std::size_t k = 0; k < n_; ++k) {
      f[k] = -slopes_[k];
      v[k] = slopes_[n_ + k];
    }
  }
  /// One of them, of a separable energy.
  void velocity(const T& t, In<T> p, Out<T> v) const {
    velocity_.call(velocity_.context, t, p.data(), v.data());
  }
  void force(const T& t, In<T> q, Out<T> f) const { force_.call(force_.context, t, q.data(), f.data()); }

 private:
  bool separable_;
  std::size_t n_;
  Evaluator<T> force_, velocity_, gradient_;
  std::vector<T> state_, slopes_;
};

}  // namespace pfaff
