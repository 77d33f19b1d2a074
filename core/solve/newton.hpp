// Simplified Newton iteration to round-off, with a status.
#pragma once

#include <span>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace pfaff {

/// Solves residual(x) = 0 with corrections -matrix^-1 residual, the matrix being an approximate Jacobian that
/// is factored already. T may be a dual over the matrix's numbers: derivatives converge with the values.
/// `residual(x, r)` fills r. The correction of a component is judged by the larger of its `reference` and its
/// own size (Convergence). `correction` and `r` are buffers of x's size. On return x is the last iterate and
/// `iterations` their number. `rounding`, where it is not empty, has larger references, what the residuals
/// are made of: after forty iterations in vain it is enough to have converged by these, since a component
/// may be smaller than what its residual rounds.
template <class T, class Residual>
Status newton(const LU<Value<T>>& matrix, Residual&& residual, std::span<T> x, std::span<const T> reference,
              std::span<T> r, std::span<T> correction, int limit, int& iterations,
              std::span<const T> rounding = {}) {
  constexpr int in_vain = 40;
  Convergence<T> convergence, rounded;
  bool ends = false, by_rounding = false;
  do {
    residual(x, r);
    matrix.solve(r.data(), correction.data());
    convergence.begin_iteration();
    rounded.begin_iteration();
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = x[k] - correction[k];
      convergence.add(correction[k], reference[k], x[k]);
      if (!rounding.empty()) rounded.add(correction[k], rounding[k], x[k]);
    }
    ends = convergence.finished(limit);
    if (!rounding.empty() && rounded.finished(limit))
      by_rounding = rounded.status() == Status::converged && rounded.iterations() >= in_vain;
  } while (!ends && !by_rounding);
  iterations = convergence.iterations();
  return by_rounding ? Status::converged : convergence.status();
}

}  // namespace pfaff
