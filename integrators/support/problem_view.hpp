// A problem as a method sees it that steps something else than the problem's own field.
//
// Some methods are another method run on a changed problem: in other coordinates (in_chart.hpp), or without
// its friction (conformal_splitting.hpp). Such a view has the size, the scalar and the counters of the
// problem and offers formulas of its own in place of the problem's.
#pragma once

#include <cstddef>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

/// What every view of the problem P shares; it offers no formula itself. Refers to P.
template <class P>
class ProblemView {
 public:
  using Scalar = pfaff::Scalar<P>;
  using State = pfaff::State<P>;
  static constexpr int extent = P::extent;

  explicit ProblemView(const P& problem) : problem_(problem) {}

  [[nodiscard]] std::size_t size() const { return problem_.size(); }
  [[nodiscard]] State make_state() const { return problem_.make_state(); }
  [[nodiscard]] decltype(auto) counters() const { return problem_.counters(); }

 protected:
  [[nodiscard]] const P& problem() const { return problem_; }

 private:
  const P& problem_;
};

}  // namespace pfaff
