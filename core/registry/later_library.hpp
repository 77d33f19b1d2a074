// Libraries of Pfaff that are loaded by another of its libraries, when they are first needed.
//
// Types and tables are shared with them, so that they fit one build alone. Which one is read from a file
// before it is loaded: linking leaves the build IDs of the libraries that it was linked with in it, in an ELF
// note.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pfaff {

/// A library that stands beside the one that loads it.
struct LaterLibrary {
  std::string kind;    // as in "library of studies", for messages
  std::string file;    // its name without a folder
  std::string target;  // of the build, which makes it
  /// An object of each library that it is linked with, in the order of cmake/PfaffBuilds.cmake. It is looked
  /// for beside the last of them.
  std::vector<const void*> linked_with;
};

/// Where it is looked for.
std::string path_of(const LaterLibrary& library);

/// Looks at the file, and then loads it by `load`, which gives null where dlopen does. InputError, which
/// names the line that mends it, where it is missing, damaged or of another build.
void load_later_library(const LaterLibrary& library,
                        const std::function<void*(const std::string& path, const std::string& who)>& load);

}  // namespace pfaff
