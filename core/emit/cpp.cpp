// Equations as a C++ function.
#include <algorithm>

#include <pfaff/core/emit/cpp_function.hpp>
#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/emit/names.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

namespace {
using namespace emit;

// The legend of one array: "//   state[0] = q1 [m]".
std::string legend(const std::string& array, const std::vector<Symbol>& symbols) {
  std::string text;
  for (std::size_t k = 0; k < symbols.size(); ++k)
    text += "//   " + array + "[" + std::to_string(k) + "]  " + plain_words(symbols[k].name) +
            (symbols[k].unit.empty() ? "" : " [" + plain_words(symbols[k].unit) + "]") + "\n";
  return text;
}
}  // namespace

std::string write_cpp(const Equations& equations) {
  const Cpp language("std::");
  const Plan plan = cpp_plan(equations.tape, language);
  Names names({"_", cpp_reserved, &with_underscore});
  CppInterface interface;
  interface.name = names(equations.system + "_rates");
  const TextNames text_name = text_names(equations, plan, names);
  const std::string arguments = "[[maybe_unused]] double " + text_name.time +
                                ", [[maybe_unused]] const double* state, "
                                "[[maybe_unused]] const double* parameters";
  interface.parameters = arguments + ", double* results";
  interface.part_parameters = arguments;
  interface.part_arguments = text_name.time + ", state, parameters";
  interface.input_names = text_name.inputs;
  const std::size_t n = equations.coordinates.size();
  for (std::size_t k = 0; k < text_name.inputs.size(); ++k)
    interface.input_values.push_back(k < n ? "state[" + std::to_string(k) + "]"
                                           : "parameters[" + std::to_string(k - n) + "]");

  std::string text = "// Equations of motion of " + plain_words(equations.system) + ", by the method " +
                     plain_words(equations.method) + ". Written by Pfaff.\n//\n" +
                     legend("state", equations.coordinates) + legend("parameters", equations.parameters);
  text += "//   results[k]  the rate of state[k]\n";
  for (std::size_t k = 0; k < equations.further_outputs.size(); ++k)
    text +=
        "//   results[" + std::to_string(n + k) + "]  " + plain_words(equations.further_outputs[k]) + "\n";
  text +=
      "//\n// Results may lie where the state does. Compile with -ffp-contract=off for the numbers of "
      "Pfaff.\n";
  text += "#include <cmath>\n\n";
  std::string helpers = cpp_solver(equations.tape);
  const Tape& tape = equations.tape;
  if (std::any_of(tape.code.begin(), tape.code.end(), [&tape](const Instruction& i) {
        return i.operation == Operation::power &&
               is_small_half_integer(tape.constants[static_cast<std::size_t>(i.b)]);
      }))
    helpers += cpp_half_power("std::");
  if (!helpers.empty()) text += "namespace {\n\n" + helpers + "}  // namespace\n\n";
  return text + cpp_function(equations.tape, plan, language, interface, text_name.slots);
}

}  // namespace pfaff
