#include <pfaff/bench/runner/directory_lock.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
std::string this_process(const std::string& work) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  std::array<char, 32> time{};
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::strftime(time.data(), time.size(), "%Y-%m-%d %H:%M:%S UTC", &parts);
  return "process " + std::to_string(getpid()) + " on " + host.data() + " (" + work + ") since " +
         time.data();
}

// What the holder has written into the file. It is empty for an instant after the lock has been taken.
std::string holder(int file) {
  std::array<char, 512> text{};
  const ssize_t count = pread(file, text.data(), text.size() - 1, 0);
  return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "another process";
}

// True where `path` still names the open file. The holder before removes the file, and who opened it before
// that would lock a file that nobody else can find.
bool still_named(const std::filesystem::path& path, int file) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}
}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, const std::string& work)
    : path_(directory / file_name) {
  const auto refuse = [&](const std::string& reason) {
    if (file_ >= 0) close(file_);
    throw InputError("output directory '" + directory.string() + "' " + reason);
  };
  for (;;) {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) refuse(std::string("cannot be written to: ") + std::strerror(errno));
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) refuse(std::string("cannot be locked: ") + std::strerror(errno));
      refuse("is in use by " + holder(file_) +
             "; expected another directory, or to start when that one has ended");
    }
    if (still_named(path_, file_)) break;
    close(file_);
  }
  const std::string text = this_process(work);
  if (ftruncate(file_, 0) != 0 ||
      pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const std::string reason = std::strerror(errno);
    unlink(path_.c_str());
    refuse("cannot be written to: " + reason);
  }
}

DirectoryLock::~DirectoryLock() {
  unlink(path_.c_str());  // before the lock is let go, so that nobody else's file is removed
  close(file_);
}

}  // namespace pfaff
