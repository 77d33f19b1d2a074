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
constexpr const char* beginning = "process ";  // of what a holder writes into the file

std::string this_process(const std::string& work) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  std::array<char, 32> time{};
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::strftime(time.data(), time.size(), "%Y-%m-%d %H:%M:%S UTC", &parts);
  return beginning + std::to_string(getpid()) + " on " + host.data() + " (" + work + ") since " + time.data();
}

// The beginning of the file, which its holder has written. It is empty for an instant after the lock has been
// taken.
std::string content(int file) {
  std::array<char, 512> text{};
  const ssize_t count = pread(file, text.data(), text.size() - 1, 0);
  return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "";
}

// Opens the file, a new one where there is none; negative, with the reason in errno, where that fails. What
// stands under the name may be anybody's: links are not followed, and nothing is waited for.
int opened(const std::filesystem::path& path) {
  for (;;) {
    int file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
    file = open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file >= 0 || errno != ENOENT) return file;  // who held it has removed it
  }
}

// True where an open and locked file is one that a lock has left, or a new one, and not somebody's own file.
bool left_by_a_lock(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink != 1) return false;
  return status.st_size == 0 || content(file).starts_with(beginning);
}
}  // namespace

bool still_named(const std::filesystem::path& path, int file) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, const std::string& work)
    : path_(directory / file_name) {
  const auto refuse = [&](const std::string& reason) {
    if (file_ >= 0) close(file_);
    throw InputError("output directory '" + directory.string() + "' " + reason);
  };
  const std::string not_ours = std::string("holds something of the name ") + file_name +
                               " that Pfaff has not written; expected a directory without it";
  for (;; close(file_)) {
    file_ = opened(path_);
    if (file_ < 0 && (errno == ELOOP || errno == EISDIR || errno == ENXIO)) refuse(not_ours);
    if (file_ < 0) refuse(std::string("cannot be written to: ") + std::strerror(errno));
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) refuse(std::string("cannot be locked: ") + std::strerror(errno));
      const std::string holder = content(file_);
      refuse("is in use by " + (holder.empty() ? "another process" : holder) +
             "; expected another directory, or to start when that one has ended");
    }
    // The holder before removes the file, and who opened it before that would lock one that nobody else
    // finds.
    if (still_named(path_, file_)) break;
  }
  if (!left_by_a_lock(file_)) refuse(not_ours);
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
