// Ranges as text, of parameters and of coordinates.
#pragma once

#include <string>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// "0 .. 10 1/s"; of a pure number, which has no unit, "0 .. 10".
std::string range_text(const Range& range, const std::string& unit);

}  // namespace pfaff
