// Flows of the parts of a system from tapes: of systems that are given as text.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

class ExactFlowsFactory;

/// The flows of parts, each given by the tape of its change phi_h(z) - z: inputs z, and h in the place of the
/// time, so that what depends on h alone is computed once while steps are equal. Where the change is not
/// finite, the status says so.
std::shared_ptr<const ExactFlowsFactory> taped_flows(std::vector<std::shared_ptr<const Tape>> changes);

}  // namespace pfaff
