// The reversal of mechanical systems in canonical coordinates: (q, p) -> (q, -p) turns the motion round where
// H(q, -p) = H(q, p) and nothing depends on time.
#pragma once

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// z = (q, p) with the signs of the momenta turned.
template <class T>
void reverse_momenta(In<T> z, Out<T> reversed) {
  for (std::size_t k = 0; k < z.size(); ++k) reversed[k] = k < z.size() / 2 ? z[k] : T(-z[k]);
}

}  // namespace pfaff
