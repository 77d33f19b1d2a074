// Reading the file that --state names, which gives the initial state of a run.
#pragma once

#include <string>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff::app {

/// Reads a JSON object {t, z}, {t, q, p} or {t, q, v}, in which t is optional, into `t0`, `initial` and
/// `initial_velocities` of the settings.
/// Numbers keep the digits they are written with. InputError, naming the file, for anything else.
void read_state(const std::string& path, RunSettings& settings);

}  // namespace pfaff::app
