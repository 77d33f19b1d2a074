// Bead-rod formulas in 3 dimensions.
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
// NOLINTBEGIN(bugprone-macro-parentheses): template arguments take none
#define PFAFF_EVALUATORS(T)                                      \
  template T potential_energy<T, 3>(const BeadRodParts&, In<T>); \
  template std::unique_ptr<HolonomicConstraints<T>> rod_constraints<T, 3>(const BeadRodParts&);
PFAFF_FOR_EVERY_SCALAR(PFAFF_EVALUATORS)
#undef PFAFF_EVALUATORS
// NOLINTEND(bugprone-macro-parentheses)
}  // namespace pfaff::detail
