// A table of coefficients as it stands in its file: a text document (core/text/document.hpp) whose numbers
// are constants.
//
// A number is a TOML number, of which every digit counts, or a text: a fraction "a/b", a decimal of up to 36
// digits, or an expression of the constants that the table `let` defines, such as "1/(2 - r)" with
// let = { r = "2^(1/3)" }. In a list, vector(...) stands for several numbers. Every error names the file and
// the place in it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/numbers/real.hpp>
#include <pfaff/core/text/vocabulary.hpp>

namespace pfaff {

class TableDocument {
 public:
  /// Reads a file. InputError where it cannot be read, is no TOML, or defines what is no constant.
  explicit TableDocument(const std::string& path);
  TableDocument(const TableDocument&) = delete;
  TableDocument& operator=(const TableDocument&) = delete;

  [[nodiscard]] const std::string& path() const { return document_.path; }
  /// All that stands in the file.
  [[nodiscard]] const std::string& contents() const { return document_.contents; }

  // Each of these notes that the key was asked for, and refuses a value of another kind, by an InputError.
  // Keys such as "kernel.kick" stand in tables of their own.

  /// The value of a key; null where it is missing.
  const text::Item* find(std::string_view key);
  bool has(std::string_view key) { return find(key) != nullptr; }
  /// A text; `fallback` where the key is missing.
  std::string text(std::string_view key, const std::string& fallback);
  std::string required_text(std::string_view key);
  std::vector<std::string> texts(std::string_view key);
  int required_whole_number(std::string_view key);
  /// A list of numbers that is not empty.
  std::vector<Quad> numbers(std::string_view key);
  /// A list of lists of numbers.
  std::vector<std::vector<Quad>> rows(std::string_view key);
  /// The definitions of `let`.
  [[nodiscard]] const std::vector<text::TextDefinition>& definitions() const { return definitions_; }
  /// The names that the file has given a meaning so far.
  [[nodiscard]] text::TakenNames& names() { return names_; }

  /// Refuses keys that nothing has asked for, with the nearest that was.
  void finish() const;
  /// Throws an InputError about the value of a key.
  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;

 private:
  void append_numbers(const text::Item& item, std::vector<Quad>& numbers);

  text::Document document_;
  text::Table root_;
  std::map<std::string, text::Table, std::less<>> inner_;  // of keys with a point, by what is before it
  text::TakenNames names_;
  std::vector<text::TextDefinition> definitions_;
  text::Scope constants_;
};

}  // namespace pfaff
