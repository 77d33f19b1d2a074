// Nambu's bracket of three coordinates, Pi w = b x w with b = grad C, on the shells of a function C.
//
// Source: Marsden, Ratiu, Introduction to Mechanics and Symmetry, 10.1; Nambu 1973.
//
// False: `casimirs`: b is the gradient of x^2/2 + y^2/2 + a z^4/4 + x z^2/2^21, and what is said to be C
// lacks the last term, so that it is a Casimir to six digits, and to all of them where z = 0.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct NambuShell {
  static constexpr int dimension = 3;
  Real a = 1;
  static std::vector<Parameter> parameters() { return {parameter(&NambuShell::a, "a", "", 0.1, 10)}; }

  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const T small = z[2] / T(1048576);
    const T x = z[0] + small * z[2] / T(2), y = z[1], w = a * z[2] * z[2] * z[2] + small * z[0];
    vector[0] = y * covector[2] - w * covector[1];
    vector[1] = w * covector[0] - x * covector[2];
    vector[2] = x * covector[1] - y * covector[0];
  }

  [[nodiscard]] int casimir_count() const { return 1; }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    const T square = z[2] * z[2];
    values[0] = (z[0] * z[0] + z[1] * z[1]) / 2 + a * square * square / 4;
  }
};

const Bracket<NambuShell> registered{
    {.name = "nambu-shell",
     .title = "Nambu's bracket on shells x^2/2 + y^2/2 + a z^4/4 = const",
     .reference = "marsden-ratiu1999 10.1",
     .description =
         "Nambu's bracket of three coordinates with one function given. Take it for bodies that move "
         "on closed shells. It has rank two but for the origin.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
