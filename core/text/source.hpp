// A text that was read from a file, and errors that show a place in it.
#pragma once

#include <cstddef>
#include <string>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff::text {

/// A text and where it stands: the file, and the line and column, counted from 1, of its first character.
/// Without a file, such as for an option of the command line, `file` says what the text is.
struct Source {
  std::string text;
  std::string file;
  std::size_t line = 1, column = 1;
};

/// An error at a place of a text. what() is one line, "FILE:LINE:COLUMN: what; expected what"; excerpt() is
/// the line of the text and, under it, a line with a caret under the place; empty where the text is.
class TextError : public InputError {
 public:
  TextError(const std::string& message, std::string excerpt)
      : InputError(message), excerpt_(std::move(excerpt)) {}
  [[nodiscard]] const std::string& excerpt() const { return excerpt_; }

 private:
  std::string excerpt_;
};

/// Throws a TextError about the place `offset`, in bytes, of the text.
[[noreturn]] void refuse(const Source& source, std::size_t offset, const std::string& message);

/// The same of broken JSON, of whose text a parser had read `read` bytes when it met `token`. `expected` says
/// what the whole was to be: "expected JSON".
[[noreturn]] void refuse_json(const Source& source, std::size_t read, const std::string& token,
                              const std::string& expected);

}  // namespace pfaff::text
