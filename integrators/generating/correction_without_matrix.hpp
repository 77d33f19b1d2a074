// Corrections of w = y + P psi(w), the equation of a step y' = y + psi(w), without a matrix: for systems of
// so many coordinates that factoring one (correction_matrix.hpp) would cost more than evaluating the field.
//
// They solve (I - h P Y_y) correction = residual, Y the field in the chart, by a few iterations of
// correction = residual + h P (Y(w + correction) - Y(w)). This takes h Y_y for the Jacobian of psi, which is
// wrong by O(h^3).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/generating/generating_share.hpp>

namespace pfaff {

template <class P>
class CorrectionWithoutMatrix {
 public:
  using T = Scalar<P>;
  using Number = Value<T>;

  /// For n coordinates; buffers are made here.
  explicit CorrectionWithoutMatrix(std::size_t n) : moved_(n), rate_(n), start_(n) {}

  /// Finds the correction of w in the step of size h at time t. Component k is judged by the larger of
  /// reference(k) and of its part of psi.
  template <class Reference>
  void solve(const P& p, const T& t, const T& h, const ShareMatrix<T>& share, const State<P>& w,
             const State<P>& residual, const Reference& reference, const State<P>& psi,
             State<P>& correction) {
    const T middle = t + h / T(2);
    p.chart_field(middle, w, start_);
    correction = residual;
    Number last = std::numeric_limits<Number>::infinity();
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      for (std::size_t k = 0; k < w.size(); ++k) moved_[k] = w[k] + correction[k];
      p.chart_field(middle, moved_, rate_);
      for (std::size_t k = 0; k < w.size(); ++k) moved_[k] = rate_[k] - start_[k];
      Number change(0), size(0);
      for (std::size_t k = 0; k < w.size(); ++k) {
        const T next = residual[k] + h * share.row(k, moved_.data()), against = reference(k);
        change = std::max(change, relative_size(T(next - correction[k]), against, psi[k]));
        size = std::max(size, relative_size(next, against, psi[k]));
        correction[k] = next;
      }
      // Enough where the correction is more accurate than the next evaluation of psi can tell, or where it no
      // longer improves because the differences of the field are down to round-off.
      if (!(change > Number(1e-3) * size) || !(change < last)) return;
      last = change;
    }
  }

 private:
  static constexpr int most_iterations = 12;
  State<P> moved_, rate_, start_;
};

}  // namespace pfaff
