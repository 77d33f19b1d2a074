// What is made of tapes, in double: the other scalars are compiled with model.cpp (scalar_units.hpp).
#include <pfaff/core/facets/joined_velocity_constraints.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/facets/taped_flows.hpp>
#include <pfaff/core/facets/taped_velocity_constraints.hpp>

namespace {
using namespace pfaff;

const detail::CodeOf<TapedHolonomicFactory, TapedVelocityFactory, JoinedVelocityFactory, TapedFlowsFactory>
    code_in_double;
}  // namespace
