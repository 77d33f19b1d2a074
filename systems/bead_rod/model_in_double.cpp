// The formulas of beads and rods in doubles, for model.cpp (core/facets/scalar_units.hpp).
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

const detail::CodeOfSystem<BeadRodFormulas> code_in_double;
}  // namespace
