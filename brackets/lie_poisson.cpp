// Lie-Poisson brackets as a plug-in: the duals of so(3), se(3) and sl(2).
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct LiePoisson {
  std::string algebra = "so3";
  static std::vector<Parameter> parameters() {
    return {parameter(&LiePoisson::algebra, "algebra", {"so3", "se3", "sl2"},
                      "rotations, rigid motions, traceless 2 x 2 matrices")};
  }
  [[nodiscard]] int dimension() const { return algebra == "se3" ? 6 : 3; }
  [[nodiscard]] int casimir_count() const { return algebra == "se3" ? 2 : 1; }
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const auto bracket = algebra == "se3"   ? LiePoissonBracket::se3(-1)
                         : algebra == "sl2" ? LiePoissonBracket::sl2(-1)
                                            : LiePoissonBracket::rigid_body();
    bracket.sharp(t, z, covector, vector);
  }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    if (algebra == "sl2") {
      values[0] = z[0] * z[0] + T(4) * z[1] * z[2];
      return;
    }
    const std::size_t first = algebra == "se3" ? 3 : 0;
    values[0] = z[first] * z[first] + z[first + 1] * z[first + 1] + z[first + 2] * z[first + 2];
    if (algebra == "se3") values[1] = z[0] * z[3] + z[1] * z[4] + z[2] * z[5];
  }
};

const Bracket<LiePoisson> registered{{.name = "lie-poisson",
                                      .title = "Lie-Poisson brackets {z_i, z_j} = -c_ij^k z_k",
                                      .reference = "marsden-ratiu1999 (1.2.13), 10.1",
                                      .symmetry = Symmetry::skew,
                                      .jacobi = true}};
}  // namespace
