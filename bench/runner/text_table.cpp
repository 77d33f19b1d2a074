#include <pfaff/bench/runner/text_table.hpp>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <optional>
#include <sstream>

namespace pfaff {

namespace {
constexpr std::size_t gap = 2;  // between two columns

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

// The number of columns that a text takes: its code points, not its bytes.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::size_t indent_of(const std::string& cell) { return std::min(cell.find_first_not_of(' '), cell.size()); }

// Where words may be broken besides between them: behind '|', which stands between names to choose from, and
// behind '(', which stands before the settings of a plug-in; with `hyphens` behind the hyphens of names too.
struct Breaks {
  bool hyphens = false;

  [[nodiscard]] bool behind(const std::string& word, std::size_t at) const {
    if (word[at] == '|' || word[at] == '(') return true;
    const auto letter = [&](std::size_t k) { return std::isalpha(static_cast<unsigned char>(word[k])) != 0; };
    return hyphens && word[at] == '-' && at > 0 && at + 1 < word.size() && letter(at - 1) && letter(at + 1);
  }
  // The parts of a word that are not broken.
  [[nodiscard]] std::vector<std::string> parts(const std::string& word) const {
    std::vector<std::string> parts{""};
    for (std::size_t at = 0; at < word.size(); ++at) {
      parts.back() += word[at];
      if (behind(word, at) && at + 1 < word.size()) parts.emplace_back();
    }
    return parts;
  }
  // The columns that the longest of these takes in a cell.
  [[nodiscard]] std::size_t least(const std::string& cell) const {
    std::size_t longest = 0;
    std::istringstream words(cell);
    for (std::string word; words >> word;)
      for (const std::string& part : parts(word)) longest = std::max(longest, width(part));
    return longest + indent_of(cell);
  }
  // A cell as lines of at most `limit` columns where its parts allow it; its indent is kept.
  [[nodiscard]] std::vector<std::string> lines(const std::string& cell, std::size_t limit) const {
    const std::size_t indent = indent_of(cell);
    std::vector<std::string> lines{std::string(indent, ' ')};
    std::istringstream words(cell);
    for (std::string word; words >> word;) {
      // A word that fits on a line of its own is broken only if it would not.
      std::vector<std::string> pieces = parts(word);
      if (indent + width(word) <= limit) pieces = {word};
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const bool begun = width(lines.back()) > indent, blank = begun && k == 0;
        if (begun && width(lines.back()) + (blank ? 1 : 0) + width(pieces[k]) > limit) {
          lines.push_back(std::string(indent, ' ') + pieces[k]);
        } else {
          lines.back() += (blank ? " " : "") + pieces[k];
        }
      }
    }
    return lines;
  }
};

TableRows printable_rows(const TableRows& rows) {
  TableRows shown = rows;
  for (auto& row : shown)
    for (std::string& cell : row) cell = printable(cell);
  return shown;
}

// For each column the largest of what `measure` gives for its cells.
template <class Measure>
std::vector<std::size_t> largest(const TableRows& rows, const Measure& measure) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], measure(row[c]));
    }
  return widths;
}

std::size_t line_of(const std::vector<std::size_t>& widths) {
  return std::accumulate(widths.begin(), widths.end(), widths.empty() ? 0 : gap * (widths.size() - 1));
}

// Widths of which a line takes at most `columns`: the widest columns are made narrower, none of them below
// its least width. Nothing where that does not fit.
std::optional<std::vector<std::size_t>> fitted(std::vector<std::size_t> widths,
                                               const std::vector<std::size_t>& least, std::size_t columns) {
  while (line_of(widths) > columns) {
    std::size_t widest = widths.size();
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (widths[c] > least[c] && (widest == widths.size() || widths[c] > widths[widest])) widest = c;
    if (widest == widths.size()) return std::nullopt;
    --widths[widest];
  }
  return widths;
}

std::string without_blanks_at_the_end(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

// The rows with their texts wrapped at these widths, in columns as wide as the lines that this gives.
std::string laid_out(const TableRows& rows, const std::vector<std::size_t>& limits, const Breaks& breaks) {
  std::vector<TableRows> cells;  // of each row the lines of each cell
  std::vector<std::size_t> widths(limits.size(), 0);
  for (const auto& row : rows) {
    cells.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      cells.back().push_back(breaks.lines(row[c], limits[c]));
      for (const std::string& line : cells.back().back()) widths[c] = std::max(widths[c], width(line));
    }
  }
  std::string text;
  for (const TableRows& row : cells) {
    std::size_t height = 1;
    for (const auto& lines : row) height = std::max(height, lines.size());
    for (std::size_t k = 0; k < height; ++k) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::string part = k < row[c].size() ? row[c][k] : "";
        line += part + std::string(widths[c] + gap - width(part), ' ');
      }
      text += without_blanks_at_the_end(line);
    }
  }
  return text;
}

// Every row as a block: its first cell, and below it the others with their heads.
std::string blocks(const TableRows& rows, std::size_t columns) {
  std::string text;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    TableRows lines;
    for (std::size_t c = 1; c < rows[r].size(); ++c)
      if (!rows[r][c].empty()) lines.push_back({"    " + rows[0][c], rows[r][c]});
    text += facts({{rows[r].empty() ? "" : rows[r][0]}}, columns) + facts(lines, columns);
  }
  return text;
}

void leave_out(TableRows& rows, const std::string& head) {
  for (std::size_t c = rows.front().size(); c-- > 0;)
    if (rows.front()[c] == head)
      for (auto& row : rows)
        if (c < row.size()) row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
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

std::size_t terminal_columns() {
  constexpr std::size_t without_terminal = 100, fewest = 40;
  if (const char* text = std::getenv("COLUMNS"); text != nullptr) {
    std::size_t columns = 0;
    const auto [end, error] = std::from_chars(text, text + std::strlen(text), columns);
    if (error == std::errc() && *end == '\0' && columns > 0) return std::max(columns, fewest);
  }
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::max<std::size_t>(size.ws_col, fewest);
  return without_terminal;
}

std::string table(const TableRows& raw, const std::vector<std::string>& dispensable, std::size_t columns) {
  constexpr std::size_t comfortable = 16;  // texts are not wrapped below this while that can be avoided
  if (raw.empty()) return {};
  TableRows rows = printable_rows(raw);
  const Breaks words, names{true};
  const auto fits = [&](const Breaks& breaks, std::size_t at_least) {
    const auto natural = largest(rows, [](const std::string& cell) { return width(cell); });
    auto least = largest(rows, [&](const std::string& cell) { return breaks.least(cell); });
    for (std::size_t c = 0; c < least.size(); ++c)
      least[c] = std::max(least[c], std::min(natural[c], at_least));
    return fitted(natural, least, columns);
  };
  if (const auto widths = fits(words, comfortable)) return laid_out(rows, *widths, words);
  auto widths = fits(words, 0);
  std::string missing;
  for (std::size_t k = 0; !widths && k < dispensable.size(); ++k) {
    leave_out(rows, dispensable[k]);
    missing += (missing.empty() ? "" : ", ") + dispensable[k];
    widths = fits(words, 0);
  }
  if (!missing.empty())
    missing =
        paragraph("(" + std::to_string(columns) + " columns leave no room for: " + missing + ")", columns);
  if (widths) return laid_out(rows, *widths, words) + missing;
  if ((widths = fits(names, 0))) return laid_out(rows, *widths, names) + missing;
  return blocks(rows, columns) + missing;
}

std::string facts(const TableRows& raw, std::size_t columns) {
  const TableRows rows = printable_rows(raw);
  const Breaks breaks;
  std::vector<std::size_t> widths = largest(rows, [](const std::string& cell) { return width(cell); });
  if (widths.size() < 2) {
    std::string text;
    for (const auto& row : rows)
      if (!row.empty()) text += laid_out({row}, {columns}, breaks);
    return text;
  }
  const std::size_t longest = largest(rows, [&](const std::string& cell) { return breaks.least(cell); })[0];
  widths[0] = std::max(std::min(widths[0], columns / 2 - gap), longest);
  widths[1] = columns - std::min(widths[0] + gap, columns / 2 + columns / 4);
  return laid_out(rows, widths, breaks);
}

std::string paragraph(const std::string& text, std::size_t columns) {
  std::string lines;
  for (const std::string& line : Breaks().lines(printable(text), std::min<std::size_t>(columns, 80)))
    lines += line + '\n';
  return lines;
}

}  // namespace pfaff
