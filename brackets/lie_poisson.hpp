// Lie-Poisson brackets: {f, g}(z) = z_k c_ij^k f_i g_j with the structure constants c of a Lie algebra, up to
// the sign of the left-invariant convention. The Casimirs of so(3)* are the functions of |z|^2.
#pragma once

#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// [e_i, e_j] = value e_k, and the same with i and j exchanged and the sign turned.
struct StructureConstant {
  int i, j, k;
  Real value;
};

/// The bracket {z_i, z_j} = sign * c_ij^k z_k.
struct LiePoissonBracket {
  std::vector<StructureConstant> constants;
  Real sign = 1;

  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (T& v : vector) v = T(0);
    for (const StructureConstant& c : constants) {
      const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j),
                 k = static_cast<std::size_t>(c.k);
      const T element = T(sign * c.value) * z[k];
      vector[i] = vector[i] + element * covector[j];
      vector[j] = vector[j] - element * covector[i];
    }
  }

  /// The body bracket of a rigid body on so(3)*: {f, g} = -z.(grad f x grad g), z the angular momentum.
  static LiePoissonBracket rigid_body() { return {{{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}}, -1}; }
};

}  // namespace pfaff
