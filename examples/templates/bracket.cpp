// <one line: the bracket>, the log-canonical bracket in three dimensions, {z_i, z_j} = a_ij z_i z_j, a skew.
//
// Copy to brackets/<name>.cpp. The sharp map is all there is to write. The symmetry and the Jacobi identity
// that the descriptor claims are tested.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct LogCanonical {
  static constexpr int dimension = 3;
  Real a12 = 1, a23 = 2, a31 = 0.5_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&LogCanonical::a12, "a12", "", -10, 10),
            parameter(&LogCanonical::a23, "a23", "", -10, 10),
            parameter(&LogCanonical::a31, "a31", "", -10, 10)};
  }

  // vector = Pi(z, t) covector
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const T x = z[0] * covector[0], y = z[1] * covector[1], w = z[2] * covector[2];
    vector[0] = z[0] * (a12 * y - a31 * w);
    vector[1] = z[1] * (a23 * w - a12 * x);
    vector[2] = z[2] * (a31 * x - a23 * y);
  }
};

const Bracket<LogCanonical> registered{
    {.name = "template-bracket",
     .title = "log-canonical bracket {z_i, z_j} = a_ij z_i z_j",
     .reference = "marsden-ratiu1999 10.1",
     .description = "The log-canonical bracket in three dimensions, the template of a bracket. Say what it "
                    "is and when to take it. Say where it ends, too.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
