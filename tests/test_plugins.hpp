#pragma once

#include <filesystem>
#include <string>

namespace pfaff::testing {

/// The path of a plug-in that is built for tests. It stands beside the program that asks, and not where that
/// was compiled: programs are linked from objects of another build where PFAFF_OBJECTS_FROM names one.
inline std::string test_plugin(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "plugins" / (name + ".so");
}

}  // namespace pfaff::testing
