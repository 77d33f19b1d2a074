// A shared object that leaves a file when it is loaded: what refusing it before loading is tested with.
#include <cstdlib>
#include <fstream>

#include <pfaff/core/registry/version.hpp>
#ifdef OTHER_VERSION
#undef PFAFF_VERSION_TEXT
#define PFAFF_VERSION_TEXT "0.0.9"
#endif
#ifndef NO_STAMP
#include <pfaff/core/registry/abi.hpp>
#endif

namespace {
struct Witness {
  Witness() {
    if (const char* file = std::getenv("PFAFF_WITNESS")) std::ofstream(file) << "loaded\n";
  }
};
const Witness witness;
}  // namespace
