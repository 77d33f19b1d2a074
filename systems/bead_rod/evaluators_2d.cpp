// Bead-rod formulas in 2 dimensions.
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
template struct EvaluatorInstances<2, ScalarsHere<FormulaScalars>>;
}  // namespace pfaff::detail
