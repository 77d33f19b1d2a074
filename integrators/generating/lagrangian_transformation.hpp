// An author's transformation alpha of pairs of states, and the check that it is one that generating functions
// may be built on (su-qin (32)-(34)).
//
//   struct MyAlpha {
//     template <class T>
//     void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const;
//   };
//
// It may be nonlinear and depend on both times. It is recorded (core/facets/generating_map.hpp) and
// differentiated, and
//
//   alpha_*^T J alpha_* = diag(K(z', t), -K(z, t0))                                                   (34)
//
// is evaluated at given points. A right side with another constant factor carries Lagrangian submanifolds to
// Lagrangian ones as well, which is why (34) is sufficient and not necessary. Everything else here assumes
// the factor 1, so that another factor is reported together with what to divide w^ by.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/generating_map.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating/fractional_transformation.hpp>

namespace pfaff {

/// alpha with its Jacobian and its derivative in t, for one scalar. Owns its buffers.
template <class T>
class LagrangianTransformation {
 public:
  /// `alpha`: a tape that record_alpha made.
  explicit LagrangianTransformation(const std::shared_ptr<const Tape>& alpha)
      : n_(static_cast<std::size_t>(alpha->inputs) / 2),
        value_(alpha),
        jacobian_(std::make_shared<const Tape>(jacobian_tape(*alpha))),
        rate_(std::make_shared<const Tape>(
            record(alpha->inputs, alpha->inputs - 1,
                   [&](const Recorded& t, std::span<const Recorded> x, std::span<Recorded> out) {
                     const auto rate = pfaff::time_derivative(*alpha, t, x);
                     for (std::size_t k = 0; k < rate.size(); ++k) out[k] = rate[k];
                   }))),
        arguments_(2 * n_ + 1) {}

  [[nodiscard]] std::size_t size() const { return n_; }

  /// (w^, w), 2n numbers.
  std::vector<T> operator()(const T& t, const T& t0, In<T> new_z, In<T> old_z) {
    return run(value_, 2 * n_, t, t0, new_z, old_z);
  }
  /// The blocks of alpha_*.
  FractionalTransformation<T> blocks(const T& t, const T& t0, In<T> new_z, In<T> old_z) {
    const Matrix<T> all(2 * n_, run(jacobian_, 2 * n_ * (2 * n_ + 1), t, t0, new_z, old_z));
    return FractionalTransformation<T>::of(all.block(0, 0, 2 * n_, 2 * n_));
  }
  /// (d w^/dt, d w/dt) at fixed z', z and t0.
  std::vector<T> time_derivative(const T& t, const T& t0, In<T> new_z, In<T> old_z) {
    return run(rate_, 2 * n_, t, t0, new_z, old_z);
  }

 private:
  std::vector<T> run(Replay<T>& replay, std::size_t outputs, const T& t, const T& t0, In<T> new_z,
                     In<T> old_z) {
    for (std::size_t k = 0; k < n_; ++k) {
      arguments_[k] = new_z[k];
      arguments_[n_ + k] = old_z[k];
    }
    arguments_[2 * n_] = t0;
    std::vector<T> results(outputs);
    replay(t, arguments_.data(), results.data());
    return results;
  }

  std::size_t n_;
  Replay<T> value_, jacobian_, rate_;
  std::vector<T> arguments_;
};

/// A point at which (34) is evaluated: two times and two states.
template <class T>
struct StatePair {
  T t, t0;
  std::vector<T> new_z, old_z;
};

/// The result of check_lagrangian.
struct LagrangianCheck {
  bool holds = false;   // with factor 1, at every point
  double residual = 0;  // largest |alpha_*^T J alpha_* - diag(K, -K0)| over the size of its terms
  double factor = 1;    // c, where alpha_*^T J alpha_* = c diag(K, -K0) at every point
  std::string message;  // what is wrong and what would mend it; empty where it holds
};

/// Evaluates (34) for a recorded alpha and a structure K(z, t) (n -> n x n) at the points, at least one. The
/// tolerance is for residuals relative to the terms of the products; the default is what rounding leaves of
/// them. Instantiated for double and Quad.
template <class T>
LagrangianCheck check_lagrangian(const std::shared_ptr<const Tape>& alpha,
                                 const std::shared_ptr<const Tape>& structure,
                                 const std::vector<StatePair<T>>& points, double tolerance = 0);

}  // namespace pfaff
