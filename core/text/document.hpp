// TOML files as values with their places: numbers as they are written, tables in the order of writing.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pfaff/core/text/expression.hpp>
#include <pfaff/core/text/source.hpp>

namespace pfaff::text {

struct Member;

/// A value of a document.
struct Item {
  enum class Kind { text, number, truth, list, table, other };
  Kind kind = Kind::other;
  Source source{};              // of texts, numbers and truths ("true"); of others the place alone
  bool whole = false;           // of numbers: written as an integer
  std::vector<Item> items;      // of lists
  std::vector<Member> members;  // of tables, in the order of writing
};
/// A key of a table, and its value.
struct Member {
  std::string key;
  Source place;  // of the key; its text is the key
  Item value;
};

/// A file and what it says.
struct Document {
  std::string path, contents;
  Item root;  // a table
};
/// Reads a TOML file. InputError where it cannot be read, "PATH:LINE:COLUMN: ..." where it is not TOML.
Document read_document(const std::string& path);

/// Throws a TextError about the place of a value.
[[noreturn]] void refuse(const Item& value, const std::string& message);

/// The expression of a text or a number; TextError for other values, which are said to be no `what`.
Expression expression_of(const Item& value, const std::string& what);
/// The expressions of a list of texts and numbers.
std::vector<Expression> expressions_of(const Item& value, const std::string& what);
/// A text; TextError for other values.
const std::string& text_of(const Item& value, const std::string& what);
/// true or false; TextError for other values.
bool truth_of(const Item& value, const std::string& what);

/// A table whose keys are checked: each is to be asked for, and finish() refuses those that were not.
class Table {
 public:
  /// `what` says whose table it is, such as "the parameter 'a'". TextError where the value is no table.
  Table(const Item& value, std::string what);
  /// The value of a key, null where it is not there.
  const Item* find(std::string_view key);
  /// The value of a key; TextError where it is not there.
  const Item& required(std::string_view key);
  /// A text, and `fallback` where the key is not there.
  std::string text(std::string_view key, const std::string& fallback = {});
  /// TextError for a key that nobody asked for; the nearest one that somebody asked for is named.
  void finish() const;

 private:
  const Item& value_;
  std::string what_;
  std::vector<std::string> asked_;
};

}  // namespace pfaff::text
