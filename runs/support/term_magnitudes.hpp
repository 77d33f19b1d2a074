// term_magnitudes: the scale of a quantity for questions of round-off: the sum of the magnitudes of its
// terms, carried along its tape beside its value. An energy that is the small difference of a kinetic and a
// potential energy is rounded as coarsely as these are, however near to zero it is.
//
// With x the value of a slot and M its magnitude:
//     M(a +- b) = M(a) + M(b),    M(a b) = max(M(a)|b|, |a| M(b)),    M(a/b) = max(M(a)/|b|, |a| M(b)/b^2),
// M = |x| for everything else: states, time, constants, and functions such as sines, whose values are terms.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The largest magnitudes that the outputs of a tape have had so far.
class TermMagnitudes {
 public:
  explicit TermMagnitudes(std::shared_ptr<const Tape> tape);

  /// Takes eight states, one in every lane. What is not finite is left out.
  void add(const Pack<8>& t, const Pack<8>* z);

  /// For every output.
  [[nodiscard]] const std::vector<double>& largest() const { return largest_; }

 private:
  Replay<Pack<8>> replay_;
  std::vector<Pack<8>> outputs_, magnitudes_;
  std::vector<double> largest_;
};

}  // namespace pfaff
