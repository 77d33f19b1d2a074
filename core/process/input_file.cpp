#include <pfaff/core/process/input_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

// An open file that is closed at the end.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : number_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (number_ >= 0) close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};
}  // namespace

std::string read_file(const std::filesystem::path& path, std::uint64_t longest) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("cannot read " + path.string() + ": " + why);
  };
  struct stat status {};
  const auto require_regular = [&] {
    if (!S_ISREG(status.st_mode))
      refuse(std::string("it is ") + kind_of(status.st_mode) + "; expected a regular file");
  };
  // It is looked at before it is opened, and what was opened again: it may have been replaced in between.
  if (stat(path.c_str(), &status) != 0) refuse(std::strerror(errno));
  require_regular();
  const OpenFile file(path);
  if (file.number() < 0 || fstat(file.number(), &status) != 0) refuse(std::strerror(errno));
  require_regular();
  // The size is a hint only: files of /proc have none, and a file may grow while it is read.
  constexpr std::uint64_t block = 1U << 16U;
  const auto size = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
  std::string text;
  for (std::uint64_t length = 0;;) {
    if (size > longest || length > longest)
      refuse("it has more than " + std::to_string(longest) + " bytes, the most that an input may have");
    text.resize(std::max(length < size ? size : 0, length) + block);
    const ssize_t count = read(file.number(), text.data() + length, text.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(std::strerror(errno));
    length += static_cast<std::uint64_t>(count);
    if (count > 0) continue;
    text.resize(length);
    return text;
  }
}

}  // namespace pfaff
