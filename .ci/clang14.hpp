// For clang-tidy 14 only: it lacks the built-in behind std::source_location, so libstdc++ leaves the type
// out.
#pragma once
#include <source_location>
#ifndef __cpp_lib_source_location
namespace std {  // NOLINT(cert-dcl58-cpp)
struct source_location {
  static constexpr source_location current(const char* file = __builtin_FILE()) noexcept { return {file}; }
  constexpr const char* file_name() const noexcept { return file; }
  const char* file = "";
};
}  // namespace std
#endif
