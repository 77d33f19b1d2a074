// A table of coefficients as it stands in its file: TOML whose numbers are exact.
//
// A number is a TOML number, of which every digit counts, or a text: a fraction "a/b", a decimal of up to 36
// digits, or an expression of the constants that the table `let` defines, such as "1/(2 - r)" with
// let = { r = "2^(1/3)" }. Every error names the file, and the line where there is one.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

class TableDocument {
 public:
  /// Reads a file. InputError where it cannot be read, is no TOML, or defines a constant twice.
  explicit TableDocument(const std::string& path);
  ~TableDocument();
  TableDocument(const TableDocument&) = delete;
  TableDocument& operator=(const TableDocument&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// All that stands in the file.
  [[nodiscard]] const std::string& contents() const;
  [[nodiscard]] bool has(std::string_view key) const;

  // Each of these notes that the key was asked for, and refuses a value of another kind, by an InputError.
  // Keys such as "kernel.kick" stand in tables of their own.

  /// A text; `fallback` where the key is missing.
  std::string text(std::string_view key, const std::string& fallback);
  std::string required_text(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  int required_whole_number(std::string_view key);
  /// A list of numbers that is not empty.
  std::vector<Quad> numbers(std::string_view key);
  /// A list of lists of numbers.
  std::vector<std::vector<Quad>> rows(std::string_view key);
  /// A list of texts that stand for expressions, each with its place in the file.
  struct PlacedText {
    std::string text;
    std::size_t line = 1, column = 1;
  };
  std::vector<PlacedText> placed_texts(std::string_view key);
  /// The constants of `let` with their definitions.
  [[nodiscard]] const std::vector<std::pair<std::string, PlacedText>>& constants() const;

  /// Refuses keys that nothing has asked for, with the nearest that was.
  void finish() const;
  /// Throws an InputError about the value of a key.
  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;

 private:
  struct Content;
  std::string path_;
  std::unique_ptr<Content> content_;
};

}  // namespace pfaff
