// Bead-rod formulas in 2 dimensions, for all scalars in one unit: GCC inlines less of them into fewer, and
// rods of rings take 5 to 18 % longer.
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
template struct EvaluatorInstances<2, FormulaScalars>;
}  // namespace pfaff::detail
