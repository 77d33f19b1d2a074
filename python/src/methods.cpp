// Methods: `_pfaff.MethodInstance`, registered ones, tables of coefficients, and those that are functions of
// Python, recorded on each model or called at every step.
#include <pybind11/stl.h>

#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/callbacks.hpp>
#include <pfaff/python/src/called_method.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/offered_formulas.hpp>
#include <pfaff/python/src/stepping.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/tape_method.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
FacetSet facets_named(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const FacetRow& row : facet_table) known.emplace_back(row.name);
  FacetSet set;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError("needs: " + unknown_name("facet", name, known));
    set = set.with(static_cast<Facet>(found - known.begin()));
  }
  return set;
}
std::vector<std::string> names_of(FacetSet set) {
  std::vector<std::string> names;
  for (unsigned k = 0; k < static_cast<unsigned>(Facet::count); ++k)
    if (set.has(static_cast<Facet>(k))) names.emplace_back(to_string(static_cast<Facet>(k)));
  return names;
}

std::vector<Claim> claims_named(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const ClaimRow& row : claim_table) known.emplace_back(row.name);
  std::vector<Claim> claims;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError("preserves: " + unknown_name("claim", name, known));
    claims.push_back(claim_table[static_cast<std::size_t>(found - known.begin())].claim);
  }
  if (claims.empty()) claims.push_back(Claim::none);
  return claims;
}

TapeMethodStatement statement_of(const py::dict& of) {
  TapeMethodStatement statement;
  MethodDescriptor& d = statement.descriptor;
  d.name = of["name"].cast<std::string>();
  d.title = of["title"].cast<std::string>();
  d.reference = of["reference"].cast<std::string>();
  d.description = of["description"].cast<std::string>();
  d.order = of["order"].cast<int>();
  d.preserves = claims_named(of["preserves"].cast<std::vector<std::string>>());
  statement.parameters = of["parameters"].cast<Assignments>();
  statement.needs = facets_named(of["needs"].cast<std::vector<std::string>>());
  statement.compiled = of["compiled"].cast<bool>();
  return statement;
}

PyMethod traced_method(const py::dict& of, const py::object& trace) {
  const SharedObject shared(trace);
  const auto record = [shared](const std::shared_ptr<const Model>& model) {
    return with_lock([&] {
      const py::tuple made = shared.get()(PySystem{model});
      return StepTape{made[0].cast<PyTape>().tape, made[1].cast<std::int64_t>(), made[2].cast<std::size_t>()};
    });
  };
  return {std::make_shared<const TapeMethod>(statement_of(of), record)};
}

PyMethod called_method(const py::dict& of, const py::object& step) {
  TapeMethodStatement statement = statement_of(of);
  return {std::make_shared<const CalledMethod>(
      std::move(statement.descriptor), std::move(statement.parameters), statement.needs, SharedObject(step))};
}

// A table lives as long as what was made of it.
PyMethod table_method(const std::string& path, const Assignments& parameters) {
  const std::shared_ptr<const MethodTable> table = read_method_table(path);
  const std::shared_ptr<const MethodInstance> made = table->make(parameters);
  const auto both = std::make_shared<std::pair<decltype(table), decltype(made)>>(table, made);
  return {{both, made.get()}};
}

// How many right-hand sides a formula counts as, the facets that it belongs to, and its size; of all formulas
// of facets.
py::dict formulas_of_problems() {
  py::dict rows;
  for (const FormulaRow& row : formula_table)
    if (const auto names = names_of(facets_of(row)); !names.empty())
      rows[py::str(std::string(row.name))] =
          py::make_tuple(row.traits.counts == Counts::field ? 1 : 0, names, std::string(row.writes));
  return rows;
}

// The tape of a formula that a problem offers.
PyTape formula_of(const PySystem& system, const std::string& name) {
  return {system.model->tape(offered_formula(*system.model, name).formula)};
}

// The model that a method steps on, the usual motion of one with constraints. InputError where it refuses
// it: what it claims is then asked of a model that has not what it needs.
std::shared_ptr<const Model> stepped_model(const PyMethod& method, const PySystem& system) {
  auto model = model_for(*method.method, system.model, "");
  if (const std::string reason = method.method->refuses(*model); !reason.empty()) throw InputError(reason);
  return model;
}
}  // namespace

void bind_methods(py::module_& module) {
  py::class_<PyMethod>(module, "MethodInstance", "A method with its parameters.")
      .def_property_readonly("name", [](const PyMethod& m) { return m.method->descriptor().name; })
      .def_property_readonly("title", [](const PyMethod& m) { return m.method->descriptor().title; })
      .def_property_readonly("parameters", [](const PyMethod& m) { return m.method->parameters(); })
      .def_property_readonly("needs", [](const PyMethod& m) { return names_of(m.method->needs()); })
      .def_property_readonly("adaptive", [](const PyMethod& m) { return m.method->adaptive(); })
      .def("order",
           [](const PyMethod& m, const PySystem& s) { return m.method->order(*stepped_model(m, s)); })
      .def("preserves",
           [](const PyMethod& m, const PySystem& s) {
             std::vector<std::string> names;
             for (const Claim claim : m.method->preserves(*stepped_model(m, s)))
               names.emplace_back(to_string(claim));
             return names;
           })
      .def("refuses", [](const PyMethod& m, const PySystem& s) { return m.method->refuses(*s.model); });
  module.def("make_method", [](const std::string& name, const Assignments& parameters) {
    return PyMethod{integrator_asked_for(name).make(parameters)};
  });
  module.def("method_parameter_names", [](const std::string& name) {
    std::vector<std::string> names;
    for (const Parameter& p : integrator_asked_for(name).parameters()) names.push_back(p.name);
    return names;
  });
  module.def("method_names", [] { return integrators().names(); });
  module.def("table_method", &table_method);
  module.def("traced_method", &traced_method);
  module.def("called_method", &called_method);
  module.def("formulas_of_problems", &formulas_of_problems);
  module.def("formula_of", &formula_of);
}

}  // namespace pfaff::python
