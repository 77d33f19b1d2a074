#include <pfaff/core/text/lexer.hpp>

#include <algorithm>

namespace pfaff::text {

namespace {
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
}  // namespace

bool is_identifier(std::string_view text) {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

// Digits, a point among them or none, and an exponent where digits follow its letter.
std::size_t Lexer::end_of_number(std::size_t at) const {
  const std::string_view text = source_.text;
  const auto digits = [&] {
    while (at < text.size() && is_digit(text[at])) ++at;
  };
  digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    digits();
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t power = at + 1;
    if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
    if (power < text.size() && is_digit(text[power])) {
      at = power;
      digits();
    }
  }
  return at;
}

Token Lexer::next() {
  const std::string_view text = source_.text;
  while (at_ < text.size() && is_space(text[at_])) ++at_;
  if (at_ == text.size()) return {Token::Kind::end, {}, at_};
  const std::size_t begin = at_;
  const char c = text[at_];
  Token::Kind kind = Token::Kind::sign;
  if (is_digit(c) || (c == '.' && at_ + 1 < text.size() && is_digit(text[at_ + 1]))) {
    kind = Token::Kind::number;
    at_ = end_of_number(at_);
  } else if (is_letter(c)) {
    kind = Token::Kind::name;
    while (at_ < text.size() && (is_letter(text[at_]) || is_digit(text[at_]))) ++at_;
  } else if (std::string_view("+-*/^()[],").find(c) != std::string_view::npos) {
    ++at_;
  } else if (c == '<' || c == '>') {
    at_ += at_ + 1 < text.size() && text[at_ + 1] == '=' ? 2 : 1;
  } else if (std::string_view("=!?&|").find(c) != std::string_view::npos) {
    refuse(source_, begin,
           "expected + - * / ^, a number or a name; conditions of select(condition, a, b) compare by < > <= "
           "or >=");
  } else if (static_cast<unsigned char>(c) >= 0x80U) {
    refuse(source_, begin, "expected names of the letters a to z, A to Z, digits and _");
  } else {
    refuse(source_, begin, "expected a number, a name, a parenthesis or one of + - * / ^");
  }
  return {kind, text.substr(begin, at_ - begin), begin};
}

}  // namespace pfaff::text
