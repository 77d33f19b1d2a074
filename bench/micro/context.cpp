// Where the program is built without optimisation, what it prints says so, because its times then say
// nothing.
#include <benchmark/benchmark.h>

#ifndef __OPTIMIZE__
namespace {
[[maybe_unused]] const bool said = (benchmark::AddCustomContext("optimised", "no"), true);
}  // namespace
#endif
