// Settings of short runs, and what is said of those that are refused.
#pragma once

#include <string>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff::testing {

inline RunSettings settings_of(const std::string& system, const std::string& step, const std::string& time,
                               const Assignments& set = {}) {
  RunSettings s;
  s.system = system;
  s.integrator = "rk4";
  s.step = step;
  s.time = time;
  s.set = set;
  return s;
}

/// Why the settings are refused; empty where they are not.
inline std::string complaint(const RunSettings& settings) {
  try {
    (void)resolve(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace pfaff::testing
