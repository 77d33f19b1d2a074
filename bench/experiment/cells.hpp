// The text of cells in CSV files.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace pfaff {

/// A number by a format of printf.
inline std::string as_text(double x, const char* format) {
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), format, x);
  return {text.data(), static_cast<std::size_t>(length)};
}

/// The text as a CSV cell, quoted where it contains a comma, a quotation mark or a line break.
inline std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

}  // namespace pfaff
