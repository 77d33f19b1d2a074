#include <pfaff/core/registry/shipped_plugins.hpp>

#include <dlfcn.h>

#include <atomic>
#include <mutex>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/later_library.hpp>

namespace pfaff {

namespace {
std::string& fault() {
  static std::string text;
  return text;
}

thread_local bool loads = false;  // whether this thread loads the library

LaterLibrary library() {
  return {.kind = "library of plug-ins",
          .file = PFAFF_PLUGINS_LIBRARY,
          .target = "pfaff_studies",  // with all that is installed
          .linked_with = {&fault()}};
}
}  // namespace

bool shipped_plugins_register() { return loads; }

// Each thread that comes before the library is there loads it: the loader has the others wait, and runs
// initialisers once. A lock of our own around that would be taken before the loader's here, and after it
// where an initialiser reads a registry.
void load_shipped_plugins() {
  static std::atomic<bool> done = false;
  if (done.load(std::memory_order_acquire) || loads) return;
  loads = true;
  std::string found;
  try {
    load_later_library(library(), [](const std::string& path, const std::string& /*who*/) {
      return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    });
  } catch (const std::exception& error) {
    found = error.what();
  }
  loads = false;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (done.load(std::memory_order_relaxed)) return;
  fault() = found;
  done.store(true, std::memory_order_release);
}

const std::string& plugins_left_out() {
  load_shipped_plugins();
  return fault();
}

void require_shipped_plugins() {
  if (!plugins_left_out().empty()) throw InputError(plugins_left_out());
}

std::string what_is_left_out() { return plugins_left_out().empty() ? "" : "; " + plugins_left_out(); }

std::string shipped_plugins_path() { return path_of(library()); }

}  // namespace pfaff
