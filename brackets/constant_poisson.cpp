// A constant Poisson tensor as a plug-in: three dimensions, {x, y} = c, {y, z} = a, {z, x} = b; the linear
// function a x + b y + c z is its Casimir.
#include <pfaff/brackets/constant_poisson.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct ConstantPoisson {
  static constexpr int dimension = 3;
  Real a = 1, b = 2, c = 3;
  static std::vector<Parameter> parameters() {
    return {parameter(&ConstantPoisson::a, "a", "", -1e6, 1e6, "{y, z}"),
            parameter(&ConstantPoisson::b, "b", "", -1e6, 1e6, "{z, x}"),
            parameter(&ConstantPoisson::c, "c", "", -1e6, 1e6, "{x, y}")};
  }
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    ConstantBracket{3, {0, c, -b, -c, 0, a, b, -a, 0}}.sharp(t, z, covector, vector);
  }
};

const Bracket<ConstantPoisson> registered{
    {.name = "constant-poisson",
     .title = "constant Poisson tensor in three dimensions",
     .reference = "marsden-ratiu1999 10.1",
     .description =
         "A constant bracket of three dimensions, which is degenerate because its dimension is odd. Take it "
         "to test what is done with Casimirs in the simplest case: its one Casimir is linear. Every "
         "Runge-Kutta method keeps a linear Casimir, so that it tells no methods apart.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
