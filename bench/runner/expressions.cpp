#include <pfaff/bench/runner/expressions.hpp>

#include <algorithm>
#include <cctype>

#include <pfaff/core/text/scope.hpp>

namespace pfaff {

namespace {
// True where a sign stands between two numbers or names, and not at the beginning or in an exponent.
bool adds_up(const std::string& text) {
  for (std::size_t k = 1; k < text.size(); ++k) {
    const auto before = text.find_last_not_of(' ', k - 1);
    if ((text[k] != '+' && text[k] != '-') || before == std::string::npos) continue;
    const char c = text[before];
    const bool in_an_exponent = c == 'e' || c == 'E';
    if (!in_an_exponent && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == ')'))
      return true;
  }
  return false;
}

// True of what can only be meant as an expression: a name that is known, or an operation that no number is
// written with.
bool is_expression(const std::string& text, const Assignments& parameters) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const bool named =
      std::any_of(text.begin(), text.end(), [&](char c) { return letter(c) && c != 'e' && c != 'E'; });
  return text == "pi" || is_set(parameters, text) || text.find_first_of("*^(") != std::string::npos ||
         (named ? text.find_first_of("/+-") != std::string::npos : adds_up(text));
}
}  // namespace

std::string evaluated(const std::string& text, const std::string& what, const Assignments& parameters) {
  if (Real::parse(text) || !is_expression(text, parameters)) return text;
  text::Scope scope;
  for (const auto& [name, value] : parameters)
    if (const auto number = Real::parse(value)) scope.define(name, Recorded(*number));
  return to_string(scope.constant(text::Expression(text::Source{text, what})));
}

}  // namespace pfaff
