// The Lie-Poisson brackets of the family so(4), e(3), so(3,1) in the coordinates (u, v), with kappa = 1, 0
// and -1:
//
//   {u_i, u_j} = e_ijk u_k,  {u_i, v_j} = e_ijk v_k,  {v_i, v_j} = kappa e_ijk u_k
//
// The Casimirs are u.v and kappa |u|^2 + |v|^2.
//
// Source: Bolsinov, Fomenko, Integrable Hamiltonian Systems (2004), chapter 14; Marsden, Ratiu (1999),
// chapter 13.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct FourDimensionalRotations {
  static constexpr int dimension = 6;
  Real kappa = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&FourDimensionalRotations::kappa, "kappa", "", -10, 10, "curvature")};
  }

  // vector = Pi covector: with a = dF/du and b = dF/dv, u' = u x a + v x b up to the common sign, v' = v x a
  // + kappa u x b.
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const In<T> u = z.first(3), v = z.subspan(3), a = covector.first(3), b = covector.subspan(3);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      vector[i] = (u[k] * a[j] - u[j] * a[k]) + (v[k] * b[j] - v[j] * b[k]);
      vector[3 + i] = (v[k] * a[j] - v[j] * a[k]) + kappa * (u[k] * b[j] - u[j] * b[k]);
    }
  }

  [[nodiscard]] int casimir_count() const { return 2; }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[0] * z[3] + z[1] * z[4] + z[2] * z[5];
    values[1] = kappa * (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) + (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]);
  }
};

const Bracket<FourDimensionalRotations> registered{
    {.name = "four-dimensional-rotations",
     .title = "Lie-Poisson brackets of so(4), e(3) and so(3,1)",
     .reference = "marsden-ratiu1999",
     .description = "A family of brackets with a curvature as parameter. Take it for bodies on spheres, in "
                    "space and in hyperbolic space. It has two Casimirs.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
