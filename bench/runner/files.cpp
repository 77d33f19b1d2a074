#include <pfaff/bench/runner/files.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <pfaff/core/registry/errors.hpp>

namespace pfaff {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  const fs::path temporary = path.string() + ".part";
  errno = 0;
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    file.close();
    if (!file) {
      const std::string reason = errno != 0 ? std::strerror(errno) : "write failed";
      std::error_code ignored;
      fs::remove(temporary, ignored);
      throw RunError("cannot write " + path.string() + ": " + reason);
    }
  }
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) throw RunError("cannot write " + path.string() + ": " + error.message());
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) throw InputError("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void make_output_directory(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !(fs::is_directory(path, error) && fs::is_empty(path, error)))
    throw InputError("output directory '" + path.string() +
                     "' exists already; expected a new or an empty one");
  fs::create_directories(path, error);
  if (error) throw InputError("output directory '" + path.string() + "' cannot be made: " + error.message());
  const fs::path probe = path / ".probe";
  try {
    write_file(probe, "\n");
  } catch (const RunError&) {
    throw InputError("output directory '" + path.string() + "' cannot be written to");
  }
  fs::remove(probe, error);
}

fs::path data_directory() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    fs::path installed = program.parent_path().parent_path() / PFAFF_INSTALLED_DATA;
    if (fs::exists(installed / "experiments", error)) return installed;
  }
  return fs::path(PFAFF_SOURCE_DIRECTORY) / "bench";
}

}  // namespace pfaff
