// Loading a plug-in on trial, in a process of its own.
//
// The initialisers of a shared object run while it is loaded. What they throw finds no handler, since the
// loader's frames cannot be unwound, and ends the process, as does a fault of theirs; neither can be reported
// from the process that it ends. So a child loads the file first, and reports or dies in place of the
// program.
#pragma once

#include <string>

namespace pfaff {

/// Why the shared object at `path`, a path with a '/', cannot be loaded: the loader's words, what an
/// initialiser throws, or how it ended the child. Empty where it can. Initialisers run in the child, with its
/// output thrown away; they run again when the file is loaded. RunError where no child can be started.
std::string trial_load(const std::string& path);

}  // namespace pfaff
