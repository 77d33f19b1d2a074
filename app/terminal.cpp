#include <pfaff/app/terminal.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

namespace pfaff::app {

namespace {
// The number of bytes of the character that begins at `at`; 0 where no character of UTF-8 does.
std::size_t length_of_character(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(at);
  if (first < 0x80U) return 1;
  const std::size_t length = first >= 0xC2U && first < 0xE0U   ? 2
                             : first >= 0xE0U && first < 0xF0U ? 3
                             : first >= 0xF0U && first < 0xF5U ? 4
                                                               : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(at + k) & 0xC0U) != 0x80U) return 0;
  return length;
}

bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20U || first == 0x7FU;
  return first == 0xC2U && static_cast<unsigned char>(character[1]) < 0xA0U;
}
}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(text, at);
    const std::string_view character = text.substr(at, std::max<std::size_t>(length, 1));
    if (character == "\t") {
      shown += ' ';
    } else if (length == 0 || (character != "\n" && is_control(character))) {
      shown += "\uFFFD";
    } else {
      shown += character;
    }
    at += character.size();
  }
  return shown;
}

std::string json_text(const nlohmann::json& document) {
  return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string scientific(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", x);
  return text.data();
}

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
  std::fprintf(stderr, "\r\033[K%3.0f %%  %.80s", 100 * fraction, printable(what).c_str());
  std::fflush(stderr);
}

namespace {
// The number of columns that a text takes: its code points, not its bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}
}  // namespace

namespace {
// A word cut into parts of at most `limit` columns where that is possible: behind '|', which stands between
// names to choose from, and behind '(', which stands before the settings of a plug-in.
std::vector<std::string> parts_of(const std::string& word, std::size_t limit) {
  std::vector<std::string> parts{""};
  for (std::size_t begin = 0; begin < word.size();) {
    const std::size_t end = std::min(word.find_first_of("|(", begin), word.size() - 1) + 1;
    const std::string part = word.substr(begin, end - begin);
    if (!parts.back().empty() && width(parts.back() + part) > limit) parts.emplace_back();
    parts.back() += part;
    begin = end;
  }
  return parts;
}

// A cell as lines of at most `limit` columns, broken between words; its indent is kept.
std::vector<std::string> wrapped(const std::string& cell, std::size_t limit) {
  const std::size_t indent = std::min(cell.find_first_not_of(' '), cell.size());
  std::vector<std::string> lines{std::string(indent, ' ')};
  std::istringstream words(cell);
  for (std::string word; words >> word;) {
    const std::vector<std::string> parts = parts_of(word, limit - std::min(indent, limit));
    const bool begun = width(lines.back()) > indent;
    if (begun && width(lines.back()) + 1 + width(parts.front()) > limit) {
      lines.push_back(std::string(indent, ' ') + parts.front());
    } else {
      lines.back() += (begun ? " " : "") + parts.front();
    }
    for (std::size_t k = 1; k < parts.size(); ++k) lines.push_back(std::string(indent, ' ') + parts[k]);
  }
  return lines;
}
}  // namespace

std::string table(const std::vector<std::vector<std::string>>& raw) {
  constexpr std::size_t line = 100, gap = 2, narrowest = 16;
  std::vector<std::vector<std::string>> rows = raw;
  for (auto& row : rows)
    for (std::string& cell : row) cell = printable(cell);
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], width(row[c]));
    }
  // Where the table is too wide, its widest columns are made narrower.
  for (;;) {
    std::size_t all = widths.empty() ? 0 : gap * (widths.size() - 1);
    for (const std::size_t w : widths) all += w;
    const auto widest = std::max_element(widths.begin(), widths.end());
    if (all <= line || *widest <= narrowest) break;
    std::size_t next = narrowest;  // the widest shrinks to the next widest, then both shrink
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

std::string paragraph(const std::string& text) {
  std::string lines;
  for (const std::string& line : wrapped(printable(text), 80)) lines += line + '\n';
  return lines;
}

}  // namespace pfaff::app
