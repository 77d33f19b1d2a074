// RoundedTerms: what the outputs of a tape are made of, and so what rounding makes of them where terms
// cancel.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The sums of the magnitudes of all that is rounded on the way to each output of a tape, in the scalar T,
/// double or Quad: an output is off by so many units of round-off at most, to first order.
template <class T>
class RoundedTerms {
 public:
  explicit RoundedTerms(std::shared_ptr<const Tape> tape);

  /// At a state z of as many numbers as the tape has inputs, each of which is known to a unit of round-off of
  /// its size.
  const std::vector<T>& operator()(const T& t, std::span<const T> z, std::span<const T> sizes);

 private:
  Replay<WithRounding<T>> replay_;
  std::vector<WithRounding<T>> inputs_, outputs_;
  std::vector<T> terms_;
};

extern template class RoundedTerms<double>;
extern template class RoundedTerms<Quad>;

}  // namespace pfaff
