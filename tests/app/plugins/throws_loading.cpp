// A shared object whose initialiser throws: THROWN says what. Or it does something worse: WORSE.
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <pfaff/core/registry/abi.hpp>

namespace {
struct Odd {};
struct Thrower {
#ifdef WORSE
  Thrower() { WORSE; }
#else
  Thrower() { throw THROWN; }
#endif
};
const Thrower thrower;
}  // namespace
