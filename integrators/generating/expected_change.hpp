// What a step is expected to change, before it is solved: by backward differences of past steps, or by the
// Taylor series of the solution.
//
// Differences cost nothing, and reach round-off where steps are short. Where a step takes in much of the
// motion they miss by a hundredth, and each evaluation of psi spent on that costs more than the series: some
// m/2 + 3 levels of the field at one node, against ceil(m/4) (m - 1) for one psi of variant S. The series is
// made where there are no past steps, and where the differences missed the last step by more than a few
// units in the fourth digit; it is taken where its last term is smaller than that miss. Each component is
// summed as long as terms do not grow, so that beyond its radius of convergence the series is cut where it
// is best.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/generating/flow_series.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>

namespace pfaff {

template <class P>
class ExpectedChange {
 public:
  using T = Scalar<P>;
  using Number = Value<T>;
  static constexpr int differences = 8;
  /// Differences that miss by less, relative to each component, are taken without looking further.
  static constexpr double near = 1e-4;

  /// For a scheme truncated at degree m, extra degrees counted, one psi of which takes so many evaluations of
  /// the field.
  ExpectedChange(const P& p, int m, std::size_t evaluations)
      : series_pays_(2 * degree(m) <= evaluations + 2),
        series_(p, degree(m)),
        summed_(p.size()),
        past_(p.size(), differences) {}

  void forget() { past_.forget(); }
  /// change = what the step of size h from y at time t is expected to add to y. reference(k) is the size that
  /// errors of component k are measured by.
  template <class Reference>
  void expect(const P& p, const T& t, const T& h, const State<P>& y, const Reference& reference,
              State<P>& change) {
    for (std::size_t k = 0; k < summed_.size(); ++k) change[k] = past_.expected(k);
    if (past_.knows() && (!series_pays_ || missed_ <= Number(near))) return;
    series_.expand(t, h, y.data());
    p.counters().fields += static_cast<std::int64_t>(series_.degree());
    Number left(0);
    for (std::size_t k = 0; k < summed_.size(); ++k) left = std::max(left, sum(k, reference(k), summed_[k]));
    if (!past_.knows() || left < missed_) change = summed_;
  }
  /// Takes what the step has changed.
  template <class Reference>
  void remember(const State<P>& change, const Reference& reference) {
    missed_ = Number(0);
    for (std::size_t k = 0; k < summed_.size(); ++k)
      missed_ = std::max(missed_, relative_size(T(value_of(change[k]) - value_of(past_.expected(k))),
                                                T(value_of(reference(k))), T(value_of(change[k]))));
    past_.remember([&](std::size_t k) { return change[k]; });
  }

 private:
  static std::size_t degree(int m) { return (static_cast<std::size_t>(m) + 1) / 2 + 3; }
  // Sums the series of component k; returns the size of the last terms that were added.
  Number sum(std::size_t k, const T& reference, T& total) const {
    const T first = series_.term(k, 1);
    total = first;
    // Every other term may vanish, so that a term is compared with the larger of the two before it. The
    // second one is the larger at turning points; where the third is larger still, the series does not begin
    // to converge.
    Number before = std::numeric_limits<Number>::infinity(), last = abs(value_of(first));
    for (std::size_t degree = 2; degree <= series_.degree(); ++degree) {
      const T term = series_.term(k, degree);
      const Number size = abs(value_of(term));
      if (!(size <= std::max(before, last))) {
        if (degree == 3 && last > before) total = first;
        break;
      }
      total = total + term;
      before = last;
      last = size;
    }
    return relative_size(T(std::max(last, before)), T(value_of(reference)), T(value_of(total)));
  }

  bool series_pays_;
  FlowSeries<T> series_;
  State<P> summed_;
  DifferencePredictor<T, P::extent, differences> past_;
  Number missed_{0};
};

}  // namespace pfaff
