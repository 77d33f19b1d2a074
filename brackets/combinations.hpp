// Brackets made of brackets: sums, differences and multiples. Sharp maps add; so a combination of skew
// brackets is skew, of symmetric ones symmetric, and a skew one minus a symmetric one is the bracket of a
// metriplectic system with a free energy (nguyen-turski section 2, K = pi - G). A sum of Poisson brackets
// need not obey Jacobi's identity: the two must be compatible.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// first + factor * second.
template <class First, class Second>
struct BracketSum {
  First first;
  Second second;
  Real factor = 1;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    std::vector<T> other(vector.size());
    first.sharp(t, z, covector, vector);
    second.sharp(t, z, covector, Out<T>(other));
    for (std::size_t k = 0; k < vector.size(); ++k) vector[k] = vector[k] + T(factor) * other[k];
  }
};

/// factor * bracket.
template <class B>
struct ScaledBracket {
  B bracket;
  Real factor = 1;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    bracket.sharp(t, z, covector, vector);
    for (T& x : vector) x = T(factor) * x;
  }
};

template <class A, class B>
BracketSum<A, B> sum(A first, B second) {
  return {std::move(first), std::move(second), 1};
}
template <class A, class B>
BracketSum<A, B> difference(A first, B second) {
  return {std::move(first), std::move(second), -1};
}
template <class B>
ScaledBracket<B> scaled(Real factor, B bracket) {
  return {std::move(bracket), factor};
}

}  // namespace pfaff
