// The Lie-Poisson bracket of so(3)* as a plug-in.
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct LiePoisson {
  static constexpr int dimension = 3;
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    LiePoissonBracket::rigid_body().sharp(t, z, covector, vector);
  }
};

const Bracket<LiePoisson> registered{{.name = "lie-poisson",
                                      .title = "Lie-Poisson bracket of so(3)*, {f, g} = -z.(grad f x grad g)",
                                      .reference = "marsden-ratiu1999 (1.2.13)",
                                      .symmetry = Symmetry::skew,
                                      .jacobi = true}};
}  // namespace
