// Brackets with a constant tensor: {f, g} = f_i P_ij g_j. Jacobi holds for every constant skew P; P
// may be singular, its null covectors being the gradients of linear Casimirs.
#pragma once

#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// A constant n x n tensor, row-major.
struct ConstantBracket {
  int size = 0;
  std::vector<Real> tensor;

  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    const auto n = static_cast<std::size_t>(size);
    for (std::size_t i = 0; i < n; ++i) {
      vector[i] = T(0);
      for (std::size_t j = 0; j < n; ++j)
        if (!tensor[i * n + j].is(0)) vector[i] = vector[i] + T(tensor[i * n + j]) * covector[j];
    }
  }
};

}  // namespace pfaff
