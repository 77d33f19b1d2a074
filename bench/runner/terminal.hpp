// What commands show in the terminal: progress on stderr, numbers, JSON; tables and paragraphs come with it.
#pragma once

#include <chrono>
#include <string>

#include <pfaff/bench/runner/json.hpp>
#include <pfaff/bench/runner/text_table.hpp>

namespace pfaff {

/// A JSON document as the commands print it, with a line end. Bytes that are no UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& document);

/// A number with three digits, as in 1.23e-05.
std::string scientific(double x);

/// One line of progress on stderr, rewritten in place. It stays silent when asked to be `quiet`, when stderr
/// is not a terminal, and when the work is done before there is anything to show.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
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

}  // namespace pfaff
