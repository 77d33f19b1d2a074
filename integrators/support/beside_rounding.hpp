// Convergence where terms of a rate cancel, as at rest: a component may be smaller than what they round.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/core/tape/rounded_terms.hpp>

namespace pfaff {

/// What is rounded in the rates of a problem. Where a motion comes to rest terms cancel that are large beside
/// a momentum of nearly zero, and each of them is rounded. They are found only by steps that are in vain
/// without them.
template <class T>
class RoundedRates {
 public:
  using Number = Value<T>;
  /// Finds it for those of `tape` at the state z. The tape has to be the same at every call.
  void find(const std::shared_ptr<const Tape>& tape, const T& t, std::span<const T> z) {
    if (!terms_) terms_.emplace(tape);
    state_.resize(z.size()), sizes_.resize(z.size());
    std::transform(z.begin(), z.end(), state_.begin(), [](const T& x) { return value_of(x); });
    std::transform(state_.begin(), state_.end(), sizes_.begin(), [](const Number& x) { return abs(x); });
    found_ = &(*terms_)(value_of(t), state_, sizes_);
  }
  /// Of the rate of a number, over a step h: so many units of round-off of this are lost at most.
  [[nodiscard]] Number over(const T& h, std::size_t rate) const { return abs(value_of(h)) * (*found_)[rate]; }

 private:
  std::optional<RoundedTerms<Number>> terms_;
  std::vector<Number> state_, sizes_;
  const std::vector<Number>* found_ = nullptr;
};

/// A number with the sign of x that is larger by this size. Derivatives are those of x.
template <class T>
T larger_by(const T& x, const Value<T>& size) {
  return value_of(x) < Value<T>(0) ? x - T(size) : x + T(size);
}

/// Makes of what corrections of single numbers are measured against, `references`, what they are measured
/// against where residuals are lost in rounding: larger by what the latter makes of corrections. `rounded`
/// are the sizes of what residuals round, and solve(residual, correction) finds the corrections of the
/// residuals in a buffer: of a position, say, those that the roundings of momenta bring. They are found for
/// several choices of signs.
template <class T, class Sizes, class Vector, class Solve>
void add_rounding(std::vector<T>& references, const Sizes& rounded, Vector& residual, Vector& correction,
                  const Solve& solve) {
  constexpr std::size_t choices = 8;
  std::vector<Value<T>> largest(references.size(), Value<T>(0));
  for (std::size_t choice = 0; choice < choices; ++choice) {
    for (std::size_t k = 0; k < references.size(); ++k) {
      const std::size_t mixed = (k * 0x9E3779B97F4A7C15U) >> 61U;  // three bits
      residual[k] = T(std::popcount(mixed & choice) % 2 == 0 ? rounded[k] : -rounded[k]);
    }
    solve();
    for (std::size_t k = 0; k < references.size(); ++k)
      largest[k] = std::max(largest[k], Value<T>(abs(value_of(correction[k]))));
  }
  for (std::size_t k = 0; k < references.size(); ++k)
    references[k] = larger_by(references[k], std::max(largest[k], Value<T>(rounded[k])));
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
