// Equations as a LaTeX document that needs amsmath only.
#include <pfaff/core/emit/code_text.hpp>
#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/emit/latex_names.hpp>

namespace pfaff {

namespace {
using namespace emit;

class Latex final : public Language {
 public:
  [[nodiscard]] PlanRules rules() const override { return {8, true, false}; }
  [[nodiscard]] bool associative() const override { return true; }
  [[nodiscard]] Phrase number(const Real& value) const override {
    if (isnan(value.quad())) return {"\\mathrm{NaN}", Strength::atom};
    if (!isfinite(value.quad()))
      return value.quad() > Quad(0) ? Phrase{"\\infty", Strength::atom} : Phrase{"-\\infty", Strength::sum};
    std::string text = to_string(value);
    const bool negative = text.front() == '-';
    if (negative) text.erase(0, 1);
    Strength strength = Strength::atom;
    if (const std::size_t slash = text.find('/'); slash != std::string::npos) {
      text = "\\frac{" + text.substr(0, slash) + "}{" + text.substr(slash + 1) + "}";
      strength = Strength::call;
    } else if (const std::size_t e = text.find('e'); e != std::string::npos) {
      text = text.substr(0, e) + " \\cdot 10^{" + text.substr(e + 1) + "}";
      strength = Strength::product;
    }
    return {(negative ? "-" : "") + text, negative ? Strength::sum : strength};
  }
  [[nodiscard]] Phrase function(std::string_view name, const Phrase& argument) const override {
    if (name == "sqrt") return {"\\sqrt{" + argument.text + "}", Strength::call};
    const std::string word = name == "log"    ? "\\ln"
                             : name == "atan" ? "\\arctan"
                             : name == "erf"  ? "\\operatorname{erf}"
                                              : "\\" + std::string(name);
    return {word + parenthesised(argument.text), Strength::call};
  }
  [[nodiscard]] Phrase power(const Phrase& base, const Real& exponent) const override {
    return {at_least(Strength::atom, base) + "^{" + number(exponent).text + "}", Strength::call};
  }
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override {
    return {"\\begin{cases} " + positive.text + " & \\text{if } " + condition.text + " > 0 \\\\ " +
                otherwise.text + " & \\text{otherwise} \\end{cases}",
            Strength::sum};
  }
  [[nodiscard]] Phrase product(const Phrase& a, const Phrase& b) const override {
    const std::string left = at_least(Strength::product, a), right = at_least(Strength::product, b);
    const bool digit = right.front() >= '0' && right.front() <= '9';
    return {left + (digit ? " \\cdot " : " \\, ") + right, Strength::product};
  }
  [[nodiscard]] Phrase quotient(const Phrase& a, const Phrase& b) const override {
    return {"\\frac{" + a.text + "}{" + b.text + "}", Strength::call};
  }
  [[nodiscard]] std::string parenthesised(const std::string& text) const override {
    return "\\left(" + text + "\\right)";
  }
};

std::string column(const std::vector<std::string>& entries) {
  return "\\begin{pmatrix} " + joined(entries, " \\\\ ") + " \\end{pmatrix}";
}
std::string latex_solution(const std::vector<std::vector<Phrase>>& matrix,
                           const std::vector<Phrase>& right_hand_side) {
  std::vector<std::string> rows, right;
  for (const auto& row : matrix) {
    std::vector<std::string> entries;
    for (const Phrase& entry : row) entries.push_back(entry.text);
    rows.push_back(joined(entries, " & "));
  }
  for (const Phrase& entry : right_hand_side) right.push_back(entry.text);
  return column(rows) + "^{-1} " + column(right);
}

// Equations under each other, in blocks that a page can hold.
std::string aligned(const std::vector<std::string>& lines) {
  constexpr std::size_t most = 40;
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool begins = k % most == 0, ends = k + 1 == lines.size() || (k + 1) % most == 0;
    text += (begins ? "\\begin{align*}\n" : "") + lines[k] + (ends ? "\n\\end{align*}\n" : " \\\\\n");
  }
  return text;
}

struct Symbols {
  std::vector<LatexName> inputs;
  std::vector<std::string> slots;
};
Symbols symbols_of(const Equations& equations, const Plan& plan) {
  LatexNames names;
  const std::string time = names("t").text();
  Symbols symbols;
  for (const auto* group : {&equations.coordinates, &equations.parameters})
    for (const Symbol& symbol : *group) symbols.inputs.push_back(names(symbol.name));
  const Tape& tape = equations.tape;
  symbols.slots.resize(tape.code.size());
  int number = 0;
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    const Instruction& i = tape.code[k];
    if (i.operation == Operation::time) symbols.slots[k] = time;
    if (i.operation == Operation::input)
      symbols.slots[k] = symbols.inputs[static_cast<std::size_t>(i.a)].text();
    if (plan.named(static_cast<int>(k))) symbols.slots[k] = names("a" + std::to_string(++number)).text();
  }
  return symbols;
}

std::string legend(const std::string& heading, const std::vector<Symbol>& symbols, const LatexName* names) {
  if (symbols.empty()) return {};
  std::string text = heading + "\n\\begin{itemize}\n";
  for (std::size_t k = 0; k < symbols.size(); ++k)
    text += "\\item $" + names[k].text() + "$ (" + latex_words(symbols[k].name) + ")" +
            (symbols[k].unit.empty() ? "" : " in " + latex_words(symbols[k].unit)) + "\n";
  return text + "\\end{itemize}\n";
}
}  // namespace

std::string write_latex(const Equations& equations) {
  const Latex language;
  const Tape& tape = equations.tape;
  const Plan plan(tape, language.rules());
  const Symbols symbols = symbols_of(equations, plan);
  const std::size_t n = equations.coordinates.size();

  int widest = 10;  // columns of a matrix, as amsmath has them
  for (const LinearSystem& system : tape.solves) widest = std::max(widest, system.size);
  std::string text =
      "\\documentclass{article}\n\\usepackage{amsmath}\n\\allowdisplaybreaks\n\\setcounter{MaxMatrixCols}{" +
      std::to_string(widest) + "}\n\\begin{document}\n\\section*{Equations of motion of " +
      latex_words(equations.system) + "}\nBy the method " + latex_words(equations.method) +
      ". Written by Pfaff.\n\n";
  text += legend("Coordinates, and their rates with a dot:", equations.coordinates, symbols.inputs.data());
  text += legend("Parameters:", equations.parameters, symbols.inputs.data() + n);
  std::vector<std::string> lines;
  for (const Assignment& a : assignments_of(tape, plan, language, symbols.slots, &latex_solution))
    lines.push_back((a.list ? column(a.names) : a.names.front()) + " &= " + a.value);
  if (!lines.empty()) text += "\\subsection*{Intermediate quantities}\n" + aligned(lines);
  lines.clear();
  const std::vector<std::string> values = outputs_of(tape, language, symbols.slots);
  for (std::size_t k = 0; k < values.size(); ++k)
    lines.push_back((k < n ? symbols.inputs[k].dotted()
                           : "\\text{" + latex_words(equations.further_outputs[k - n]) + "}") +
                    " &= " + values[k]);
  return text + "\\subsection*{Equations}\n" + aligned(lines) + "\\end{document}\n";
}

}  // namespace pfaff
