#include <pfaff/core/text/plugin_files.hpp>

#include <filesystem>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/input_file.hpp>

namespace pfaff::text {

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

bool unchanged(const FileContents& files) {
  return std::all_of(files.begin(), files.end(), [](const auto& file) {
    try {
      return read_file(file.first) == file.second;
    } catch (const InputError&) {
      return false;
    }
  });
}

}  // namespace pfaff::text
