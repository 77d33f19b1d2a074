// The words of an expression: numbers, names and signs, each with its place.
#pragma once

#include <string_view>

#include <pfaff/core/text/source.hpp>

namespace pfaff::text {

/// One word. Signs are + - * / ^ ( ) [ ] and the comma; their text says which.
struct Token {
  enum class Kind { number, name, sign, end };
  Kind kind = Kind::end;
  std::string_view text;   // a part of the source's text
  std::size_t offset = 0;  // in bytes
};

/// Takes one word after another from a source, which must outlive it.
class Lexer {
 public:
  explicit Lexer(const Source& source) : source_(source) {}
  /// The next word; `end`, again and again, behind the last. TextError for what begins no word.
  Token next();

 private:
  [[nodiscard]] std::size_t end_of_number(std::size_t at) const;

  const Source& source_;
  std::size_t at_ = 0;
};

/// True for a letter or an underscore followed by letters, digits and underscores: the names of expressions.
bool is_identifier(std::string_view text);

}  // namespace pfaff::text
