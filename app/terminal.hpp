// Text for the terminal: progress on stderr, tables of at most 100 columns, paragraphs of at most 80.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

namespace pfaff::app {

/// Text that a terminal shows and does not obey: control characters, which could move the cursor, change
/// colours or the window's title, and bytes that are no UTF-8 become U+FFFD, tabulators blanks. Line ends are
/// kept.
std::string printable(std::string_view text);

/// A JSON document as the commands print it, with a line end. Bytes that are no UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& document);

/// A number with three digits, as in 1.23e-05.
std::string scientific(double x);

/// One line of progress on stderr, rewritten in place. It stays silent when stderr is not a terminal, or when
/// the work is done before there is anything to show.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  /// Shows `what` and the fraction done, at most ten times a second.
  void show(const std::string& what, double fraction);

 private:
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point begin_, last_;
};

/// The rows as a table with the first row as header. Columns are as wide as their texts need; where the table
/// would pass 100 columns, the texts of the widest are wrapped. Cells are made printable.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// Text as printable lines of at most 80 columns, broken between words.
std::string paragraph(const std::string& text);

}  // namespace pfaff::app
