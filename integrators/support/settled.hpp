// When an iteration that is watched by Convergence may stop early: where the next correction, the last one
// times the contraction, would be lost in rounding.
#pragma once

#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>

namespace pfaff {

/// True where a correction of the relative size `size` is the last that is worth making. In the first round
/// the contraction is the slowest of earlier iterations, with a factor of 2 to spare; later it is the one
/// measured.
template <class T>
bool settled(const Convergence<T>& convergence, const Value<T>& size,
             const RememberedContraction<Value<T>>& remembered) {
  const Value<T> ratio =
      convergence.iterations() == 1 ? Value<T>(2) * remembered.ratio() : convergence.ratio();
  return ratio < Value<T>(0.1) && ratio * size <= unit_roundoff<T>() / Value<T>(8);
}

}  // namespace pfaff
