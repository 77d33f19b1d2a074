// What methods of Boost.Odeint's share: states in the containers it knows, std::array where the size is
// known, else std::vector; and runs with steps of its choosing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <boost/numeric/odeint/algebra/algebra_dispatcher.hpp>
#include <boost/numeric/odeint/algebra/default_operations.hpp>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/numbers/sum_of_two.hpp>

namespace pfaff {

template <class T, int N>
struct OdeintContainer {
  using type = std::array<T, static_cast<std::size_t>(N)>;
};
template <class T>
struct OdeintContainer<T, dynamic> {
  using type = std::vector<T>;
};
template <class P>
using ContainerOf = typename OdeintContainer<Scalar<P>, P::extent>::type;
template <class P, int Size>
using HalfOf = typename OdeintContainer<Scalar<P>, P::extent == dynamic ? dynamic : P::extent / 2>::type;

template <class C>
C sized(std::size_t n) {
  if constexpr (requires(C c) { c.resize(n); }) {
    return C(n);
  } else {
    return C{};
  }
}

/// A state from which a step is tried, with all that the step is judged by. odeint hands it on to the algebra
/// below as it is, whatever container it is.
template <class P>
struct Tried : ContainerOf<P> {
  CoordinateScales<P>* scales = nullptr;
  const Tolerance<double>* tolerance = nullptr;
  const ContainerOf<P>* reached = nullptr;  // where the step goes
  mutable double error = 0;                 // relative to what is allowed
};

/// odeint's operations, but for the one by which its controlled steppers weigh errors: that keeps the length
/// of the step alone.
struct OwnScaleOperations : boost::numeric::odeint::default_operations {
  template <class T>
  struct rel_error {  // NOLINT(readability-identifier-naming): odeint's name for it
    rel_error(T /*absolute*/, T /*relative*/, T /*of_state*/, T h) : step(h) {}
    T step;
  };
};
/// odeint's algebra of ranges, which weighs errors by the scales of the coordinates.
struct OwnScaleAlgebra : boost::numeric::odeint::range_algebra {
  using boost::numeric::odeint::range_algebra::for_each3;
  template <class Errors, class P, class Rate>
  static void for_each3(Errors& errors, const Tried<P>& from, const Rate& rate,
                        OwnScaleOperations::rel_error<double> weights) {
    from.scales->find(*from.tolerance, from, rate, weights.step, *from.reached);
    from.error = from.scales->judge(*from.tolerance, errors);
    std::fill(errors.begin(), errors.end(), from.error);
  }
};

/// What runs with steps of odeint's choosing keep in a method's workspace.
template <class P>
struct ControlledWork {
  explicit ControlledWork(const P& p)
      : from{sized<ContainerOf<P>>(p.size())},
        end(sized<ContainerOf<P>>(p.size())),
        rate(end),
        end_rate(end),
        scales(p) {}
  Tried<P> from;
  ContainerOf<P> end, rate, end_rate;
  CoordinateScales<P> scales;
  double next_step = 0;  // from one call to the next; 0 at the start of a motion
};

/// Steps from t to `end` with try_step(h), which goes from w.from with the slope w.rate to w.end, moves t by
/// h and proposes the next h, or shortens h and says false. `next_slope` fills w.rate at the end of a step.
/// not_converged where steps are rejected again and again, where a step is too small to move t, and after a
/// thousand million steps; non_finite where no step is finite.
template <class P, class TryStep, class NextSlope>
Status controlled_steps(const P& p, double& t, double end, const Tolerance<double>& tolerance, State<P>& z,
                        ControlledWork<P>& w, const TryStep& try_step, const NextSlope& next_slope) {
  if (t == end) return Status::converged;
  detail::AllowedSteps<P> steps(p);
  w.from.scales = &w.scales;
  w.from.tolerance = &tolerance;
  w.from.reached = &w.end;
  std::copy(z.begin(), z.end(), w.from.begin());
  p.field(t, w.from, w.rate);
  if (!(w.next_step > 0)) w.next_step = w.scales.first_step(p, tolerance, t, end, w.from, w.rate);
  const double direction = end < t ? -1 : 1;
  double h = direction * w.next_step;
  constexpr std::int64_t budget = 1000000000;
  std::int64_t taken = 0;
  double lost = 0;  // of the time, in rounding: the state moves by all of a step
  Status failure = Status::not_converged;
  for (int rejected = 0; direction * (end - t) > 0;) {
    if (rejected == 0 && steps.next(1) == 0) break;
    const bool clipped = direction * (t + h - end) >= 0;
    if (clipped) h = (end - t) - lost;
    const double last = h, before = t;
    if (t + last == t || taken == budget) return failure;
    if (try_step(h)) {
      const double step = last + lost;
      two_sum(before, step, t, lost);
      w.scales.keep();
      std::copy(w.end.begin(), w.end.end(), w.from.begin());
      std::copy(w.end.begin(), w.end.end(), z.begin());
      ++p.counters().steps;
      ++taken;
      rejected = 0;
      failure = Status::not_converged;
      // A step shortened to reach the end says nothing about the next one, unless it could have been longer.
      if (!clipped || std::abs(h) > w.next_step) w.next_step = std::abs(h);
      // The last step ends at `end` but for round-off.
      if (std::abs(end - t) <=
          4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(end), std::abs(last)))
        t = end;
      if (t != end) next_slope();
    } else {
      failure = std::isfinite(w.from.error) ? Status::not_converged : Status::non_finite;
      if (++rejected > 100 || !(std::abs(h) > 1e-14 * std::abs(t))) return failure;
      if (rejected < rejections_in_doubt) w.scales.find_noise(p, t, w.from, w.rate);
    }
  }
  return Status::converged;
}

}  // namespace pfaff
