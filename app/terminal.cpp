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

namespace {
// A cell as lines of at most `limit` columns, broken between words; its indent is kept.
std::vector<std::string> wrapped(const std::string& cell, std::size_t limit) {
  const std::size_t indent = std::min(cell.find_first_not_of(' '), cell.size());
  std::vector<std::string> lines{std::string(indent, ' ')};
  std::istringstream words(cell);
  for (std::string word; words >> word;) {
    const bool begun = width(lines.back()) > indent;
    if (begun && width(lines.back()) + 1 + width(word) > limit) {
      lines.push_back(std::string(indent, ' ') + word);
    } else {
      lines.back() += (begun ? " " : "") + word;
    }
  }
  return lines;
}
}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t line = 100, gap = 2, narrowest = 16;
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], width(row[c]));
    }
  // Too wide a table gives up room in its widest columns.
  for (;;) {
    std::size_t all = widths.empty() ? 0 : gap * (widths.size() - 1);
    for (const std::size_t w : widths) all += w;
    const auto widest = std::max_element(widths.begin(), widths.end());
    if (all <= line || *widest <= narrowest) break;
    std::size_t next = narrowest;  // no narrower than the runner-up, which then shares the loss
    for (auto w = widths.begin(); w != widths.end(); ++w)
      if (w != widest) next = std::max(next, *w);
    const std::size_t fits = *widest > all - line ? *widest - (all - line) : 0;
    *widest = std::min(*widest - 1, std::max(fits, next));
  }
  std::ostringstream text;
  for (const auto& row : rows) {
    std::vector<std::vector<std::string>> cells;
    std::size_t height = 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      cells.push_back(wrapped(row[c], widths[c]));
      height = std::max(height, cells.back().size());
    }
    for (std::size_t k = 0; k < height; ++k) {
      std::string out;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::string part = k < cells[c].size() ? cells[c][k] : "";
        out += part + std::string(widths[c] + gap - std::min(width(part), widths[c] + gap - 1), ' ');
      }
      const std::size_t end = out.find_last_not_of(' ');
      text << out.substr(0, end == std::string::npos ? 0 : end + 1) << '\n';
    }
  }
  return text.str();
}

}  // namespace pfaff::app
