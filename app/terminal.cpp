#include <pfaff/app/terminal.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace pfaff::app {

ProgressLine::ProgressLine()
    : terminal_(isatty(STDERR_FILENO) != 0), begin_(std::chrono::steady_clock::now()), last_(begin_) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const std::string& what, double fraction) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - begin_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%3.0f %%  %.80s", 100 * fraction, what.c_str());
  std::fflush(stderr);
}

namespace {
// Columns a text takes: code points, not bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}
}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t line = 100, gap = 2;
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], width(row[c]));
    }
  std::size_t indent = 0;
  for (std::size_t c = 0; c + 1 < widths.size(); ++c) indent += widths[c] + gap;
  std::ostringstream text;
  for (const auto& row : rows) {
    std::string out;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c + 1 < widths.size()) {
        out += row[c];
        if (c + 1 < row.size()) out += std::string(widths[c] - width(row[c]) + gap, ' ');
        continue;
      }
      std::istringstream words(row[c]);
      std::size_t column = indent;
      for (std::string word; words >> word;) {
        if (column > indent && column + 1 + width(word) > line) {
          out += "\n" + std::string(indent, ' ');
          column = indent;
        }
        if (column > indent) {
          out += ' ';
          ++column;
        }
        out += word;
        column += width(word);
      }
    }
    text << out << '\n';
  }
  return text.str();
}

}  // namespace pfaff::app
