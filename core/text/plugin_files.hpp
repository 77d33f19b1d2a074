// Plug-ins that files describe: read once for each content of their files, and kept until the program ends,
// because models and methods that were made of them refer to them.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace pfaff::text {

/// The files that a plug-in was made of, its own before those that it names: absolute paths, and what they
/// contained.
using FileContents = std::vector<std::pair<std::string, std::string>>;

/// The absolute path of a file, without dots.
std::string absolute_path(const std::string& path);
/// True where every file still contains what it contained.
bool unchanged(const FileContents& files);

/// The plug-ins of one kind, P, that were read from files. P says by files() what it was made of.
template <class P>
class PluginFiles {
 public:
  /// The plug-in that was made of the file, as long as the files that it was made of are what they were;
  /// else what read(path) makes of them, an owning pointer. Calls of several threads wait for each other.
  template <class Read>
  const P& get(const std::string& path, Read&& read) {
    const std::string absolute = absolute_path(path);
    const std::lock_guard lock(mutex_);
    for (const auto& plugin : kept_)
      if (plugin->files().front().first == absolute && unchanged(plugin->files())) return *plugin;
    return *kept_.emplace_back(read(path));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<const P>> kept_;
};

}  // namespace pfaff::text
