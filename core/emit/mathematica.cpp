// Equations as a function of Mathematica. Names have no underscore there, and those that begin with a capital
// letter are Mathematica's own.
#include <cctype>

#include <pfaff/core/emit/code_text.hpp>
#include <pfaff/core/emit/emitter.hpp>

namespace pfaff {

namespace {
using namespace emit;

class Wolfram final : public Language {
 public:
  [[nodiscard]] PlanRules rules() const override { return {20, true, false}; }
  [[nodiscard]] bool associative() const override { return true; }
  [[nodiscard]] Phrase number(const Real& value) const override {
    if (isnan(value.quad())) return {"Indeterminate", Strength::atom};
    if (!isfinite(value.quad()))
      return {value.quad() > Quad(0) ? "Infinity" : "-Infinity",
              value.quad() > Quad(0) ? Strength::atom : Strength::sum};
    std::string text;
    if (value.is_fraction()) {
      text = std::to_string(value.numerator());
      if (value.denominator() != 1) text += "/" + std::to_string(value.denominator());
    } else {
      text = decimal_text(value);
      text.replace(text.find('e'), 1, "`36*^");
      if (const std::size_t plus = text.find("^+"); plus != std::string::npos) text.erase(plus + 1, 1);
    }
    const bool fraction = value.is_fraction() && value.denominator() != 1;
    return {text, text.front() == '-' ? Strength::sum : fraction ? Strength::product : Strength::atom};
  }
  [[nodiscard]] Phrase function(std::string_view usual, const Phrase& argument) const override {
    std::string name(usual == "atan" ? "arcTan" : usual);
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return {name + "[" + argument.text + "]", Strength::atom};
  }
  [[nodiscard]] Phrase power(const Phrase& base, const Real& exponent) const override {
    return {at_least(Strength::atom, base) + "^" + at_least(Strength::atom, number(exponent)),
            Strength::call};
  }
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override {
    return {"If[" + condition.text + " > 0, " + positive.text + ", " + otherwise.text + "]", Strength::atom};
  }
};

std::string mathematica_solution(const std::vector<std::vector<Phrase>>& matrix,
                                 const std::vector<Phrase>& right_hand_side) {
  const auto list = [](const std::vector<Phrase>& entries) {
    std::vector<std::string> texts;
    for (const Phrase& entry : entries) texts.push_back(entry.text);
    return "{" + joined(texts, ", ") + "}";
  };
  std::vector<std::string> rows;
  for (const auto& row : matrix) rows.push_back(list(row));
  return "LinearSolve[{" + joined(rows, ", ") + "}, " + list(right_hand_side) + "]";
}

std::string my_own(const std::string& name) { return "my" + name; }
bool is_capital(const std::string& name) {
  return std::isupper(static_cast<unsigned char>(name.front())) != 0;
}

std::string patterns(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) all.push_back(name + "_");
  return "{" + joined(all, ", ") + "}";
}
}  // namespace

std::string write_mathematica(const Equations& equations) {
  const Wolfram language;
  const Tape& tape = equations.tape;
  const Plan plan(tape, language.rules());
  Names names({"", "", &my_own, &is_capital, false});
  const std::string function = names("rates_of_" + equations.system);
  const TextNames text_name = text_names(equations, plan, names);
  const auto split = text_name.inputs.begin() + static_cast<std::ptrdiff_t>(equations.coordinates.size());

  std::string text = "(* Equations of motion of " + plain_words(equations.system) + ", by the method " +
                     plain_words(equations.method) + ". Written by Pfaff.\n";
  for (const std::string& line : legend_of(equations, text_name.inputs)) text += "   " + line + "\n";
  text += "   Results: " + joined(names_of_results(equations), ", ") + " *)\n";
  text += function + "[" + text_name.time + "_, " + patterns({text_name.inputs.begin(), split}) + ", " +
          patterns({split, text_name.inputs.end()}) + "] :=\n";
  std::vector<std::string> locals, lines;
  for (const Assignment& a : assignments_of(tape, plan, language, text_name.slots, &mathematica_solution)) {
    locals.insert(locals.end(), a.names.begin(), a.names.end());
    const std::string left = !a.list ? a.names.front() : "{" + joined(a.names, ", ") + "}";
    lines.push_back("    " + left + " = " + a.value + ";\n");
  }
  text += "  Module[{" + joined(locals, ", ") + "},\n" + joined(lines, "");
  return text + "    {" + joined(outputs_of(tape, language, text_name.slots), ",\n     ") + "}]\n";
}

}  // namespace pfaff
