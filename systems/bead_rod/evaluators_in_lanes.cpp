// Energies of beads at eight states side by side, in a file of their own: what GCC inlines of the other
// scalars depends on what it compiles with them.
#include <pfaff/systems/bead_rod/evaluators_of_dimension.hpp>

namespace pfaff::detail {
template std::unique_ptr<PotentialEnergy<Pack<8>>> potential_energy<Pack<8>, 2>(const BeadRodParts& parts);
template std::unique_ptr<PotentialEnergy<Pack<8>>> potential_energy<Pack<8>, 3>(const BeadRodParts& parts);
}  // namespace pfaff::detail
