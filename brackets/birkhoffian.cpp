// K^-1 of a sample one-form as a plug-in, F = e^{nu t} (p (1 + r^2)/2, -r (1 + p^2)/2): a structure that
// depends on state and time, K = -e^{nu t} (1 + (r^2 + p^2)/2) J.
#include <pfaff/brackets/birkhoffian.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct Birkhoffian {
  static constexpr int dimension = 2;
  Real nu = 0.3_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&Birkhoffian::nu, "nu", "1/s", -10, 10, "growth rate of the structure")};
  }
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const Tape one_form =
        record(2, 2, [&](const Recorded& time, std::span<const Recorded> x, std::span<Recorded> form) {
          const Recorded growth = exp(nu * time);
          form[0] = growth * x[1] * (Recorded(1) + x[0] * x[0]) / 2;
          form[1] = -(growth * x[0] * (Recorded(1) + x[1] * x[1])) / 2;
        });
    BirkhoffianBracket(one_form).sharp(t, z, covector, vector);
  }
};

const Bracket<Birkhoffian> registered{
    {.name = "birkhoffian",
     .title = "K^-1 of a Birkhoffian one-form, by differentiation",
     .reference = "su-qin (5), (67)",
     .description =
         "The inverse of the structure K = dF of a sample one-form that depends on state and time, by "
         "differentiation. Take it as the example of a bracket that is not written down: any one-form of a "
         "regular K makes one. It obeys Jacobi's identity because K is closed, and ends where K is singular.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
