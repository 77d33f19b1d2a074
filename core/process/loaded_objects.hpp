// The shared objects of this process and the builds they are.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

/// A file of machine code in this process: a library, a plug-in, or the program itself.
struct LoadedObject {
  std::string path;   // absolute
  std::string build;  // which build it is, see below
};

/// Every shared object of the process, the program first. `build` is the build ID that the linker wrote into
/// the object (its note NT_GNU_BUILD_ID), read from memory: the file may have been replaced since it was
/// loaded. For an object without one it is "sha1-" and the SHA-1 of the file.
std::vector<LoadedObject> loaded_objects();

/// The object that holds an address, such as that of a registered plug-in. std::logic_error where none does.
LoadedObject object_holding(const void* address);

}  // namespace pfaff
