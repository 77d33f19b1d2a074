// Convergence where terms of a rate cancel, as at rest: a component may be smaller than what they round.
#pragma once

#include <algorithm>
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

/// The largest of these corrections: of values beside the larger of `references` and `changes`, of
/// derivatives beside the largest one in their direction, component by component in those units. A change of
/// a momentum with a position may be smaller than one with another momentum by as much as their units differ.
template <class T, class Corrections, class Changes>
Value<T> largest_correction(const Corrections& corrections, const std::vector<T>& references,
                            const Changes& changes) {
  using Number = Value<T>;
  Number largest(0);
  const auto note = [&largest](const Number& size) {
    if (!isnan(largest) && !(size <= largest)) largest = size;
  };
  for (std::size_t k = 0; k < references.size(); ++k)
    note(relative_size(value_of(corrections[k]), value_of(references[k]), value_of(changes[k])));
  if constexpr (derivative_depth<T> != 0) {
    for (std::size_t j = 0; j < references.front().derivative.size(); ++j) {
      const auto size = [j](const T& x) { return abs(value_of(x.derivative[j])); };
      Number whole(0), corrected(0);
      for (std::size_t k = 0; k < references.size(); ++k) {
        const Number value = std::max(abs(value_of(references[k])), abs(value_of(changes[k])));
        const Number unit = value > Number(0) ? value : Number(1);
        whole = std::max(whole, Number(std::max(size(references[k]), size(changes[k])) / unit));
        if (const Number part = size(corrections[k]) / unit; !(part <= corrected)) corrected = part;
        if (isnan(corrected)) return corrected;
      }
      note(relative_size(corrected, whole, Number(0)));
    }
  }
  return largest;
}

/// Goes on with an iteration that was in vain by its own references, for at most `limit` iterations more:
/// `correct()` finds and applies `corrections`, which are judged by the larger of `references`, those of
/// roundings, and of `changes`. What was in vain at finite numbers and leaves their range here has not
/// converged either.
template <class T, class Correct, class Vector, class Changes>
Status end_by_rounding(int limit, const Correct& correct, const Vector& corrections,
                       const std::vector<T>& references, const Changes& changes) {
  using Number = Value<T>;
  Convergence<Number> convergence;
  do {
    if (correct() != Status::converged) return Status::not_converged;
    convergence.begin_iteration();
    convergence.add(largest_correction(corrections, references, changes), Number(1), Number(1));
  } while (!convergence.finished(limit));
  return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
}

}  // namespace pfaff
