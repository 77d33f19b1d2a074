#include <pfaff/bench/runner/files.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace fs = std::filesystem;

// Some file systems cannot do it for directories and say EINVAL, which is no failure.
bool brought_to_disk(int file) { return fsync(file) == 0 || errno == EINVAL; }

int new_file(const fs::path& path) {
  return open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
}

namespace {
bool directory_brought_to_disk(const fs::path& path) {
  const int directory = open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return false;
  const bool done = brought_to_disk(directory);
  close(directory);
  return done;
}

// Writes all of the text, and brings it to the disk; true where that worked, otherwise errno says why.
bool written(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = write(file, text.data() + at, text.size() - at);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) at += static_cast<std::size_t>(count);
  }
  return brought_to_disk(file);
}
}  // namespace

std::optional<std::string> text_in(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  try {
    return read_file(path, std::numeric_limits<std::uint64_t>::max());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void check_new_file(const fs::path& path, const std::string& option) {
  const std::string where = option + " '" + path.string() + "': ";
  const int file = new_file(path);
  if (file < 0 && errno == EEXIST) throw InputError(where + "exists already; expected a new file");
  if (file < 0) throw InputError(where + "cannot be made: " + std::strerror(errno));
  close(file);
  unlink(path.c_str());
}

void write_new_file(const fs::path& path, const std::string& text) {
  const auto fail = [&](int reason) {
    throw RunError("cannot write " + path.string() + ": " + std::strerror(reason));
  };
  const int file = new_file(path);
  if (file < 0) fail(errno);
  int reason = written(file, text) ? 0 : errno;
  if (close(file) != 0 && reason == 0) reason = errno;
  if (reason == 0) return;
  unlink(path.c_str());
  fail(reason);
}

void write_file(const fs::path& path, const std::string& text) {
  const fs::path temporary = path.string() + ".part";
  const auto fail = [&](const std::string& reason) {
    throw RunError("cannot write " + path.string() + ": " + reason);
  };
  // What a program that was killed has left goes first. A link is removed, never followed: what it leads to
  // is not ours.
  unlink(temporary.c_str());
  const int file = new_file(temporary);
  if (file < 0) fail(std::strerror(errno));
  const auto give_up = [&](const std::string& reason) {
    unlink(temporary.c_str());
    fail(reason);
  };
  const bool whole = written(file, text);
  const int reason = errno;
  if (close(file) != 0 && whole) give_up(std::strerror(errno));
  if (!whole) give_up(std::strerror(reason));
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) give_up(error.message());
  if (!directory_brought_to_disk(path.parent_path())) fail(std::strerror(errno));
}

void rename_directory(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error && !directory_brought_to_disk(to.parent_path())) error.assign(errno, std::generic_category());
  if (error) throw RunError("cannot write " + to.string() + ": " + error.message());
}

namespace {
// True where the path is anything but a directory that may be taken for output of ours: one that is new,
// holds the file `sign`, or holds nothing but `ours` and what an interrupted program leaves.
bool taken(const fs::path& path, const std::vector<std::string>& ours, const std::string& sign) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return fs::exists(fs::symlink_status(path, error));
  if (!sign.empty() && fs::exists(path / sign, error)) return false;
  const auto is_ours = [&](const fs::path& file) {
    const fs::path whole = file.extension() == ".part" ? file.stem() : file;
    return file == DirectoryLock::file_name || std::find(ours.begin(), ours.end(), whole) != ours.end();
  };
  fs::directory_iterator entries(path, error);
  return error || !std::all_of(begin(entries), end(entries),
                               [&](const auto& entry) { return is_ours(entry.path().filename()); });
}
}  // namespace

std::unique_ptr<DirectoryLock> take_output_directory(const fs::path& path, const std::string& work,
                                                     const std::vector<std::string>& ours,
                                                     const std::string& sign) {
  const auto refuse_what_is_taken = [&] {
    if (taken(path, ours, sign))
      throw InputError("output directory '" + path.string() +
                       "' exists already; expected a new or an empty one");
  };
  std::error_code error;
  // Whoever works in a directory has filled it, too, and says more than that it is there.
  if (fs::is_regular_file(fs::symlink_status(path / DirectoryLock::file_name, error)))
    (void)DirectoryLock(path, work);
  refuse_what_is_taken();
  fs::create_directories(path, error);
  if (error) throw InputError("output directory '" + path.string() + "' cannot be made: " + error.message());
  auto lock = std::make_unique<DirectoryLock>(path, work);
  refuse_what_is_taken();  // by one who held the lock before
  return lock;
}

fs::path program_path() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

namespace {
// The folder of this library. The program may be anybody's, such as an interpreter.
fs::path library_folder() {
  static const fs::path found = [] {
    Dl_info library{};
    std::error_code error;
    if (dladdr(reinterpret_cast<const void*>(&data_directory), &library) == 0 || library.dli_fname == nullptr)
      return fs::path();
    return fs::canonical(library.dli_fname, error).parent_path();
  }();
  return found;
}

// Beside the folder of the library, which may be one of several below `lib`.
fs::path installed_data() {
  const fs::path folder = library_folder().parent_path();
  std::error_code error;
  if (fs::path above = folder.parent_path() / PFAFF_INSTALLED_DATA;
      folder.filename() == "lib" && fs::exists(above / "experiments", error))
    return above;
  return folder / PFAFF_INSTALLED_DATA;
}

// True of a library in a build tree of the source tree, which is known by its cache.
bool stands_in_build_tree() {
  const std::string line = "\nCMAKE_HOME_DIRECTORY:INTERNAL=" PFAFF_SOURCE_DIRECTORY "\n";
  std::error_code error;
  for (fs::path folder = library_folder();; folder = folder.parent_path()) {
    if (const fs::path cache = folder / "CMakeCache.txt"; fs::is_regular_file(cache, error))
      return read_file(cache).find(line) != std::string::npos;
    if (!folder.has_relative_path()) return false;
  }
}
}  // namespace

std::optional<fs::path> find_data_directory() {
  static const std::optional<fs::path> found = []() -> std::optional<fs::path> {
    std::error_code error;
    if (fs::exists(installed_data() / "experiments", error)) return installed_data();
    // Scripts are run from there. Elsewhere the path of the source tree may be anybody's.
    if (stands_in_build_tree()) return fs::path(PFAFF_SOURCE_DIRECTORY) / "bench";
    return std::nullopt;
  }();
  return found;
}

fs::path data_directory() {
  if (const auto found = find_data_directory()) return *found;
  throw InputError("the experiments and the scripts of reports are missing; expected them in '" +
                   installed_data().string() + "', as they are installed with the program");
}

fs::path shipped_path(const fs::path& name) {
  const fs::path installed = data_directory() / name;
  std::error_code error;
  return fs::exists(installed, error) ? installed : data_directory().parent_path() / name;
}

}  // namespace pfaff
