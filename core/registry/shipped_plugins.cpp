#include <pfaff/core/registry/shipped_plugins.hpp>

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

LaterLibrary library() {
  return {.kind = "library of plug-ins",
          .file = PFAFF_PLUGINS_LIBRARY,
          .target = "pfaff_plugins",
          .linked_with = {&fault()}};
}
}  // namespace

void load_shipped_plugins() {
  static std::atomic<bool> done = false;
  if (done.load(std::memory_order_acquire)) return;
  // Other threads wait. What reads the registries while the library is loaded is what it registers itself.
  static std::recursive_mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static bool begun = false;
  if (begun) return;
  begun = true;
  try {
    load_later_library(library());
  } catch (const std::exception& error) {
    fault() = error.what();
  }
  done.store(true, std::memory_order_release);
}

const std::string& plugins_left_out() {
  load_shipped_plugins();
  return fault();
}

std::string what_is_left_out() { return plugins_left_out().empty() ? "" : "; " + plugins_left_out(); }

std::string shipped_plugins_path() { return path_of(library()); }

}  // namespace pfaff
