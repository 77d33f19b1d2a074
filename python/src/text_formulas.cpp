// Tapes in the language of text models (docs/text-models.md): expressions, and names for what is used twice.
#include <pybind11/stl.h>

#include <pfaff/core/emit/code_text.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/separable_energy.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
class TextModelLanguage final : public emit::Language {
 public:
  // Expressions may be long, so that what is named is what is used twice.
  [[nodiscard]] emit::PlanRules rules() const override { return {200, false, false}; }
  [[nodiscard]] bool associative() const override { return false; }
  [[nodiscard]] emit::Phrase number(const Real& value) const override {
    if (!isfinite(value.quad())) throw InputError("to_toml: a formula has a constant that is not finite");
    const std::string text = to_string(value);
    const bool whole = text.find_first_of("-/e") == std::string::npos;
    return {text, whole                                 ? emit::Strength::atom
                  : text.front() == '-'                 ? emit::Strength::sum
                  : text.find('/') != std::string::npos ? emit::Strength::product
                                                        : emit::Strength::atom};
  }
  [[nodiscard]] emit::Phrase function(std::string_view name, const emit::Phrase& argument) const override {
    return {std::string(name) + "(" + argument.text + ")", emit::Strength::atom};
  }
  [[nodiscard]] emit::Phrase power(const emit::Phrase& base, const Real& exponent) const override {
    return {"pow(" + base.text + ", " + to_string(exponent) + ")", emit::Strength::atom};
  }
  [[nodiscard]] emit::Phrase choice(const emit::Phrase& condition, const emit::Phrase& positive,
                                    const emit::Phrase& otherwise) const override {
    return {"select(" + condition.text + " > 0, " + positive.text + ", " + otherwise.text + ")",
            emit::Strength::atom};
  }
};

using Definitions = std::vector<std::pair<std::string, std::string>>;

// The outputs of a tape as expressions of the names of its inputs and of the time, and the definitions that
// they read, which are called PREFIX1, PREFIX2, ...
std::pair<std::vector<std::string>, Definitions> text_of_tape(const PyTape& of,
                                                              const std::vector<std::string>& inputs,
                                                              const std::string& time,
                                                              const std::string& prefix) {
  const Tape& tape = *of.tape;
  if (!tape.solves.empty())
    throw InputError("to_toml: text models have no pfaff.solve; expected formulas without it");
  const TextModelLanguage language;
  const emit::Plan plan(tape, language.rules());
  std::vector<std::string> names(tape.code.size());
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    if (tape.code[k].operation == Operation::time) names[k] = time;
    if (tape.code[k].operation == Operation::input)
      names[k] = inputs.at(static_cast<std::size_t>(tape.code[k].a));
  }
  int count = 0;
  for (const int slot : plan.statements())
    names[static_cast<std::size_t>(slot)] = prefix + std::to_string(++count);
  const emit::Expressions expressions(tape, language, names);
  Definitions definitions;
  for (const int slot : plan.statements())
    definitions.emplace_back(names[static_cast<std::size_t>(slot)], expressions.definition(slot).text);
  return {emit::outputs_of(tape, language, names), std::move(definitions)};
}

std::optional<std::pair<PyTape, PyTape>> split_energy(const PyTape& hamiltonian, int dimension) {
  const auto parts = separable_energy(*hamiltonian.tape, dimension);
  if (!parts) return std::nullopt;
  return std::pair(PyTape{parts->kinetic}, PyTape{parts->potential});
}
}  // namespace

void bind_text_formulas(py::module_& module) {
  module.def("text_of_tape", &text_of_tape);
  module.def("split_energy", &split_energy);
}

}  // namespace pfaff::python
