// Which of the instructions that the library is compiled for the machine lacks. Sources that ask are compiled
// without them, and are told which they are (pfaff_check_machine of cmake/PfaffMachine.cmake).
#pragma once

namespace pfaff {

/// The name of a set of instructions that is needed and not there; null where all are.
inline const char* lacking_instructions() {
#ifdef PFAFF_REQUIRED  // PFAFF_REQUIRE(avx) PFAFF_REQUIRE(avx2) ...
#define PFAFF_REQUIRE(set) \
  if (!__builtin_cpu_supports(#set)) return #set;
  __builtin_cpu_init();
  PFAFF_REQUIRED
#undef PFAFF_REQUIRE
#endif
  return nullptr;
}

}  // namespace pfaff
