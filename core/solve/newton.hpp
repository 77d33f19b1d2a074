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
/// `iterations` their number. After forty iterations in vain rounding() gives a span of larger references,
/// what the residuals are made of, or an empty one: it is enough to converge by these from there on, since a
/// component may be smaller than what its residual rounds.
template <class T, class Residual, class Rounding>
Status newton(const LU<Value<T>>& matrix, Residual&& residual, std::span<T> x, std::span<const T> reference,
              std::span<T> r, std::span<T> correction, int limit, int& iterations, Rounding&& rounding) {
  constexpr int in_vain = 40;
  std::span<const T> larger;
  Convergence<T> convergence, rounded;
  bool ends = false, by_rounding = false;
  do {
    residual(x, r);
    matrix.solve(r.data(), correction.data());
    convergence.begin_iteration();
    if (!larger.empty()) rounded.begin_iteration();
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = x[k] - correction[k];
      convergence.add(correction[k], reference[k], x[k]);
      if (!larger.empty()) rounded.add(correction[k], larger[k], x[k]);
    }
    ends = convergence.finished(limit);
    by_rounding = !larger.empty() && rounded.finished(limit) && rounded.status() == Status::converged;
    if (!ends && convergence.iterations() == in_vain) larger = rounding();
  } while (!ends && !by_rounding);
  iterations = convergence.iterations();
  return by_rounding ? Status::converged : convergence.status();
}

}  // namespace pfaff
