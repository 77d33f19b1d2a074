// What a terminal shows: progress on stderr, tables that keep to 100 columns.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace pfaff::app {

/// One line of progress on stderr, rewritten in place; silent when stderr is not a terminal or work is quick.
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

/// Rows under a header, columns as wide as needed; where they pass 100 columns the widest are wrapped.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace pfaff::app
