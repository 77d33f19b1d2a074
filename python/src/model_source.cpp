// Models of traced formulas: `_pfaff.traced_model`, and the rows of formulas by which Python knows what may
// be written and of what size it is.
#include <pybind11/stl.h>

#include <pfaff/brackets/text/text_bracket.hpp>
#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/core/facets/redundant_constraints.hpp>
#include <pfaff/core/facets/taped_flows.hpp>
#include <pfaff/core/facets/written_formulas.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/polynomial_degree.hpp>
#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/recording.hpp>
#include <pfaff/python/src/separable_energy.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/systems/text/declaration.hpp>
#include <pfaff/systems/text/followed_quantities.hpp>

namespace py = pybind11;

namespace pfaff::python {

Real number_of(const std::string& text, const std::string& what) { return finite_number(text, what); }

namespace {
// One row of core/facets/formula_rows.hpp, as text.
struct WrittenRow {
  const char *name, *result, *signature;
};
constexpr std::array written_rows{
#define PFAFF_FORMULA(name, result, signature, ...) WrittenRow{#name, #result, #signature},
#include <pfaff/core/facets/formula_rows.hpp>
};

using SizeOf = detail::FormulaSize (*)(const detail::Sizes&);
constexpr std::array<SizeOf, formula_count> size_of_formula{
#define PFAFF_FORMULA(name, ...) &detail::size_of<Formula::name>,
#define PFAFF_BRACKET(name, ...) &detail::size_of<Formula::name>,
#define PFAFF_DERIVED(name, ...) nullptr,
#include <pfaff/core/facets/formula_rows.hpp>
};

Formula formula_named(const std::string& name) {
  for (const FormulaRow& row : formula_table)
    if (row.name == name) return row.formula;
  throw InputError("unknown formula '" + name + "'");
}

py::list formula_rows() {
  py::list rows;
  for (const WrittenRow& row : written_rows)
    rows.append(py::make_tuple(row.name, std::string(row.result) != "void", row.signature,
                               row_of(formula_named(row.name)).traits.may_skip_zeros));
  return rows;
}
py::dict count_rows() {
  py::dict rows;
#define PFAFF_COUNT(name, member, names, letter) rows[#name] = py::make_tuple(#member, #names, letter);
#include <pfaff/core/facets/formula_rows.hpp>
  return rows;
}

// How many numbers a formula reads and writes; what its sizes are made of is given by name.
std::pair<int, int> formula_size(const std::string& name, const std::map<std::string, int>& of) {
  detail::Sizes sizes;
  const auto number = [&](const char* key) {
    const auto found = of.find(key);
    return found == of.end() ? 0 : found->second;
  };
  sizes.n = number("n");
  sizes.invariants = number("invariants");
  sizes.casimirs = number("casimirs");
#define PFAFF_COUNT(name, ...) sizes.name = number(#name);
#include <pfaff/core/facets/formula_rows.hpp>
  const detail::FormulaSize size = size_of_formula[index(formula_named(name))](sizes);
  return {size.inputs, size.outputs};
}

using Texts = std::vector<std::pair<std::string, std::string>>;

// Invariants that are polynomials of degree two are marked as such: methods are held to keeping them.
void mark_quadratic(ModelSource& source) {
  const auto& values = source.given[index(Formula::invariants)];
  if (values == nullptr) return;
  for (std::size_t k = 0; k < source.invariants.size(); ++k) {
    Tape one = *values;
    one.outputs = {values->outputs[k]};
    const auto degree = polynomial_degree(one);
    source.invariants[k].quadratic = one.autonomous() && degree && *degree <= 2;
  }
}

void take_separable_energy(ModelSource& source) {
  auto& hamiltonian = source.given[index(Formula::hamiltonian)];
  auto &kinetic = source.given[index(Formula::kinetic)], &potential = source.given[index(Formula::potential)];
  if (!source.canonical || hamiltonian == nullptr || kinetic != nullptr || potential != nullptr) return;
  if (const auto found = separable_energy(*hamiltonian, source.dimension)) {
    kinetic = found->kinetic, potential = found->potential;
    hamiltonian = nullptr;
  }
}

PySystem traced_model(const py::dict& of) {
  ModelSource source;
  source.name = of["name"].cast<std::string>();
  source.time_unit = of["time_unit"].cast<std::string>();
  for (const auto& [name, unit] : of["coordinates"].cast<Texts>()) source.coordinates.push_back({name, unit});
  source.dimension = static_cast<int>(source.coordinates.size());
  for (const auto& text : of["initial"].cast<std::vector<std::string>>())
    source.initial.push_back(number_of(text, "initial state of " + source.name));
  source.parameters = of["parameters"].cast<Texts>();
  for (const auto& [name, tape] : of["formulas"].cast<std::map<std::string, PyTape>>())
    source.given[index(formula_named(name))] = tape.tape;
#define PFAFF_COUNT(name, member, names, ...) source.names = of[#names].cast<std::vector<std::string>>();
#include <pfaff/core/facets/formula_rows.hpp>
  for (const auto& [name, unit, behaviour] :
       of["invariants"].cast<std::vector<std::tuple<std::string, std::string, std::string>>>())
    source.invariants.push_back({name, unit, text::behaviour_named(behaviour), false});
  if (!of["damping"].is_none()) source.damping = number_of(of["damping"].cast<std::string>(), "damping");
  if (const auto parts = of["parts"].cast<std::vector<PyTape>>(); !parts.empty()) {
    std::vector<std::shared_ptr<const Tape>> changes;
    for (const PyTape& part : parts) changes.push_back(part.tape);
    if (source.part_names.size() != changes.size())
      throw InputError("system " + source.name + ": expected a name for each of its " +
                       std::to_string(changes.size()) + " parts");
    source.flows = std::make_shared<const TapedFlowsFactory>(std::move(changes));
  }
  if (!of["small_part"].is_none()) source.small_part = of["small_part"].cast<std::size_t>();
  source.canonical = members_of(source).canonical();
  if ((source.canonical || source.damping) && source.dimension % 2 != 0)
    throw InputError("system " + source.name + ": there are " + std::to_string(source.dimension) +
                     " coordinates; expected an even number, first all positions and then their momenta");
  check_source(source);  // before its formulas are taken together
  take_separable_energy(source);
  leave_out_redundant(source);
  text::leave_out_zero_offsets(source);
  text::add_followed_quantities(source);
  mark_quadratic(source);
  return {std::make_shared<const Model>(std::move(source))};
}

bool same_tape(const PyTape& a, const PyTape& b) {
  const auto same_constants = [](const Real& x, const Real& y) {
    return x == y || (isnan(x.quad()) && isnan(y.quad()));
  };
  const auto same_system = [](const LinearSystem& x, const LinearSystem& y) {
    return x.matrix == y.matrix && x.right_hand_side == y.right_hand_side;
  };
  return a.tape->inputs == b.tape->inputs && a.tape->code == b.tape->code &&
         a.tape->outputs == b.tape->outputs &&
         std::equal(a.tape->constants.begin(), a.tape->constants.end(), b.tape->constants.begin(),
                    b.tape->constants.end(), same_constants) &&
         std::equal(a.tape->solves.begin(), a.tape->solves.end(), b.tape->solves.begin(),
                    b.tape->solves.end(), same_system);
}

// The tensor, row by row, and the Casimirs of a bracket that is named as in text models,
// "lie-poisson(algebra=so3)"; None for the Casimirs where it states none.
py::tuple named_bracket(const std::string& text, std::size_t dimension) {
  const BracketInstance made = chosen_bracket(text, "").instance;
  if (const std::string reason = tensor_refused(made, dimension); !reason.empty())
    throw InputError("bracket " + text + ": " + reason);
  return py::make_tuple(PyTape{recorded_tensor(made)},
                        made.casimirs ? py::cast(PyTape{made.casimirs}) : py::none());
}

// A tape as plain data, for pickle.
py::tuple data_of(const PyTape& tape) {
  const Tape& t = *tape.tape;
  std::vector<std::array<int, 4>> code;
  for (const Instruction& i : t.code) code.push_back({static_cast<int>(i.operation), i.a, i.b, i.c});
  std::vector<std::string> constants;
  for (const Real& x : t.constants) constants.push_back(to_string(x));
  std::vector<std::tuple<int, std::vector<int>, std::vector<int>>> solves;
  for (const LinearSystem& s : t.solves) solves.emplace_back(s.size, s.matrix, s.right_hand_side);
  return py::make_tuple(t.inputs, code, constants, solves, t.outputs, t.time_begin, t.state_begin);
}
PyTape tape_of(const py::tuple& data) {
  Tape t;
  t.inputs = data[0].cast<int>();
  for (const auto& i : data[1].cast<std::vector<std::array<int, 4>>>())
    t.code.push_back({static_cast<Operation>(i[0]), i[1], i[2], i[3]});
  for (const auto& text : data[2].cast<std::vector<std::string>>())
    t.constants.push_back(number_of(text, "constant of a tape"));
  for (auto& [size, matrix, right] :
       data[3].cast<std::vector<std::tuple<int, std::vector<int>, std::vector<int>>>>())
    t.solves.push_back({size, std::move(matrix), std::move(right)});
  t.outputs = data[4].cast<std::vector<int>>();
  t.time_begin = data[5].cast<int>(), t.state_begin = data[6].cast<int>();
  return {std::make_shared<const Tape>(std::move(t))};
}

// The results of a tape as numbers of the recording that its arguments belong to.
std::vector<Number> recorded_anew(const PyTape& tape, const py::object& time,
                                  const std::vector<py::object>& arguments) {
  Number all{0};
  std::vector<Recorded> x;
  const auto number = [&](const py::object& object) {
    const auto found = number_from(object);
    if (!found) refuse_traced("expected numbers as arguments of a formula of the system");
    all.recording = recording_of(all, *found);
    return found->value;
  };
  const Recorded t = number(time);
  for (const py::object& one : arguments) x.push_back(number(one));
  if (x.size() != static_cast<std::size_t>(tape.tape->inputs))
    throw InputError("a formula of the system: expected " + std::to_string(tape.tape->inputs) +
                     " numbers, got " + std::to_string(x.size()));
  std::vector<Number> results;
  for (Recorded& value : evaluate(*tape.tape, t, x)) results.push_back({std::move(value), all.recording});
  return results;
}

std::vector<double> values_of(const PyTape& tape, double t, const std::vector<double>& arguments) {
  if (arguments.size() != static_cast<std::size_t>(tape.tape->inputs))
    throw InputError("tape: expected " + std::to_string(tape.tape->inputs) + " numbers, got " +
                     std::to_string(arguments.size()));
  std::vector<double> results(tape.tape->outputs.size());
  Replay<double>(tape.tape)(t, arguments.data(), results.data());
  return results;
}
}  // namespace

void bind_model_source(py::module_& module) {
  py::class_<PyTape>(module, "Tape", "A recorded formula.")
      .def_property_readonly("inputs", [](const PyTape& t) { return t.tape->inputs; })
      .def_property_readonly("outputs", [](const PyTape& t) { return t.tape->outputs.size(); })
      .def_property_readonly("operations", [](const PyTape& t) { return t.tape->code.size(); })
      .def_property_readonly("constants",
                             [](const PyTape& t) {
                               std::vector<std::string> texts;
                               for (const Real& x : t.tape->constants) texts.push_back(to_string(x));
                               return texts;
                             })
      .def("same", &same_tape)
      .def("record", &recorded_anew)
      .def("__call__", &values_of)
      .def(py::pickle(&data_of, &tape_of));
  module.def("traced_model", &traced_model);
  module.def("formula_rows", &formula_rows);
  module.def("count_rows", &count_rows);
  module.def("named_bracket", &named_bracket);
  module.def("nearest", [](const std::string& name, const std::vector<std::string>& names) {
    return nearest(name, names);
  });
  module.def("formula_size", &formula_size);
  module.def("unknown_name",
             [](const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
               return unknown_name(kind, name, names);
             });
}

}  // namespace pfaff::python
