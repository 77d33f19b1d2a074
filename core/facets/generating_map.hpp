// How an author's transformation alpha of pairs of states is put on a tape.
//
//   template <class T>
//   void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const;
//
// (z', z) -> (w^, w), possibly nonlinear and depending on both times, is what generating functions are built
// on (su-qin (32)-(34)). Tapes have one time, so t0 becomes the last input.
#pragma once

#include <pfaff/core/facets/written_formulas.hpp>

namespace pfaff {

/// The tape of author.alpha for states of n numbers.
template <class A>
Tape record_alpha(const A& author, int dimension) {
  return record(2 * dimension + 1, 2 * dimension, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
    detail::write<Formula::alpha>(author, t, x, out);
  });
}

}  // namespace pfaff
