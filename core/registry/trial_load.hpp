// Loading a plug-in on trial, in a process of its own.
//
// The initialisers of a shared object run while it is loaded. What they throw finds no handler, since the
// loader's frames cannot be unwound, and ends the process, as does a fault of theirs; others never come back,
// or come back twice. None of this can be reported from the process that it happens to. So the program
// `pfaff-trial-load`, which stands beside the library, loads the file first, and reports or dies in place of
// ours.
#pragma once

#include <chrono>
#include <string>

namespace pfaff {

/// How long an initialiser may take; the loader itself takes milliseconds.
constexpr std::chrono::seconds longest_trial{20};

/// Why the shared object at `path`, a path with a '/', cannot be loaded: the loader's words, what an
/// initialiser throws, how it ended the process, that it did not end in time or left another process. Empty
/// where it can. Initialisers run in the trial, with its output thrown away; they run again when the file is
/// loaded. RunError where the trial cannot be made.
std::string trial_load(const std::string& path, std::chrono::milliseconds limit = longest_trial);

/// The program's part: loads the file, says on standard output what is wrong, and ends the process.
[[noreturn]] void load_on_trial(const char* path);

}  // namespace pfaff
