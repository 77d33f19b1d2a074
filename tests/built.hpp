// What is built beside a test program, and how. Programs are linked from objects of another build where
// PFAFF_OBJECTS_FROM names one, so that the compiler knows neither.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <string>

namespace pfaff::testing {

inline std::filesystem::path directory_of_tests() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

/// The program pfaff.
inline std::filesystem::path built_program() { return directory_of_tests().parent_path() / "pfaff"; }

/// The path of a plug-in that is built for tests.
inline std::string test_plugin(const std::string& name) {
  return directory_of_tests() / "plugins" / (name + ".so");
}

/// Whether the libraries are compiled with the address sanitizer.
inline bool has_address_sanitizer() { return dlsym(RTLD_DEFAULT, "__asan_init") != nullptr; }

}  // namespace pfaff::testing
