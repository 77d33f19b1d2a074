// The canonical bracket as a plug-in; its dimension is a parameter.
#include <pfaff/brackets/canonical.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct Canonical : CanonicalBracket {
  int degrees = 2;
  static std::vector<Parameter> parameters() {
    return {
        parameter(&Canonical::degrees, "degrees", "", 1, 1000, "degrees of freedom n; the dimension is 2 n")};
  }
  [[nodiscard]] int dimension() const { return 2 * degrees; }
};

const Bracket<Canonical> registered{
    {.name = "canonical",
     .title = "canonical bracket {q_i, p_j} = delta_ij",
     .reference = "marsden-ratiu1999 2.7",
     .description = "The bracket of positions and momenta, of any even dimension. Take it wherever "
                    "coordinates are canonical; systems given by energies T + V or by H alone have it "
                    "without asking. It is constant and regular and has no Casimirs.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
