// relative_size: how large a correction is beside what it corrects.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// max over parts of |delta| / scale, where scale is the larger of two reference values, part by part.
template <class T>
Value<T> relative_size(const T& delta, const T& reference, const T& change) {
  const Value<T> d = abs(value_of(delta));
  const Value<T> scale = std::max(abs(value_of(reference)), abs(value_of(change)));
  // A NaN must not vanish: it passes through the division and through the last line. A correction of zero is
  // divided like any other, because the processor cannot predict which one is zero, and a wrong prediction
  // costs more than the division.
  if (scale > Value<T>(0)) return d / scale;
  return d > Value<T>(0) ? std::numeric_limits<Value<T>>::infinity() : d;
}
template <class T, int N>
Value<T> relative_size(const Dual<T, N>& delta, const Dual<T, N>& reference, const Dual<T, N>& change) {
  Value<T> size = relative_size(delta.value, reference.value, change.value);
  // One scale for all directions of a component: some of its derivatives may be zero or nearly so.
  Value<T> scale(0), largest(0);
  for (std::size_t k = 0; k < N; ++k) {
    scale = std::max({scale, abs(value_of(reference.derivative[k])), abs(value_of(change.derivative[k]))});
    largest = std::max(largest, abs(value_of(delta.derivative[k])));
    if (isnan(value_of(delta.derivative[k]))) return value_of(delta.derivative[k]);
  }
  if (largest > Value<T>(0))
    size = std::max(size, scale > Value<T>(0) ? largest / scale : std::numeric_limits<Value<T>>::infinity());
  return size;
}

}  // namespace pfaff
