// The command of this room: it does its work, prints what it found, and returns the exit status.
#pragma once

#include <pfaff/bench/studies/options.hpp>

namespace pfaff {

int reproduce_command(const ReproductionOptions& options, const Common& common);

}  // namespace pfaff
