// The library of plug-ins, libpfaff_plugins: the systems, methods and kinds of tables that ship with Pfaff,
// but for those of the main job, which libpfaff has.
//
// The main job needs a few of them, and nothing else waits until all are compiled: the library is built after
// libpfaff or not at all. Registries load it when they are first read (core/registry/registry.hpp). What
// ships has its name then, also where a program has registered something of that name before, which is a
// duplicate.
#pragma once

#include <string>

namespace pfaff {

/// Loads the library, once. Where that is not possible, plugins_left_out() says why. Any number of threads
/// may ask for it, also from initialisers that the loader runs.
void load_shipped_plugins();

/// True while this thread loads the library: what is registered now is what ships.
bool shipped_plugins_register();

/// Why the library is not loaded, with the line that mends it; empty where it is.
const std::string& plugins_left_out();

/// InputError that says so: for what is about all plug-ins and would otherwise be about some.
void require_shipped_plugins();

/// The same as the end of a message about a name that is not there: "; library of plug-ins …", or nothing.
std::string what_is_left_out();

/// Where the library is, or would be.
std::string shipped_plugins_path();

}  // namespace pfaff
