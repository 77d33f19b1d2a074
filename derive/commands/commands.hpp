// The commands of this room: each does its work, prints what it found, and returns the exit status.
#pragma once

#include <pfaff/bench/studies/options.hpp>

namespace pfaff {

int derive_command(const DerivationSettings& options, const Common& common);
int tune_command(const TuningOptions& options, const Common& common);

}  // namespace pfaff
