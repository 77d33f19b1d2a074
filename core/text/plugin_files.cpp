#include <pfaff/core/text/plugin_files.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace pfaff::text {

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

bool unchanged(const FileContents& files) {
  return std::all_of(files.begin(), files.end(), [](const auto& file) {
    std::ifstream stream(file.first, std::ios::binary);
    std::ostringstream now;
    now << stream.rdbuf();
    return stream && now.str() == file.second;
  });
}

}  // namespace pfaff::text
