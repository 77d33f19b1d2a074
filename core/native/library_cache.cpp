#include <pfaff/core/native/library_cache.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/core/process/input_file.hpp>

namespace pfaff::native {

namespace fs = std::filesystem;

namespace {
constexpr const char* workshop_name = "making-";

[[noreturn]] void fail_to_write(const fs::path& path) {
  throw RunError("cannot write '" + path.string() + "': " + std::strerror(errno));
}

// What a file holds; empty where it cannot be read.
std::string content(const fs::path& path) {
  try {
    return read_file(path, std::numeric_limits<std::uint64_t>::max());
  } catch (const InputError&) {
    return {};
  }
}

// The text as it is kept, with the checksum of its library.
std::string with_checksum(const std::string& text, const std::string& library) {
  return text + "\n// SHA-1 of the library: " + sha1_of(library) + "\n";
}

void bring_to_disk(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_to_write(path);
  // Some file systems cannot do it for directories and say EINVAL.
  const bool done = fsync(file) == 0 || errno == EINVAL;
  const int reason = errno;
  close(file);
  errno = reason;
  if (!done) fail_to_write(path);
}

// Renames a file whose bytes are on the disk.
void move(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail_to_write(to);
}

// The directory, open and locked, or -1 where somebody else has locked it or it is gone.
int locked(const fs::path& directory, int wait_or_not) {
  const int file = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return -1;
  struct stat status {};
  // One that was removed before it was locked has no link any more.
  if (flock(file, LOCK_EX | wait_or_not) == 0 && fstat(file, &status) == 0 && status.st_nlink > 0)
    return file;
  close(file);
  return -1;
}
}  // namespace

LibraryCache::LibraryCache() {
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  fs::path parent;
  if (xdg != nullptr && xdg[0] == '/') {
    parent = xdg;
  } else if (home != nullptr && home[0] == '/') {
    parent = fs::path(home) / ".cache";
  } else {
    throw RunError(
        "compiled formulas are kept in $XDG_CACHE_HOME or ~/.cache; expected one of them to be set");
  }
  std::error_code ignored;
  fs::create_directories(parent, ignored);
  directory_ = parent / "pfaff-native";
  if (mkdir(directory_.c_str(), 0700) != 0 && errno != EEXIST)
    throw RunError("cannot make the directory '" + directory_.string() + "': " + std::strerror(errno));
  struct stat status {};
  if (lstat(directory_.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & 0077U) != 0)
    throw RunError("compiled formulas are loaded from '" + directory_.string() +
                   "'; expected a directory of the user's own that is closed to others (chmod 700)");
  remove_abandoned();
}

void LibraryCache::remove_abandoned() const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory_, ignored)) {
    if (!entry.path().filename().string().starts_with(workshop_name)) continue;
    const int lock = locked(entry.path(), LOCK_NB);
    if (lock < 0) continue;
    fs::remove_all(entry.path(), ignored);
    close(lock);
  }
}

fs::path LibraryCache::file(const std::string& text, const char* extension) const {
  return directory_ / (sha1_of(text) + extension);
}

fs::path LibraryCache::library(const std::string& text) const { return file(text, ".so"); }

bool LibraryCache::holds(const std::string& text) const {
  const std::string kept = content(file(text, ".cpp"));
  return kept.starts_with(text) && kept == with_checksum(text, content(library(text)));
}

void LibraryCache::keep(const std::string& text, const fs::path& made) const {
  const fs::path source = made.string() + ".kept";
  bring_to_disk(made);
  write_durably(source, with_checksum(text, content(made)));
  // The library goes first: what stands beside another text is not loaded.
  move(made, library(text));
  move(source, file(text, ".cpp"));
  bring_to_disk(directory_);
  std::error_code ignored;
  fs::remove(file(text, ".log"), ignored);
}

fs::path LibraryCache::keep_messages(const std::string& text, const std::string& said) const {
  const Workshop workshop(*this);
  const fs::path log = workshop.path() / "log";
  write_durably(log, said);
  move(log, file(text, ".log"));
  return file(text, ".log");
}

Workshop::Workshop(const LibraryCache& cache) {
  // Another program may take it for abandoned between the two calls, and remove it.
  for (int attempt = 0; lock_ < 0 && attempt < 100; ++attempt) {
    std::string name = (cache.directory_ / workshop_name).string() + "XXXXXX";
    if (mkdtemp(name.data()) == nullptr) fail_to_write(name);
    path_ = name;
    lock_ = locked(path_, 0);
  }
  if (lock_ < 0) fail_to_write(path_);
}

Workshop::~Workshop() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  close(lock_);
}

void write_durably(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  if (content(path) != text) fail_to_write(path);
  bring_to_disk(path);
}

}  // namespace pfaff::native
