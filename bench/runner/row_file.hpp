// Where the rows of a table go while a run goes: a file, or standard output.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/running_checksum.hpp>

namespace pfaff {

/// Thrown where the reader of standard output has closed its end (`| head`).
struct ReaderIsGone : RunError {
  ReaderIsGone();
};

/// Takes rows as they come. Whatever ends the table, the rows that were written stay: where the disk is full,
/// the file is longer than it may be, or is no longer there under its name, RunError says so in one line with
/// the number of rows, and the file ends with a whole one.
class RowFile {
 public:
  /// A new file, in the place of one that is there.
  explicit RowFile(std::filesystem::path path);
  /// Standard output. ReaderIsGone where nobody reads it any more.
  RowFile();
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Takes whole rows, of which the first is the head of the table.
  void take(std::string_view rows);
  /// Brings the file to the disk.
  void finish();
  /// Of all that was taken.
  [[nodiscard]] std::string checksum() const { return checksum_.digits(); }

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;  // empty: standard output
  int file_;
  std::int64_t rows_ = -1, bytes_ = 0;  // written as a whole: rows behind the head
  RunningChecksum checksum_;
};

}  // namespace pfaff
