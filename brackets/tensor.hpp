// Brackets given by their tensor Pi(z, t): {f, g} = f_i Pi_ij g_j, of whatever symmetry the tensor has. For
// those whose sharp map has no shorter form: a Poisson tensor found by reduction, a general bilinear bracket.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// F writes the tensor: fill(t, z, entries), n x n row-major, entries zero before.
template <class F>
struct TensorBracket {
  F fill;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t n = z.size();
    std::vector<T> entries(n * n, T(0));
    fill(t, z, Out<T>(entries));
    for (std::size_t i = 0; i < n; ++i) {
      vector[i] = T(0);
      for (std::size_t j = 0; j < n; ++j)
        if (!structurally_zero(entries[i * n + j])) vector[i] = vector[i] + entries[i * n + j] * covector[j];
    }
  }
};
template <class F>
TensorBracket<F> tensor_bracket(F fill) {
  return {std::move(fill)};
}

}  // namespace pfaff
