// Friction of three directions that are coupled in pairs, G = [[1, c, -c], [c, 1, c], [-c, c, 1]] with c =
// x^2/(1 + x^2).
//
// Source: Morrison 1986 (symmetric brackets).
//
// False: `semimetric`: |c| < 1 makes every pair positive, but det G = (1 + c)^2 (1 - 2 c) is negative for c >
// 1/2, that is for |x| > 1.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct ThreeFrictions {
  static constexpr int dimension = 3;
  Real rate = 0.5_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&ThreeFrictions::rate, "rate", "1/s", 0, 100, "of each direction")};
  }

  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const T square = z[0] * z[0], c = square / (1 + square);
    vector[0] = rate * (covector[0] + c * (covector[1] - covector[2]));
    vector[1] = rate * (covector[1] + c * (covector[0] + covector[2]));
    vector[2] = rate * (covector[2] + c * (covector[1] - covector[0]));
  }
};

const Bracket<ThreeFrictions> registered{
    {.name = "three-frictions",
     .title = "friction of three directions, coupled in pairs",
     .reference = "morrison1986",
     .description =
         "A symmetric bracket of three coordinates whose directions are coupled the more the larger x "
         "is. Take it as friction beside a skew bracket. The coupling stays below one.",
     .symmetry = Symmetry::symmetric,
     .jacobi = false,
     .semimetric = true}};
}  // namespace
