// Model files of bead-rod systems, TOML or JSON (docs/bead-rod.md).
#pragma once

#include <string>

#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff {

/// Reads and checks a model file; JSON where the name ends in .json, else TOML. Decimal numbers keep all
/// their digits. InputError, in one line that begins with the path, for whatever is wrong in it.
BeadRodDescription read_bead_rod_model(const std::string& path);

}  // namespace pfaff
