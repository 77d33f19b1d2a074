// The commands of this room: each does its work, prints what it found, and returns the exit status.
#pragma once

#include <pfaff/bench/studies/options.hpp>

namespace pfaff {

int verify_command(const VerificationSettings& settings, const Common& common);
int falsify_command(const FalsificationOptions& options, const Common& common);

}  // namespace pfaff
