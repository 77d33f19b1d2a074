#include <pfaff/core/native/compiled_model.hpp>

#include <iostream>
#include <mutex>

#include <pfaff/core/emit/cpp_function.hpp>
#include <pfaff/core/emit/names.hpp>
#include <pfaff/core/native/native_series.hpp>

namespace pfaff {

namespace {
using namespace emit;

// Formulas that methods and runs evaluate at every step.
constexpr std::array candidates{
    Formula::field,       Formula::field_jacobian,       Formula::force,       Formula::velocity,
    Formula::chart,       Formula::chart_inverse,        Formula::chart_field, Formula::chart_field_jacobian,
    Formula::hamiltonian, Formula::hamiltonian_gradient, Formula::structure,   Formula::poisson_tensor,
    Formula::invariants};

// Longer tapes are left to be replayed; so are matrices of many variables, which are full of zeros. Programs
// of larger systems loop faster than a text as long as the system runs.
constexpr std::size_t longest_tape = 200000, longest_program = 20000;
constexpr int most_columns = 64, most_in_program = 400;

bool is_jacobian(Formula f) { return f == Formula::field_jacobian || f == Formula::chart_field_jacobian; }

// The field that a formulation makes of a small system.
bool is_formulated(const Model& model, Formula formula) {
  return formula == Formula::field && model.program(formula) != nullptr &&
         !model.source().formulation.empty() && model.dimension() <= most_in_program;
}

bool is_tensor(Formula f) { return f == Formula::structure || f == Formula::poisson_tensor; }

bool to_be_compiled(const Model& model, Formula formula, bool anew) {
  if (is_formulated(model, formula)) return model.tape(formula)->code.size() <= longest_program;
  if ((model.compiled(formula) != nullptr && !anew) || model.program(formula) != nullptr) return false;
  if (formula == Formula::chart_field && model.canonical() && !model.given(Formula::chart))
    return false;  // it is the field itself
  if ((is_jacobian(formula) || is_tensor(formula)) && model.dimension() > most_columns) return false;
  if (is_jacobian(formula) && model.program(Formula::field) != nullptr) return false;
  if (!model.given(formula) && derivation_of(formula, model) == nullptr) return false;
  return model.tape(formula)->code.size() <= longest_tape;
}

std::string symbol_of(Formula formula) { return "pfaff_" + std::string(row_of(formula).name); }

std::string function_text(const Tape& tape, const std::string& symbol, const Cpp& language) {
  Equations equations;  // names only
  equations.tape = tape;
  for (int k = 0; k < tape.inputs; ++k) equations.coordinates.push_back({"z" + std::to_string(k + 1), ""});
  const Plan plan = cpp_plan(tape, language);
  Names names({"_", cpp_reserved, &with_underscore});
  const TextNames text_name = text_names(equations, plan, names);
  CppInterface interface;
  interface.name = symbol;
  interface.part_parameters = "const double& t, const double* arguments";
  interface.parameters = "const void*, " + interface.part_parameters + ", double* results";
  interface.part_arguments = "t, arguments";
  interface.input_names = text_name.inputs;
  for (int k = 0; k < tape.inputs; ++k)
    interface.input_values.push_back("arguments[" + std::to_string(k) + "]");
  return cpp_function(tape, plan, language, interface, text_name.slots);
}

// The text of a model. Compiled series are called with an object of their own in the place of the author's.
// Where there are some, every formula is therefore compiled from its tape (`anew`), the author's too.
struct NativeText {
  std::string text;
  native::SeriesText series;
};

NativeText text_of(const Model& model) {
  NativeText result;
  if (model.content().has(Facet::darboux_chart) && model.chart_field_series() == nullptr &&
      model.program(Formula::chart_field) == nullptr && model.program(Formula::field) == nullptr)
    result.series = native::series_text(*model.tape(Formula::chart_field));
  const bool anew = !result.series.text.empty();
  const Cpp language("");
  std::string functions, solver;
  for (const Formula formula : candidates) {
    if (!to_be_compiled(model, formula, anew)) continue;
    const Tape& tape = *model.tape(formula);
    if (solver.empty()) solver = cpp_solver(tape);
    functions += function_text(tape, symbol_of(formula), language) + "\n";
  }
  if (functions.empty() && !anew) return result;
  result.text =
      "extern \"C\" {\ndouble sqrt(double) noexcept;\ndouble exp(double) noexcept;\ndouble log(double) "
      "noexcept;\n"
      "double sin(double) noexcept;\ndouble cos(double) noexcept;\ndouble pow(double, double) "
      "noexcept;\n}\n\n" +
      solver + functions + result.series.text;
  return result;
}

// What a compiled model keeps: the author's object, the code, and what its series are called with.
struct Owner {
  std::shared_ptr<const void> system;
  std::shared_ptr<const native::Library> library;
  std::unique_ptr<const native::NativeSeries> series;
};
}  // namespace

std::string native_text(const Model& model) { return text_of(model).text; }

std::shared_ptr<const Model> compiled(const std::shared_ptr<const Model>& model) {
  if (native::compiler_version().empty()) {
    static std::once_flag said;
    std::call_once(said,
                   [] { std::cerr << "pfaff: there is no C++ compiler here; formulas are interpreted\n"; });
    return model;
  }
  const NativeText text = text_of(*model);
  if (text.text.empty()) return model;
  ModelSource source = model->source();
  auto owner = std::make_shared<Owner>();
  owner->system = source.system;
  owner->library = native::library_of(text.text, "system " + model->name());
  const void* object = source.system.get();
  if (!text.series.text.empty()) {
    owner->series = std::make_unique<const native::NativeSeries>(owner->library, text.series);
    source.compiled = {};
    source.chart_field_series = &owner->series->series();
    object = owner->series.get();
  }
  for (const Formula formula : candidates)
    if (void* address = owner->library->symbol(symbol_of(formula)))
      source.compiled[index(formula)] = {.one = reinterpret_cast<CompiledFormula>(address)};
  source.system = std::shared_ptr<const void>(std::move(owner), object);
  return std::make_shared<const Model>(std::move(source));
}

}  // namespace pfaff
