// Convergence where terms of a rate cancel, as at rest: a component may be smaller than what they round.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/solve/convergence.hpp>

namespace pfaff {

/// What corrections of a component are measured against: x, and what the rate rounds that is added to it.
/// Where a motion comes to rest terms of a rate cancel that are large beside a momentum of nearly zero, and
/// each of them, about |dX/dz_j z_j|, is rounded. `slopes` are those of the rate at the `count` numbers of z,
/// h the step. Derivatives are measured by those of x.
template <class T>
T beside_rounding(const T& x, const T& h, const T* slopes, const T* z, std::size_t count) {
  using Number = Value<T>;
  Number terms(0);
  for (std::size_t j = 0; j < count; ++j) terms = terms + abs(value_of(slopes[j])) * abs(value_of(z[j]));
  const T rounded(Number(abs(value_of(h)) * terms));
  return value_of(x) < Number(0) ? x - rounded : x + rounded;
}

/// Goes on with an iteration that was in vain by its own references, for at most `limit` iterations more:
/// `correct()` finds and applies `corrections`, which are judged by the larger of `references`, those of
/// roundings, and of `changes`.
template <class T, class Correct, class Vector, class Changes>
Status end_by_rounding(int limit, const Correct& correct, const Vector& corrections,
                       const std::vector<T>& references, const Changes& changes) {
  Convergence<T> convergence;
  do {
    if (const Status status = correct(); status != Status::converged) return status;
    convergence.begin_iteration();
    for (std::size_t k = 0; k < references.size(); ++k)
      convergence.add(corrections[k], references[k], changes[k]);
  } while (!convergence.finished(limit));
  return convergence.status();
}

}  // namespace pfaff
