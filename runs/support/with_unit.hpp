// A name with its unit, as the heads of tables of measures and their cells have it.
#pragma once

#include <string>

namespace pfaff {

/// "x [m]"; without a unit the name alone.
inline std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

}  // namespace pfaff
