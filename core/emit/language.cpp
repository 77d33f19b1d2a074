#include <pfaff/core/emit/language.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include <pfaff/core/numbers/special.hpp>

namespace pfaff::emit {

std::string_view usual_name(const Instruction& function) {
  switch (function.operation) {
    case Operation::square_root:
      return "sqrt";
    case Operation::exponential:
      return "exp";
    case Operation::logarithm:
      return "log";
    case Operation::sine:
      return "sin";
    case Operation::cosine:
      return "cos";
    case Operation::special:
      return special_functions.at(static_cast<std::size_t>(function.c));
    default:
      throw std::logic_error("usual_name: not a function of one argument");
  }
}

bool calls(const Tape& tape, std::string_view name) {
  return std::any_of(tape.code.begin(), tape.code.end(), [&](const Instruction& i) {
    return i.operation == Operation::special && usual_name(i) == name;
  });
}

std::string double_text(const Real& value) {
  std::array<char, 40> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value.value());
  std::string text(buffer.data(), end);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string plain_words(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      std::string_view(" -_.,:^~()[]+=").find(c) != std::string_view::npos ||
                      (c == '/' && !plain.empty() && plain.back() != '*');
    plain += fits ? c : ' ';
  }
  return plain;
}

Phrase Language::product(const Phrase& a, const Phrase& b) const {
  return {
      at_least(Strength::product, a) + "*" + at_least(associative() ? Strength::product : Strength::call, b),
      Strength::product};
}
Phrase Language::quotient(const Phrase& a, const Phrase& b) const {
  return {at_least(Strength::product, a) + "/" + at_least(Strength::call, b), Strength::product};
}

Phrase Expressions::value(int slot) const {
  const std::string& name = names_[static_cast<std::size_t>(slot)];
  return name.empty() ? definition(slot) : Phrase{name, Strength::atom};
}

Phrase Expressions::definition(int slot) const {
  const Instruction& i = tape_.code[static_cast<std::size_t>(slot)];
  const auto constant = [&](int k) -> const Real& { return tape_.constants[static_cast<std::size_t>(k)]; };
  const auto summand = [&](const Phrase& b, bool may_lean) {
    return language_.at_least(may_lean ? Strength::sum : Strength::product, b);
  };
  switch (i.operation) {
    case Operation::constant:
      return language_.number(constant(i.a));
    case Operation::negate:
      return {"-" + language_.at_least(Strength::product, value(i.a)), Strength::sum};
    case Operation::add: {
      const Phrase b = value(i.b);
      // A summand that begins with a sign keeps its parentheses.
      const bool may_lean = language_.associative() && b.text.front() != '-';
      return {value(i.a).text + " + " + summand(b, may_lean), Strength::sum};
    }
    case Operation::subtract:
      return {value(i.a).text + " - " + summand(value(i.b), false), Strength::sum};
    case Operation::multiply:
      if (i.a == i.b && language_.rules().squares) return language_.power(value(i.a), Real(2));
      return language_.product(value(i.a), value(i.b));
    case Operation::divide:
      return language_.quotient(value(i.a), value(i.b));
    case Operation::power:
      return language_.power(value(i.a), constant(i.b));
    case Operation::select:
      return language_.choice(value(i.a), value(i.b), value(i.c));
    case Operation::square_root:
    case Operation::exponential:
    case Operation::logarithm:
    case Operation::sine:
    case Operation::cosine:
    case Operation::special:
      return language_.function(usual_name(i), value(i.a));
    case Operation::time:
    case Operation::input:
    case Operation::solve:
    case Operation::solve_next:
      break;
  }
  throw std::logic_error("Expressions::definition: this slot is written in another way");
}

std::vector<Phrase> Expressions::entries(const LinearSystem& system) const {
  std::vector<Phrase> entries;
  for (const auto* slots : {&system.matrix, &system.right_hand_side})
    for (const int slot : *slots) entries.push_back(value(slot));
  return entries;
}

}  // namespace pfaff::emit
