// Loading shared objects: plug-ins, and the code that is compiled of formulas.
//
// Loading runs code of others, and what that code changes of the process would change every number and file
// that follows: a start-up file of -ffast-math makes the processor flush subnormals to zero, a constructor
// may set a locale or go to another directory. All of this is put back. What ends the process meanwhile is
// said first.
#pragma once

#include <string>

namespace pfaff {

/// The handle of the shared object at `path`, a path with a '/'; null where the loader refuses it, and
/// `dlerror` says why. Afterwards rounding and the treatment of subnormals, locales, the formats of standard
/// streams, the working directory, the mask of new files and the signals that end or stop a program are what
/// they were. Code that ends the process while it is loaded, by exit or by an exception, ends it with one
/// line that begins with `who` and the exit status 2.
void* load_shared_object(const std::string& path, const std::string& who);

}  // namespace pfaff
