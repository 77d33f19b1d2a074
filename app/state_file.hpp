// The file that --state names.
#pragma once

#include <string>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff::app {

/// Reads {t, z} or {t, q, p}, t optional, into t0 and initial; numbers keep the digits they are written with.
/// InputError, naming the file, for anything else.
void read_state(const std::string& path, RunSettings& settings);

}  // namespace pfaff::app
