// A lock on an output directory, so that two processes never write to it at the same time.
#pragma once

#include <filesystem>
#include <string>

namespace pfaff {

/// True where `path` still names the open file.
[[nodiscard]] bool still_named(const std::filesystem::path& path, int file);

/// Holds a directory while it lives. The lock is one of the operating system (flock) on a file in the
/// directory, so that it ends with its process, however that ends; a file that is left over locks nothing.
class DirectoryLock {
 public:
  static constexpr const char* file_name = ".lock";

  /// Locks an existing directory for `work`, a few words such as "pfaff run". InputError, saying which
  /// process works there and since when, where another one holds it, where the directory cannot be written
  /// to, and where something stands under the name of the file that no lock has left.
  DirectoryLock(const std::filesystem::path& directory, const std::string& work);
  /// Removes the file and lets go.
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace pfaff
