#include <pfaff/bench/studies/studies.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include <pfaff/bench/runner/loaded_objects.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/input_file.hpp>
#include <pfaff/core/process/shared_object.hpp>
#include <pfaff/core/registry/abi.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

std::optional<StudyFunctions> registered_functions;

// The build tree that makes the libraries of a folder, which is known by its cache.
std::optional<fs::path> build_directory(const fs::path& folder) {
  const std::string key = "\nPfaff_BINARY_DIR:STATIC=";
  std::error_code error;
  for (fs::path above = folder;; above = above.parent_path()) {
    if (const fs::path cache = above / "CMakeCache.txt"; fs::is_regular_file(cache, error)) {
      const std::string text = read_file(cache);
      const std::size_t at = text.find(key);
      if (at == std::string::npos) return std::nullopt;
      const std::size_t begin = at + key.size();
      const fs::path made = text.substr(begin, text.find('\n', begin) - begin);
      return fs::equivalent(made, folder, error) ? std::optional(above) : std::nullopt;
    }
    if (!above.has_relative_path()) return std::nullopt;
  }
}

// The line that mends the library: in a build tree one that builds it, elsewhere the installation. What is
// there may be newer than what it is made from, and would be kept; so it goes first.
std::string remedy(const fs::path& library) {
  const std::optional<fs::path> build = build_directory(library.parent_path());
  if (!build) return "expected that of this installation of Pfaff, which has to be installed again";
  std::error_code error;
  const fs::path file = fs::canonical(library, error);
  return "expected the one that this makes: " + (error ? "" : "rm '" + file.string() + "'; ") +
         "cmake --build '" + build->string() + "' --target pfaff_studies";
}

[[noreturn]] void refuse(const fs::path& library, const std::string& what) {
  throw InputError("library of studies '" + library.string() + "': " + what + "; " + remedy(library));
}

// The note that linking leaves (cmake/PfaffBuilds.cmake), as it is for the libraries of this process.
constexpr const char* note_begins = "linked with ";
std::string own_note() {
  return note_begins + object_holding(&systems()).build + " " + object_holding(&registered_functions).build;
}

// Reads the file before it is loaded, because loading runs its code, and because the first look at what is
// cut off of a file ends the process.
void check(const fs::path& library) {
  std::vector<std::string> notes;
  try {
    notes = abi_stamps(library.string());
  } catch (const InputError& error) {
    const std::string text = error.what(), before = "plug-in '" + library.string() + "': ";
    const std::string what = text.starts_with(before) ? text.substr(before.size()) : text;
    refuse(library,
           what.starts_with("expected") ? "is no shared object" : what.substr(0, what.find("; expected")));
  }
  const auto note = std::find_if(notes.begin(), notes.end(),
                                 [](const std::string& text) { return text.starts_with(note_begins); });
  if (note == notes.end()) refuse(library, "does not say which build of Pfaff it belongs to");
  if (*note != own_note()) refuse(library, "belongs to another build of Pfaff");
}

void load() {
  const fs::path library =
      fs::path(object_holding(&registered_functions).path).parent_path() / PFAFF_STUDIES_LIBRARY;
  std::error_code error;
  if (!fs::exists(library, error)) refuse(library, "is missing");
  check(library);
  if (load_shared_object(library.string(), "library of studies '" + library.string() + "'") == nullptr) {
    const char* words = dlerror();
    refuse(library, words != nullptr ? words : "cannot be loaded");
  }
  if (!registered_functions) refuse(library, "registers nothing");
}

}  // namespace

const StudyFunctions& studies() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (!registered_functions) load();
  return *registered_functions;
}

StudiesRegistration::StudiesRegistration(const StudyFunctions& functions) {
  registered_functions = functions;
}

}  // namespace pfaff
