#include <pfaff/core/text/source.hpp>

#include <algorithm>

namespace pfaff::text {

namespace {
bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

// A line of text with everything that a terminal would not show as one character made a space.
std::string shown(std::string_view line) {
  std::string text(line);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = ' ';
  return text;
}
}  // namespace

void refuse(const Source& source, std::size_t offset, const std::string& message) {
  const std::string_view text = source.text;
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  const auto lines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t begin = lines == 0 ? 0 : before.rfind('\n') + 1;
  const std::size_t end = std::min(text.find('\n', offset), text.size());
  // Of a very long line only what is near the place is shown.
  constexpr std::size_t around = 60;
  std::size_t first = offset - begin > around ? offset - around : begin;
  while (first < offset && !begins_character(text[first])) ++first;
  std::size_t last = std::min(end, offset + around);
  while (last < end && !begins_character(text[last])) ++last;
  const std::size_t column =
      characters(text.substr(begin, offset - begin)) + (lines == 0 ? source.column : 1);
  const std::string caret(characters(text.substr(first, offset - first)), ' ');
  throw TextError(source.file + ":" + std::to_string(source.line + lines) + ":" + std::to_string(column) +
                      ": " + shown(message),
                  text.empty() ? "" : "  " + shown(text.substr(first, last - first)) + "\n  " + caret + "^");
}

void refuse_json(const Source& source, std::size_t read, const std::string& token,
                 const std::string& expected) {
  // The place is that of the last byte that was read.
  refuse(source, read == 0 ? 0 : read - 1,
         expected + (read > source.text.size() ? ", which ends unfinished" : ", got '" + token + "'"));
}

}  // namespace pfaff::text
