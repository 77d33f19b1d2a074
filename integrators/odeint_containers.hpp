// States in the containers that Boost.Odeint knows: std::array where the size is known, else std::vector.
#pragma once

#include <array>
#include <vector>

#include <pfaff/core/integrator.hpp>

namespace pfaff {

template <class T, int N>
struct OdeintContainer {
  using type = std::array<T, static_cast<std::size_t>(N)>;
};
template <class T>
struct OdeintContainer<T, dynamic> {
  using type = std::vector<T>;
};
template <class P>
using ContainerOf = typename OdeintContainer<Scalar<P>, P::extent>::type;
template <class P, int Size>
using HalfOf = typename OdeintContainer<Scalar<P>, P::extent == dynamic ? dynamic : P::extent / 2>::type;

template <class C>
C sized(std::size_t n) {
  if constexpr (requires(C c) { c.resize(n); }) {
    return C(n);
  } else {
    return C{};
  }
}

}  // namespace pfaff
