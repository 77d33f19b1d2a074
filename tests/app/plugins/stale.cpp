// An object file left over from another version, linked into a plug-in whose other object file fits.
#include <pfaff/core/registry/version.hpp>
#undef PFAFF_VERSION_TEXT
#define PFAFF_VERSION_TEXT "0.0.8"
#include <pfaff/core/registry/abi.hpp>
