#include <pfaff/core/emit/names.hpp>

#include <cctype>
#include <sstream>

#include <pfaff/core/emit/language.hpp>

namespace pfaff::emit {

std::string with_underscore(const std::string& name) { return name + "_"; }

Names::Names(const NameRules& rules) : rules_(rules) {
  std::istringstream words{std::string(rules.reserved)};
  for (std::string word; words >> word;) taken_.insert(word);
  if (!rules.usual_functions) return;
  taken_.insert(elementary_functions.begin(), elementary_functions.end());
  taken_.insert(special_functions.begin(), special_functions.end());
}

std::string Names::operator()(std::string_view wanted) {
  std::string name;
  bool joint_due = false;
  for (const char c : wanted) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      joint_due = true;
      continue;
    }
    if (joint_due && !name.empty()) name += rules_.joint;
    joint_due = false;
    name += c;
  }
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name.insert(0, "x");
  if (rules_.refuses != nullptr && rules_.refuses(name)) name = rules_.other(name);
  std::string candidate = name;
  if (!is_free(candidate)) candidate = rules_.other(name);
  for (int k = 2; !is_free(candidate); ++k) candidate = name + std::string(rules_.joint) + std::to_string(k);
  taken_.insert(candidate);
  return candidate;
}

TextNames text_names(const Equations& equations, const Plan& plan, Names& names) {
  const Tape& tape = equations.tape;
  TextNames result;
  result.time = names("t");
  for (const auto* symbols : {&equations.coordinates, &equations.parameters})
    for (const Symbol& symbol : *symbols) result.inputs.push_back(names(symbol.name));
  result.slots.resize(tape.code.size());
  const auto at = [](int slot) { return static_cast<std::size_t>(slot); };
  int number = 0;
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    const Instruction& i = tape.code[k];
    if (i.operation == Operation::time) result.slots[k] = result.time;
    if (i.operation == Operation::input) result.slots[k] = result.inputs[at(i.a)];
    if (!plan.named(static_cast<int>(k))) continue;
    const bool of_input = (i.operation == Operation::sine || i.operation == Operation::cosine) &&
                          tape.code[at(i.a)].operation == Operation::input;
    if (of_input) {
      result.slots[k] = names((i.operation == Operation::sine ? "sin_" : "cos_") + result.slots[at(i.a)]);
    } else {
      result.slots[k] = names("v" + std::to_string(++number));
    }
  }
  return result;
}

}  // namespace pfaff::emit
