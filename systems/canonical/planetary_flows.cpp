// The flows in double: the other scalars are compiled where a factory is made (scalar_units.hpp).
#include <pfaff/systems/canonical/planetary_flows.hpp>

namespace {
const pfaff::detail::CodeOf<pfaff::PlanetaryFlowsFactory> planetary_flows_in_double;
}  // namespace
