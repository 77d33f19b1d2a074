// source_text: a part of a file as it was written, for a number that a parser hands on as a rounded double.
#pragma once

#include <cstddef>
#include <string>

namespace pfaff {

/// Columns begin .. end - 1 of a line of `text`; lines and columns count from 1, columns in characters, not
/// bytes (UTF-8). Underscores are left out: inside a number they only separate digits.
inline std::string source_text(const std::string& text, std::size_t line, std::size_t begin,
                               std::size_t end) {
  std::size_t at = 0;
  for (std::size_t k = 1; k < line; ++k) at = text.find('\n', at) + 1;
  const auto begins_character = [&](std::size_t k) {
    return (static_cast<unsigned char>(text[k]) & 0xC0U) != 0x80U;
  };
  std::string found;
  for (std::size_t column = 0; at < text.size(); ++at) {
    column += begins_character(at) ? 1 : 0;
    if (column >= end) break;
    if (column >= begin && text[at] != '_') found += text[at];
  }
  return found;
}

}  // namespace pfaff
