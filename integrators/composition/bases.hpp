// The bases of compositions: symmetric methods of order 2 that say how they are composed.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// The names of the registered methods that can be a base with their default parameters.
std::vector<std::string> base_names();

/// Why a method cannot be a base, and which ones can: "it is not symmetric; expected one of: dla, ..."; empty
/// where it can.
std::string unfit_as_base(const MethodPlugin& plugin, const MethodInstance& method);

}  // namespace pfaff
