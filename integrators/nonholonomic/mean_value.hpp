// Mean values along the straight line from the start of a step to its end,
//
//   int_0^1 f(z0 + s D) ds = sum_i b_i f(z0 + c_i D)      (Gauss's rule)
//
// Of a gradient this is the mean-value discrete gradient, with which an averaged vector field is made
// (quispel-mclaren2008 (4)). grad_bar H . D = H(z1) - H(z0) holds exactly where the rule integrates the
// derivative of H along the line: with n nodes for polynomials of degree 2 n or less. For other energies it
// holds to the error of the rule, which is of order |D|^(2 n + 1).
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/polynomial_degree.hpp>

namespace pfaff {

/// The nodes of a mean value in numbers of a step; none where no mean values are taken.
template <class T>
struct MeanValue {
  std::vector<T> places, weights;

  explicit MeanValue(int nodes) {
    if (nodes == 0) return;
    for (const QuadratureNode& node : gauss_legendre(nodes)) {
      places.push_back(T(node.place));
      weights.push_back(T(node.weight));
    }
  }
  /// Sets `mean` to that of f from `start` to start + change. `point` is a buffer, of which f may read more
  /// than the part that is moved; f(point, out) fills `value`, another buffer.
  template <class Start, class F>
  void operator()(const Start& start, const std::vector<T>& change, std::vector<T>& point,
                  std::vector<T>& value, Out<T> mean, const F& f) const {
    for (T& x : mean) x = T(0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < change.size(); ++k) point[k] = start(k) + places[i] * change[k];
      f(point.data(), value.data());
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = mean[k] + weights[i] * value[k];
    }
  }
};

/// The tape (t, z) -> gradient of a formula with one output.
inline std::shared_ptr<const Tape> gradient_tape(const Tape& formula) {
  return std::make_shared<const Tape>(
      record(formula.inputs, formula.inputs, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const std::vector<Recorded> slopes = gradient(formula, t, z, std::vector<Recorded>{Recorded(1)});
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = slopes[k];
      }));
}

/// True where the mean value of the gradient of every output of the formula, with so many nodes, times the
/// change along a line is exactly the change of that output.
inline bool mean_value_is_exact(const Tape& formula, int nodes) {
  const auto degree = polynomial_degree(formula);
  return degree && *degree <= 2 * nodes;
}

}  // namespace pfaff
