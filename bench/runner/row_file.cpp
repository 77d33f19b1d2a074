#include <pfaff/bench/runner/row_file.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <pfaff/bench/runner/files.hpp>

namespace pfaff {

ReaderIsGone::ReaderIsGone() : RunError("nobody reads standard output any more") {}

RowFile::RowFile(std::filesystem::path path) : path_(std::move(path)) {
  unlink(path_.c_str());  // a link is removed, never followed
  file_ = new_file(path_);
  if (file_ < 0) throw RunError("cannot write " + path_.string() + ": " + std::strerror(errno));
}

RowFile::RowFile() : file_(STDOUT_FILENO) {}

RowFile::~RowFile() {
  if (!path_.empty() && file_ >= 0) close(file_);
}

void RowFile::take(std::string_view rows) {
  std::size_t written = 0;
  int reason = 0;
  while (written < rows.size() && reason == 0) {
    const ssize_t count = write(file_, rows.data() + written, rows.size() - written);
    if (count >= 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      reason = errno;
  }
  const std::string_view whole = rows.substr(0, rows.substr(0, written).rfind('\n') + 1);
  rows_ += std::count(whole.begin(), whole.end(), '\n');
  bytes_ += static_cast<std::int64_t>(whole.size());
  if (path_.empty()) {
    if (reason == EPIPE) throw ReaderIsGone();
  } else {
    if (reason != 0 && ftruncate(file_, bytes_) != 0) reason = errno;
    if (reason == 0 && !still_named(path_, file_))
      fail("it is no longer there: it was removed or its directory moved");
    checksum_.add(whole);
  }
  if (reason != 0) fail(std::strerror(reason));
}

void RowFile::finish() {
  const bool done = brought_to_disk(file_);
  const int reason = errno;
  if (close(std::exchange(file_, -1)) != 0 || !done) fail(std::strerror(done ? errno : reason));
}

void RowFile::fail(const std::string& reason) const {
  const std::int64_t rows = std::max<std::int64_t>(0, rows_);
  throw RunError("cannot write " + (path_.empty() ? "to standard output" : path_.string()) + ": " + reason +
                 "; " + std::to_string(rows) + (rows == 1 ? " row was" : " rows were") + " written");
}

}  // namespace pfaff
