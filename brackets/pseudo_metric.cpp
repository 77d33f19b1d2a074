// A constant symmetric bracket of any signature as a plug-in: <z_i, z_i> = +1, -1 or 0. The sum of a
// coordinate with +1 and one with -1 has <phi, phi> = 0 without being a Casimir. An elimination of such
// constraints needs pairs of them as pivots.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct PseudoMetric {
  int plus = 2, minus = 1, null = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&PseudoMetric::plus, "plus", "", 0, 1000, "coordinates with <z, z> = 1"),
            parameter(&PseudoMetric::minus, "minus", "", 0, 1000, "coordinates with <z, z> = -1"),
            parameter(&PseudoMetric::null, "null", "", 0, 1000, "coordinates that are Casimirs")};
  }
  [[nodiscard]] int dimension() const { return plus + minus + null; }
  [[nodiscard]] int casimir_count() const { return null; }
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    for (std::size_t k = 0; k < vector.size(); ++k) {
      const int place = static_cast<int>(k);
      vector[k] = place < plus ? covector[k] : place < plus + minus ? -covector[k] : T(0);
    }
  }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = z[static_cast<std::size_t>(plus + minus) + k];
  }
};

const Bracket<PseudoMetric> registered{
    {.name = "pseudo-metric",
     .title = "constant symmetric bracket of any signature",
     .reference = "nguyen-turski section 2",
     .description =
         "A constant symmetric bracket with squares of either sign or zero. Take it to test symmetric Dirac "
         "brackets where a constraint may have a vanishing square without being a Casimir, so that pivots "
         "are needed in pairs. It is no friction: squares may be negative, and an energy may grow by it.",
     .symmetry = Symmetry::symmetric,
     .jacobi = false}};
}  // namespace
