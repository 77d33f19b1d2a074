#include <pfaff/bench/studies/studies.hpp>

#include <mutex>
#include <optional>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/shared_object.hpp>
#include <pfaff/core/registry/later_library.hpp>
#include <pfaff/core/registry/shipped_plugins.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

namespace {

std::optional<StudyFunctions> registered_functions;

}  // namespace

const StudyFunctions& studies() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  require_shipped_plugins();
  if (!registered_functions)
    load_later_library({.kind = "library of studies",
                        .file = PFAFF_STUDIES_LIBRARY,
                        .target = "pfaff_studies",
                        .linked_with = {&systems(), &registered_functions}},
                       load_shared_object);
  if (!registered_functions) throw RunError("the library of studies registers nothing");
  return *registered_functions;
}

StudiesRegistration::StudiesRegistration(const StudyFunctions& functions) {
  registered_functions = functions;
}

}  // namespace pfaff
