// The canonical bracket on (q, p): {f, g} = f_q.g_p - f_p.g_q, sharp map J (marsden-ratiu1999 2.7).
#pragma once

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// {q_i, p_j} = delta_ij on 2 n-dimensional phase space.
struct CanonicalBracket {
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    const std::size_t half = covector.size() / 2;
    for (std::size_t k = 0; k < half; ++k) {
      vector[k] = covector[half + k];
      vector[half + k] = -covector[k];
    }
  }
};

}  // namespace pfaff
