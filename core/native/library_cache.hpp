// The directory in which compiled libraries are kept: $XDG_CACHE_HOME/pfaff-native or ~/.cache/pfaff-native.
//
// A library stands beside the text that it was made of, under the checksum of this text, and the text ends
// with the checksum of the library. Both are compared before the library is loaded: what a fault of the disk
// or a full one left is made anew. Files are made in a directory of their own, brought to the disk and then
// renamed, so that programs may share the cache; what a killed program left of that is removed by the next.
#pragma once

#include <filesystem>
#include <string>

namespace pfaff::native {

/// The user's cache, made where it is not there. RunError where it cannot be used: code is loaded from it, so
/// it must be the user's own and closed to everybody else.
class LibraryCache {
 public:
  LibraryCache();
  /// True where the library of the text is there and undamaged.
  [[nodiscard]] bool holds(const std::string& text) const;
  /// The path of the library of the text.
  [[nodiscard]] std::filesystem::path library(const std::string& text) const;
  /// Takes the library of the text, a file of a workshop. RunError where it cannot be written.
  void keep(const std::string& text, const std::filesystem::path& made) const;
  /// Keeps what a compiler said of the text, and returns its path.
  [[nodiscard]] std::filesystem::path keep_messages(const std::string& text, const std::string& said) const;

 private:
  friend class Workshop;
  [[nodiscard]] std::filesystem::path file(const std::string& text, const char* extension) const;
  void remove_abandoned() const;
  std::filesystem::path directory_;
};

/// A directory of one compilation in the cache, removed at the end. It is locked as long as the process
/// lives, by which others know that it is in use.
class Workshop {
 public:
  explicit Workshop(const LibraryCache& cache);
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

/// Writes a text and brings it to the disk. RunError where that fails.
void write_durably(const std::filesystem::path& path, const std::string& text);

}  // namespace pfaff::native
