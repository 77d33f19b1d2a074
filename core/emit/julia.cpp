// Equations as a function of Julia that writes the results into its first argument. It computes with whatever
// numbers the state consists of: fractions are exact until they meet one of them.
#include <pfaff/core/emit/code_text.hpp>
#include <pfaff/core/emit/emitter.hpp>

namespace pfaff {

namespace {
using namespace emit;

constexpr std::string_view julia_reserved =
    "abstract baremodule begin break catch const continue do else elseif end export false finally for "
    "function "
    "global if import in isa let local macro module mutable new outer primitive public quote return struct "
    "true "
    "try type using where while ifelse pi im Inf NaN state "
    "parameters rates "
    "nothing "
    "missing "
    "big";

class JuliaLanguage final : public Language {
 public:
  [[nodiscard]] PlanRules rules() const override { return {20, true, false}; }
  [[nodiscard]] bool associative() const override { return false; }
  [[nodiscard]] Phrase number(const Real& value) const override {
    if (isnan(value.quad())) return {"NaN", Strength::atom};
    const Strength sign = value.quad() < Quad(0) ? Strength::sum : Strength::atom;
    if (!isfinite(value.quad())) return {value.quad() > Quad(0) ? "Inf" : "-Inf", sign};
    if (!value.is_fraction()) return {"big\"" + decimal_text(value) + "\"", Strength::atom};
    std::string text = std::to_string(value.numerator());
    if (value.denominator() == 1) return {text, sign};
    return {"(" + text + "//" + std::to_string(value.denominator()) + ")", Strength::atom};
  }
  [[nodiscard]] Phrase function(std::string_view name, const Phrase& argument) const override {
    return {std::string(name) + "(" + argument.text + ")", Strength::atom};
  }
  [[nodiscard]] Phrase power(const Phrase& base, const Real& exponent) const override {
    return {at_least(Strength::atom, base) + "^" + at_least(Strength::atom, number(exponent)),
            Strength::call};
  }
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override {
    return {"ifelse(" + condition.text + " > 0, " + positive.text + ", " + otherwise.text + ")",
            Strength::atom};
  }
};

// In a matrix literal spaces separate entries, so that sums are put in parentheses.
std::string julia_solution(const std::vector<std::vector<Phrase>>& matrix,
                           const std::vector<Phrase>& right_hand_side) {
  std::vector<std::string> rows, right;
  for (const auto& row : matrix) {
    std::vector<std::string> entries;
    for (const Phrase& entry : row)
      entries.push_back(entry.strength == Strength::atom ? entry.text : "(" + entry.text + ")");
    rows.push_back(joined(entries, " "));
  }
  for (const Phrase& entry : right_hand_side) right.push_back(entry.text);
  return "[" + joined(rows, "; ") + "] \\ [" + joined(right, ", ") + "]";
}

std::string unpacked(std::span<const std::string> names, const std::string& array) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += "    " + names[k] + " = " + array + "[" + std::to_string(k + 1) + "]\n";
  return text;
}
}  // namespace

std::string write_julia(const Equations& equations) {
  const JuliaLanguage language;
  const Tape& tape = equations.tape;
  const Plan plan(tape, language.rules());
  Names names({"_", julia_reserved, &with_underscore});
  const std::string function = names(equations.system + "_rates");
  const TextNames text_name = text_names(equations, plan, names);

  std::string text = "# Equations of motion of " + plain_words(equations.system) + ", by the method " +
                     plain_words(equations.method) + ". Written by Pfaff.\n";
  for (const std::string& line : legend_of(equations, text_name.inputs)) text += "#   " + line + "\n";
  text += "# Results: " + joined(names_of_results(equations), ", ") + "\n";
  if (calls(tape, "erf")) text += "using SpecialFunctions: erf\n";
  text += "function " + function + "!(rates, state, parameters, " + text_name.time + ")\n";
  const std::span<const std::string> inputs(text_name.inputs);
  text += unpacked(inputs.first(equations.coordinates.size()), "state") +
          unpacked(inputs.subspan(equations.coordinates.size()), "parameters");
  for (const Assignment& a : assignments_of(tape, plan, language, text_name.slots, &julia_solution))
    text += "    " + joined(a.names, ", ") + (a.list ? ", = " : " = ") + a.value + "\n";
  const std::vector<std::string> values = outputs_of(tape, language, text_name.slots);
  for (std::size_t k = 0; k < values.size(); ++k)
    text += "    rates[" + std::to_string(k + 1) + "] = " + values[k] + "\n";
  return text + "    return rates\nend\n";
}

}  // namespace pfaff
