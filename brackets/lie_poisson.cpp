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
  [[nodiscard]] int casimir_count() const { return bracket().casimir_count(); }
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    bracket().sharp(t, z, covector, vector);
  }
  template <class T>
  void casimirs(const T& t, In<T> z, Out<T> values) const {
    bracket().casimirs(t, z, values);
  }

 private:
  [[nodiscard]] LiePoissonBracket bracket() const {
    return algebra == "se3"   ? LiePoissonBracket::se3(-1)
           : algebra == "sl2" ? LiePoissonBracket::sl2(-1)
                              : LiePoissonBracket::rigid_body();
  }
};

const Bracket<LiePoisson> registered{
    {.name = "lie-poisson",
     .title = "Lie-Poisson brackets {z_i, z_j} = -c_ij^k z_k",
     .reference = "marsden-ratiu1999 (1.2.13), 10.1",
     .description = "The brackets of the duals of so(3), se(3) and sl(2), linear in the state. Take them for "
                    "rigid bodies, tops and their like. They are degenerate: each has Casimirs, which every "
                    "motion keeps and a numerical method need not.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
