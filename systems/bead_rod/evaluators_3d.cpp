// Bead-rod formulas in 3 dimensions.
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
template struct EvaluatorInstances<3, ScalarsHere<FormulaScalars>>;
}  // namespace pfaff::detail
