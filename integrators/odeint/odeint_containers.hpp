// What methods of Boost.Odeint's share: states in the containers it knows, std::array where the size is
// known, else std::vector; and runs with steps of its choosing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <pfaff/core/integrator.hpp>

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

/// Steps from t to `end` with try_step(h), which moves t by h and proposes the next h, or shortens h and says
/// false. `next_step` > 0 is the size to begin with, and is left for the next call. not_converged where steps
/// are rejected again and again, where a step is too small to move t, and after a thousand million steps.
template <class P, class TryStep>
Status controlled_steps(const P& p, double& t, double end, double& next_step, const TryStep& try_step) {
  const double direction = end < t ? -1 : 1;
  double h = direction * next_step;
  constexpr std::int64_t budget = 1000000000;
  std::int64_t taken = 0;
  detail::AllowedSteps<P> steps(p);
  for (int rejected = 0; direction * (end - t) > 0;) {
    if (rejected == 0 && steps.next(1) == 0) break;
    const bool clipped = direction * (t + h - end) >= 0;
    if (clipped) h = end - t;
    const double last = h;
    if (t + last == t || taken == budget) return Status::not_converged;
    if (try_step(h)) {
      ++p.counters().steps;
      ++taken;
      rejected = 0;
      // A step shortened to reach the end says nothing about the next one, unless it could have been longer.
      if (!clipped || std::abs(h) > next_step) next_step = std::abs(h);
      // The last step ends at `end` but for round-off.
      if (std::abs(end - t) <=
          4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(end), std::abs(last)))
        t = end;
    } else if (++rejected > 100 || !(std::abs(h) > 1e-14 * std::abs(t))) {
      return Status::not_converged;
    }
  }
  return Status::converged;
}

}  // namespace pfaff
