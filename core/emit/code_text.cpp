#include <pfaff/core/emit/code_text.hpp>

namespace pfaff::emit {

std::vector<Assignment> assignments_of(const Tape& tape, const Plan& plan, const Language& language,
                                       const std::vector<std::string>& names, SolveText solve) {
  const Expressions expressions(tape, language, names);
  std::vector<Assignment> all;
  for (const int slot : plan.statements()) {
    const Instruction& i = tape.code[static_cast<std::size_t>(slot)];
    const auto first = names.begin() + slot;
    if (i.operation != Operation::solve) {
      all.push_back({{*first}, expressions.definition(slot).text, false});
      continue;
    }
    const LinearSystem& system = tape.solves[static_cast<std::size_t>(i.a)];
    const std::vector<Phrase> entries = expressions.entries(system);
    std::vector<std::vector<Phrase>> matrix;
    auto from = entries.begin();
    for (int row = 0; row < system.size; ++row, from += system.size)
      matrix.emplace_back(from, from + system.size);
    all.push_back({{first, first + system.size}, solve(matrix, {from, entries.end()}), true});
  }
  return all;
}

std::vector<std::string> outputs_of(const Tape& tape, const Language& language,
                                    const std::vector<std::string>& names) {
  const Expressions expressions(tape, language, names);
  std::vector<std::string> all;
  for (const int slot : tape.outputs) all.push_back(expressions.value(slot).text);
  return all;
}

std::string joined(const std::vector<std::string>& texts, const std::string& separator) {
  std::string text;
  for (std::size_t k = 0; k < texts.size(); ++k) text += (k == 0 ? "" : separator) + texts[k];
  return text;
}

std::vector<std::string> names_of_results(const Equations& equations) {
  std::vector<std::string> names;
  for (const Symbol& q : equations.coordinates) names.push_back("d " + plain_words(q.name) + "/dt");
  for (const std::string& name : equations.further_outputs) names.push_back(plain_words(name));
  return names;
}

std::vector<std::string> legend_of(const Equations& equations, const std::vector<std::string>& names) {
  std::vector<std::string> lines;
  for (const auto* symbols : {&equations.coordinates, &equations.parameters})
    for (const Symbol& symbol : *symbols) {
      const std::string& name = names[lines.size()];
      lines.push_back(name + (symbol.unit.empty() ? "" : " [" + plain_words(symbol.unit) + "]") +
                      (name == symbol.name ? "" : ": " + plain_words(symbol.name)));
    }
  return lines;
}

std::string decimal_text(const Real& value) { return to_scientific(value.quad(), 36); }

}  // namespace pfaff::emit
