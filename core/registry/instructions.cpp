// Ends the program in one line on a machine that lacks instructions which the library is compiled for; the
// first of them would end it without a word. cmake/PfaffMachine.cmake says which are needed, and compiles
// this file without them.
//
// It runs before every other initialiser of the library, and therefore before those of all that is linked
// with it.
#ifdef __x86_64__
#include <unistd.h>

#include <cstring>
#include <initializer_list>

namespace {

// The smallest priority that is left to programs.
[[gnu::constructor(101)]] void require_instructions() {
  __builtin_cpu_init();
  const char* lacking = nullptr;
#define PFAFF_REQUIRE(set) \
  if (PFAFF_NEEDS_##set && !__builtin_cpu_supports(#set)) lacking = #set
  PFAFF_REQUIRE(popcnt);
  PFAFF_REQUIRE(bmi);
  PFAFF_REQUIRE(bmi2);
  PFAFF_REQUIRE(avx);
  PFAFF_REQUIRE(avx2);
  PFAFF_REQUIRE(fma);
  PFAFF_REQUIRE(avx512f);
  PFAFF_REQUIRE(avx512cd);
  PFAFF_REQUIRE(avx512bw);
  PFAFF_REQUIRE(avx512dq);
  PFAFF_REQUIRE(avx512vl);
  PFAFF_REQUIRE(avx512ifma);
  PFAFF_REQUIRE(avx512vbmi);
  PFAFF_REQUIRE(avx512vbmi2);
  PFAFF_REQUIRE(avx512vnni);
  PFAFF_REQUIRE(avx512bitalg);
  PFAFF_REQUIRE(avx512vpopcntdq);
#undef PFAFF_REQUIRE
  if (lacking == nullptr) return;
  // No stream is initialised yet.
  for (const char* text : {"pfaff: built for machines with the instructions ", lacking,
                           ", which this one lacks; build it here, or anywhere with the preset portable\n"})
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  _exit(2);
}

}  // namespace
#endif
