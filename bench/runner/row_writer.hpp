// A table that is written row by row, through one buffer.
#pragma once

#include <chrono>
#include <functional>
#include <string_view>
#include <vector>

#include <pfaff/bench/runner/decimal_text.hpp>

namespace pfaff {

/// Puts rows of cells, with commas between them, into a buffer, and passes whole rows on: when the buffer is
/// full, and at the end of the first row and of every row that comes when some time has passed.
class RowWriter {
 public:
  using Destination = std::function<void(std::string_view rows)>;
  explicit RowWriter(Destination destination);
  /// Passes on the rows that are left, also where an exception ends the table. What the destination throws
  /// then is not passed: flush() before tells of it.
  ~RowWriter();
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  /// A cell, as it stands.
  void text(std::string_view cell);
  /// A number in all digits.
  template <class T>
  void number(const T& x) {
    begin_cell(longest_decimal);
    end_ = put_decimal(end_, x);
  }
  void end_row();
  /// Passes on all whole rows.
  void flush();

 private:
  using Clock = std::chrono::steady_clock;
  void begin_cell(std::size_t size);
  void make_room(std::size_t size);

  Destination destination_;
  std::vector<char> buffer_;
  char *end_, *whole_;  // of what the buffer holds, and of its last whole row
  bool in_row_ = false;
  Clock::time_point flushed_{};
};

}  // namespace pfaff
