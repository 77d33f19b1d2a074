// The text of cells in CSV files.
#pragma once

#include <string>

#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

/// The text as a CSV cell, quoted where it contains a comma, a quotation mark or a line break.
inline std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

}  // namespace pfaff
