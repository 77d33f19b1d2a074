// A shared object whose initialiser reads a registry.
#include <pfaff/core/system.hpp>

namespace {
const bool read = !pfaff::systems().all().empty();
}  // namespace
