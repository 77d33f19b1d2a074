// Models: `_pfaff.Model`, what it says of itself, and those of registered systems and text models.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>

#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
py::list coordinates_of(const PySystem& system) {
  py::list list;
  for (const Coordinate& c : system.model->coordinates()) list.append(py::make_tuple(c.name, c.unit));
  return list;
}
py::list invariants_of(const PySystem& system) {
  py::list list;
  for (const Invariant& i : system.model->invariants())
    list.append(py::make_tuple(i.name, i.unit, std::string(to_string(i.behaviour)), i.quadratic));
  return list;
}
py::array_t<double> initial_of(const PySystem& system) {
  const auto& initial = system.model->initial();
  py::array_t<double> z(static_cast<py::ssize_t>(initial.size()));
  for (std::size_t k = 0; k < initial.size(); ++k) z.mutable_data()[k] = initial[k].value();
  return z;
}
std::vector<std::string> exact_initial_of(const PySystem& system) {
  std::vector<std::string> texts;
  for (const Real& x : system.model->initial()) texts.push_back(to_string(x));
  return texts;
}
std::vector<std::string> facets_of(const PySystem& system) {
  std::vector<std::string> names;
  for (unsigned k = 0; k < static_cast<unsigned>(Facet::count); ++k)
    if (system.model->facets().has(static_cast<Facet>(k)))
      names.emplace_back(to_string(static_cast<Facet>(k)));
  return names;
}

// Whether a tape has a selection that time or the state decides; what depends on neither stands before
// time_begin.
bool selects(const Tape& tape) {
  return std::any_of(tape.code.begin(), tape.code.end(), [&](const Instruction& i) {
    return i.operation == Operation::select && i.a >= tape.time_begin;
  });
}

// Whether the motion may pass from one branch of its formulas to another: energies, fields and constraints as
// they were written, since what follows from them has their selections.
bool may_jump(const PySystem& system) {
  for (const FormulaRow& row : formula_table) {
    const Formula f = row.formula;
    if (f == Formula::invariants || f == Formula::exact_solution || f == Formula::reversal) continue;
    if (system.model->given(f) && selects(*system.model->tape(f))) return true;
  }
  return false;
}

py::list parameters_of_plugin(const Plugin& plugin, const Assignments& defaults) {
  py::list list;
  for (const Parameter& p : plugin.parameters()) {
    std::string value;
    for (const auto& [key, text] : defaults)
      if (key == p.name) value = text;
    list.append(py::make_tuple(p.name, value, p.unit, range_of(p), p.meaning));
  }
  return list;
}
}  // namespace

void bind_systems(py::module_& module) {
  py::class_<PySystem>(module, "Model", "A system with its parameters.")
      .def_property_readonly("name", [](const PySystem& s) { return s.model->name(); })
      .def_property_readonly("dimension", [](const PySystem& s) { return s.model->dimension(); })
      .def_property_readonly("coordinates", &coordinates_of)
      .def_property_readonly("invariants", &invariants_of)
      .def_property_readonly("initial", &initial_of)
      .def_property_readonly("exact_initial", &exact_initial_of)
      .def_property_readonly("parameters", [](const PySystem& s) { return s.model->parameters(); })
      .def_property_readonly("facets", &facets_of)
      .def_property_readonly("may_jump", &may_jump)
      .def_property_readonly("damping",
                             [](const PySystem& s) {
                               const auto& rate = s.model->source().damping;
                               if (!rate) throw InputError("system " + s.model->name() + " has no damping");
                               return to_string(*rate);
                             })
      .def_property_readonly("time_unit", [](const PySystem& s) { return s.model->time_unit(); })
      .def_property_readonly("formulation", [](const PySystem& s) { return s.model->source().formulation; })
      .def_property_readonly("constraint_names",
                             [](const PySystem& s) { return s.model->constraint_names(); })
      .def("__repr__", [](const PySystem& s) { return "<model of " + s.model->name() + ">"; })
      .def("compiled",
           [](const PySystem& s) { return PySystem{without_lock([&] { return compiled(s.model); })}; });
  module.def("make_system", [](const std::string& name, const Assignments& parameters) {
    const SystemPlugin& plugin = system_asked_for(name);
    return PySystem{without_lock([&] { return plugin.make(parameters); })};
  });
  module.def("system_names", [] { return systems().names(); });
  module.def("system_parameters", [](const std::string& name) {
    const SystemPlugin& plugin = system_asked_for(name);
    return parameters_of_plugin(plugin, plugin.make({})->parameters());
  });
  module.def("system_parameter_names", [](const std::string& name) {
    std::vector<std::string> names;
    for (const Parameter& p : system_asked_for(name).parameters()) names.push_back(p.name);
    return names;
  });
  module.def("system_title",
             [](const std::string& name) { return system_asked_for(name).descriptor().title; });
}

}  // namespace pfaff::python
