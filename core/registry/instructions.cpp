// Ends the program in one line on a machine that lacks instructions which the library is compiled for; the
// first of them would end it without a word. cmake/PfaffMachine.cmake says which are needed, and compiles
// this file without them.
//
// It runs before every other initialiser of the library, and therefore before those of all that is linked
// with it.
#include <unistd.h>

#include <cstring>
#include <initializer_list>

#include <pfaff/core/registry/instructions.hpp>

namespace {

// The smallest priority that is left to programs.
[[gnu::constructor(101)]] void require_instructions() {
  const char* const lacking = pfaff::lacking_instructions();
  if (lacking == nullptr) return;
  // No stream is initialised yet.
  for (const char* text : {"pfaff: built for machines with the instructions ", lacking,
                           ", which this one lacks; build it here, or anywhere with the preset portable\n"})
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  _exit(2);
}

}  // namespace
