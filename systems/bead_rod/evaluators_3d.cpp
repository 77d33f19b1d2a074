// Bead-rod formulas in 3 dimensions. All scalars are compiled together: for code in doubles alone GCC chooses
// to inline less, and right-hand sides of rings take 5 to 18 % longer.
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
template struct EvaluatorInstances<3, FormulaScalars>;
}  // namespace pfaff::detail
