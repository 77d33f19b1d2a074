// The system's C++ compiler: which one it is, and shared libraries made by it of texts.
//
// Libraries are kept in a cache (core/native/library_cache.hpp), and nothing goes through a shell.
#pragma once

#include <memory>
#include <string>

namespace pfaff::native {

/// A loaded library; it is unloaded when the object ends.
class Library {
 public:
  explicit Library(void* handle) : handle_(handle) {}
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  /// The address of a symbol; null where the library has none of this name.
  [[nodiscard]] void* symbol(const std::string& name) const;

 private:
  void* handle_;
};

/// The first line of what the compiler says of its version; empty where there is no compiler. The compiler is
/// $CXX, in which words are separated by spaces, or c++.
std::string compiler_version();

/// Which code is made of formulas here: the compiler's version, its words and the flags, in one line, or
/// "interpreted: no compiler".
std::string compiler_identity();

/// The library of a text in C++17, compiled or found in the cache. RunError, naming `what` and the file with
/// the compiler's messages, where it does not compile, and where the cache cannot be used.
std::shared_ptr<const Library> library_of(const std::string& text, const std::string& what);

}  // namespace pfaff::native
