#include <pfaff/core/registry/later_library.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/input_file.hpp>
#include <pfaff/core/process/loaded_objects.hpp>
#include <pfaff/core/registry/abi.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

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
std::string remedy(const fs::path& library, const std::string& target) {
  const std::optional<fs::path> build = build_directory(library.parent_path());
  if (!build) return "expected that of this installation of Pfaff, which has to be installed again";
  std::error_code error;
  const fs::path file = fs::canonical(library, error);
  return "expected the one that this makes: " + (error ? "" : "rm '" + file.string() + "'; ") +
         "cmake --build '" + build->string() + "' --target " + target;
}

// The note that linking leaves (cmake/PfaffBuilds.cmake), as it is for the libraries of this process.
constexpr const char* note_begins = "linked with ";
std::string own_note(const LaterLibrary& library) {
  std::string note = note_begins;
  for (std::size_t k = 0; k < library.linked_with.size(); ++k)
    note += (k == 0 ? "" : " ") + object_holding(library.linked_with[k]).build;
  return note;
}

// What is wrong with a file, empty where nothing is. It is read before it is loaded, because loading runs its
// code, and because the first look at what is cut off of a file ends the process.
std::string fault_of(const fs::path& path, const LaterLibrary& library) {
  std::vector<std::string> notes;
  try {
    notes = abi_stamps(path.string());
  } catch (const InputError& error) {
    const std::string text = error.what(), before = "plug-in '" + path.string() + "': ";
    const std::string what = text.starts_with(before) ? text.substr(before.size()) : text;
    return what.starts_with("expected") ? "is no shared object" : what.substr(0, what.find("; expected"));
  }
  const auto note = std::find_if(notes.begin(), notes.end(),
                                 [](const std::string& text) { return text.starts_with(note_begins); });
  if (note == notes.end()) return "does not say which build of Pfaff it belongs to";
  return *note == own_note(library) ? "" : "belongs to another build of Pfaff";
}

}  // namespace

std::string path_of(const LaterLibrary& library) {
  return fs::path(object_holding(library.linked_with.back()).path).parent_path() / library.file;
}

void load_later_library(const LaterLibrary& library,
                        const std::function<void*(const std::string& path, const std::string& who)>& load) {
  const fs::path path = path_of(library);
  const std::string who = library.kind + " '" + path.string() + "'";
  std::error_code error;
  std::string fault = fs::exists(path, error) ? fault_of(path, library) : "is missing";
  if (fault.empty() && load(path.string(), who) == nullptr) {
    const char* words = dlerror();
    fault = words != nullptr ? words : "cannot be loaded";
  }
  if (!fault.empty()) throw InputError(who + ": " + fault + "; " + remedy(path, library.target));
}

}  // namespace pfaff
