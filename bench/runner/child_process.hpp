// Programs that are started by this one and end with it.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

/// How a program has ended, and what it wrote to its standard output and standard error.
struct ChildOutcome {
  int status = -1;  // its exit status; -1 where it could not be started or was ended by a signal
  std::string output;
};

/// Runs a program, looked for in PATH, and waits for its end. However this process ends, killed or not, the
/// program ends with it: one that went on would write to a directory whose lock is no longer held.
ChildOutcome run_child(const std::vector<std::string>& command);

}  // namespace pfaff
