// Equations as a Python module for SymPy.
//
// Fractions are exact. A constant that is known to quad precision only is the fraction that its 36 digits
// make, so that arithmetic stays exact and functions may be evaluated to any number of digits.
#include <pfaff/core/emit/code_text.hpp>
#include <pfaff/core/emit/emitter.hpp>

namespace pfaff {

namespace {
using namespace emit;

constexpr std::string_view sympy_reserved =
    "False None True and as assert async await break case class continue def del elif else except finally "
    "for "
    "from global if import in is lambda match nonlocal not or pass raise return try type while with "
    "Matrix Piecewise Rational nan oo sympify map tuple rates "
    "coordinates "
    "parameters "
    "results "
    "state print";

class Python final : public Language {
 public:
  [[nodiscard]] PlanRules rules() const override { return {20, true, false}; }
  [[nodiscard]] bool associative() const override { return true; }
  [[nodiscard]] Phrase number(const Real& value) const override {
    if (isnan(value.quad())) return {"nan", Strength::atom};
    if (!isfinite(value.quad())) return {value.quad() > Quad(0) ? "oo" : "-oo", Strength::sum};
    if (!value.is_fraction()) return {"Rational(\"" + decimal_text(value) + "\")", Strength::atom};
    const std::string numerator = std::to_string(value.numerator());
    if (value.denominator() == 1) return {numerator, value.numerator() < 0 ? Strength::sum : Strength::atom};
    return {"Rational(" + numerator + ", " + std::to_string(value.denominator()) + ")", Strength::atom};
  }
  [[nodiscard]] Phrase function(std::string_view name, const Phrase& argument) const override {
    return {std::string(name) + "(" + argument.text + ")", Strength::atom};
  }
  [[nodiscard]] Phrase power(const Phrase& base, const Real& exponent) const override {
    return {at_least(Strength::atom, base) + "**" + at_least(Strength::atom, number(exponent)),
            Strength::call};
  }
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override {
    return {"Piecewise((" + positive.text + ", " + condition.text + " > 0), (" + otherwise.text + ", True))",
            Strength::atom};
  }
};

std::string sympy_solution(const std::vector<std::vector<Phrase>>& matrix,
                           const std::vector<Phrase>& right_hand_side) {
  std::vector<std::string> rows, right;
  for (const auto& row : matrix) {
    std::vector<std::string> entries;
    for (const Phrase& entry : row) entries.push_back(entry.text);
    rows.push_back("[" + joined(entries, ", ") + "]");
  }
  for (const Phrase& entry : right_hand_side) right.push_back(entry.text);
  return "Matrix([" + joined(rows, ", ") + "]).LUsolve(Matrix([" + joined(right, ", ") + "]))";
}

// A tuple of the names, ("q1", "p1"), with a comma behind a single one.
std::string quoted(const std::vector<std::string>& names) {
  std::string text = "(";
  for (const std::string& name : names) text += "\"" + name + "\", ";
  if (names.size() > 1) text.resize(text.size() - 2);
  if (names.size() == 1) text.resize(text.size() - 1);
  return text + ")";
}
std::string unpacked(const std::vector<std::string>& names, const std::string& from) {
  if (names.empty()) return {};
  return "    " + joined(names, ", ") + (names.size() == 1 ? ", = " : " = ") + from + "\n";
}
}  // namespace

std::string write_sympy(const Equations& equations) {
  const Python language;
  const Tape& tape = equations.tape;
  const Plan plan(tape, language.rules());
  Names names({"_", sympy_reserved, &with_underscore});
  const TextNames text_name = text_names(equations, plan, names);
  const auto split = text_name.inputs.begin() + static_cast<std::ptrdiff_t>(equations.coordinates.size());
  const std::vector<std::string> coordinates(text_name.inputs.begin(), split);
  const std::vector<std::string> parameters(split, text_name.inputs.end());

  std::string text = "\"\"\"Equations of motion of " + plain_words(equations.system) + ", by the method " +
                     plain_words(equations.method) + ". Written by Pfaff.\n\n";
  for (const std::string& line : legend_of(equations, text_name.inputs)) text += line + "\n";
  text +=
      "\"\"\"\nfrom sympy import Matrix, Piecewise, Rational, cos, exp, log, nan, oo, sin, sqrt, sympify\n";
  for (const std::string_view name : special_functions)
    if (calls(tape, name)) text += "from sympy import " + std::string(name) + "\n";
  text += "\n";
  text += "coordinates = " + quoted(coordinates) + "\nparameters = " + quoted(parameters) + "\n";
  text += "results = " + quoted(names_of_results(equations)) + "\n\n\n";
  text += "def rates(" + text_name.time + ", state" +
          (parameters.empty() ? ", parameters=()" : ", parameters") +
          "):\n    \"\"\"The results, at a time, a state and parameters that are symbols or numbers.\"\"\"\n";
  text += "    " + text_name.time + " = sympify(" + text_name.time + ")\n";
  text += unpacked(coordinates, "map(sympify, state)") + unpacked(parameters, "map(sympify, parameters)");
  for (const Assignment& a : assignments_of(tape, plan, language, text_name.slots, &sympy_solution))
    text += "    " + joined(a.names, ", ") + (a.list ? ", = " : " = ") + a.value + "\n";
  text += "    return [\n";
  for (const std::string& value : outputs_of(tape, language, text_name.slots))
    text += "        sympify(" + value + "),\n";
  return text + "    ]\n";
}

}  // namespace pfaff
