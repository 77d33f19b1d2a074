#include <pfaff/core/native/compiled_model.hpp>

#include <atomic>

#include <pfaff/core/emit/cpp_function.hpp>
#include <pfaff/core/emit/names.hpp>
#include <pfaff/core/errors/notices.hpp>
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
// Packs are for systems whose steps are short; each of the two widths takes the compiler as long as doubles
// do.
constexpr std::size_t longest_in_lanes = 2000;

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

// What methods evaluate at several points side by side. Linear systems have pivots of their own at each
// point, so that packs of them gain little, and lose where half of the lanes have no point.
bool is_in_lanes(Formula formula, const Tape& tape) {
  return (row_of(formula).traits.in_lanes || formula == Formula::chart_field) && tape.solves.empty() &&
         tape.code.size() <= longest_in_lanes;
}

// Vectors of doubles with the operations of formulas. Each lane has the bits of a double: functions are
// called for one lane after the other, and once for lanes in a row with the same number, with which packs are
// filled up. Zeros of either sign are equal, and functions of them are not.
constexpr const char* lanes_prelude = R"(typedef double lanes4 __attribute__((vector_size(32), aligned(8)));
typedef double lanes8 __attribute__((vector_size(64), aligned(8)));
template <class P> constexpr unsigned lane_count = sizeof(P) / sizeof(double);
inline double lane_of(double x, unsigned) { return x; }
template <class P> inline double lane_of(const P& x, unsigned lane) { return x[lane]; }
template <class P, class X> inline P as_lanes(const X& x) {
  P r;
  for (unsigned lane = 0; lane < lane_count<P>; ++lane) r[lane] = lane_of(x, lane);
  return r;
}
template <class P> inline P sqrt(const P& x) {
  P r;
  for (unsigned lane = 0; lane < lane_count<P>; ++lane) r[lane] = sqrt(x[lane]);
  return r;
}
template <class P, class F> inline P each_lane(const P& x, F f) {
  P r;
  double of = x[0], y = f(of);
  r[0] = y;
  for (unsigned lane = 1; lane < lane_count<P>; ++lane) {
    if (x[lane] != of || of == 0.0) y = f(of = x[lane]);
    r[lane] = y;
  }
  return r;
}
template <class P> inline P pow(const P& x, double y) { return each_lane(x, [y](double a) { return pow(a, y); }); }
template <class P, class A, class B> inline P choose_lanes(const P& condition, const A& positive, const B& otherwise) {
  P r;
  for (unsigned lane = 0; lane < lane_count<P>; ++lane)
    r[lane] = condition[lane] > 0.0 ? lane_of(positive, lane) : lane_of(otherwise, lane);
  return r;
}
)";

// What text(name) gives for each name.
template <class Names, class Text>
std::string of_each(const Names& names, const Text& text) {
  std::string all;
  for (const std::string_view name : names) all += text(std::string(name));
  return all;
}

// The functions of the library that formulas call, and the same for vectors; roots of these the prelude has.
std::string library_functions() {
  const auto declared = [](const std::string& name) { return "double " + name + "(double) noexcept;\n"; };
  return "extern \"C\" {\n" + of_each(elementary_functions, declared) + of_each(special_functions, declared) +
         "double pow(double, double) noexcept;\n}\n\n";
}
std::string functions_in_lanes() {
  const auto by_lanes = [](const std::string& name) {
    if (name == "sqrt") return std::string();
    return "template <class P> inline P " + name +
           "(const P& x) { return each_lane(x, [](double a) { return " + name + "(a); }); }\n";
  };
  return of_each(elementary_functions, by_lanes) + of_each(special_functions, by_lanes);
}

std::string symbol_of(Formula formula, const std::string& lanes = "") {
  return "pfaff_" + std::string(row_of(formula).name) + lanes;
}

std::string function_text(const Tape& tape, const std::string& symbol, const Cpp& language,
                          const std::string& number = "double") {
  Equations equations;  // names only
  equations.tape = tape;
  for (int k = 0; k < tape.inputs; ++k) equations.coordinates.push_back({"z" + std::to_string(k + 1), ""});
  const Plan plan = cpp_plan(tape, language);
  Names names({"_", cpp_reserved, &with_underscore});
  const TextNames text_name = text_names(equations, plan, names);
  CppInterface interface;
  interface.name = symbol;
  interface.number = number;
  interface.part_parameters = "const " + number + "& t, const " + number + "* arguments";
  interface.parameters = "const void*, " + interface.part_parameters + ", " + number + "* results";
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
  const CppInLanes language_in_lanes;
  std::string functions, solver, in_lanes;
  for (const Formula formula : candidates) {
    if (!to_be_compiled(model, formula, anew)) continue;
    const Tape& tape = *model.tape(formula);
    if (solver.empty()) solver = cpp_solver(tape);
    functions += function_text(tape, symbol_of(formula), language) + "\n";
    if (!is_in_lanes(formula, tape)) continue;
    in_lanes = lanes_prelude + functions_in_lanes();
    for (const std::string width : {"4", "8"})
      functions +=
          function_text(tape, symbol_of(formula, "_" + width), language_in_lanes, "lanes" + width) + "\n";
  }
  if (functions.empty() && !anew) return result;
  result.text = library_functions() + in_lanes + cpp_half_power("") + solver + functions + result.series.text;
  return result;
}

// What a compiled model keeps: the author's object, the code, and what its series are called with.
struct Owner {
  std::shared_ptr<const void> system;
  std::shared_ptr<const native::Library> library;
  std::unique_ptr<const native::NativeSeries> series;
};
}  // namespace

namespace {
bool compiles() {
  if (!native::compiler_version().empty()) return true;
  static std::atomic<bool> said{false};
  if (!said.exchange(true)) notice("there is no C++ compiler here; formulas are interpreted");
  return false;
}
}  // namespace

CompiledTape compiled(const Tape& tape, const std::string& what) {
  if (tape.code.size() > longest_tape || !compiles()) return {};
  const Cpp language("");
  const std::string symbol = "pfaff_tape";
  auto library = native::library_of(
      library_functions() + cpp_half_power("") + cpp_solver(tape) + function_text(tape, symbol, language),
      what);
  return {reinterpret_cast<CompiledFormula>(library->symbol(symbol)), std::move(library)};
}

std::string native_text(const Model& model) { return text_of(model).text; }

std::shared_ptr<const Model> compiled(const std::shared_ptr<const Model>& model) {
  if (!compiles()) return model;
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
  const auto code = [&](Formula formula, const std::string& lanes = "") {
    return owner->library->symbol(symbol_of(formula, lanes));
  };
  for (const Formula formula : candidates)
    if (void* address = code(formula))
      source.compiled[index(formula)] = {.one = reinterpret_cast<CompiledFormula>(address),
                                         .four = reinterpret_cast<CompiledInLanes<4>>(code(formula, "_4")),
                                         .eight = reinterpret_cast<CompiledInLanes<8>>(code(formula, "_8"))};
  source.system = std::shared_ptr<const void>(std::move(owner), object);
  return std::make_shared<const Model>(std::move(source));
}

}  // namespace pfaff
