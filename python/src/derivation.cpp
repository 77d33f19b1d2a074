// Derivation: equations of motion in symbols, as `pfaff derive` makes them.
#include <pybind11/stl.h>

#include <algorithm>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/derive/derivation/derivation.hpp>
#include <pfaff/derive/derivation/named_parameters.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {

DerivationOptions options_of(const std::string& friction, int degree, std::vector<std::string> elimination) {
  DerivationOptions options;
  options.degree = degree;
  options.elimination = std::move(elimination);
  if (degree < 1 || degree > largest_derived_degree)
    throw InputError("order: expected a whole number in 1 .. " + std::to_string(largest_derived_degree) +
                     ", got " + std::to_string(degree));
  if (friction.empty()) return options;
  std::vector<std::string> names;
  for (const FrictionForm form : {FrictionForm::metriplectic, FrictionForm::stokes, FrictionForm::none}) {
    names.emplace_back(to_string(form));
    if (friction == names.back()) options.friction = form;
  }
  if (!options.friction) throw InputError(unknown_name("friction form", friction, names));
  return options;
}

// The method that is asked for; without one the first that fits the model.
std::string method_for(const Model& model, const std::string& asked) {
  if (!asked.empty()) return asked;
  for (const DerivationMethod& method : derivation_methods())
    if (derivation_misfit(model, method.name).empty()) return method.name;
  return derivation_methods().front().name;  // says what it misses
}

// Of a system by its name, with its parameters as symbols where that is possible.
Equations derive_named(const std::string& name, const Assignments& parameters, const std::string& method,
                       const std::string& friction, int degree, std::vector<std::string> elimination) {
  const DerivationOptions options = options_of(friction, degree, std::move(elimination));
  const SystemPlugin& system = system_asked_for(name);
  return without_lock([&] {
    return with_named_parameters(system, parameters, [&](const Model& model) {
      return derive(model, method_for(model, method), options);
    });
  });
}

// Of an object, whose parameters are numbers.
Equations derive_object(const PySystem& system, const std::string& method, const std::string& friction,
                        int degree, std::vector<std::string> elimination) {
  const DerivationOptions options = options_of(friction, degree, std::move(elimination));
  return without_lock([&] { return derive(*system.model, method_for(*system.model, method), options); });
}

std::vector<std::string> names_of(const std::vector<Symbol>& symbols) {
  std::vector<std::string> names;
  for (const Symbol& symbol : symbols) names.push_back(symbol.name);
  return names;
}

std::string written(const Equations& equations, const std::string& language) {
  std::vector<std::string> names;
  for (const Emitter& emitter : emitters()) {
    if (emitter.name == language) return emitter.write(equations);
    names.emplace_back(emitter.name);
  }
  throw InputError(unknown_name("language", language, names));
}

std::vector<std::pair<std::string, std::string>> values_of(const Equations& equations) {
  std::vector<std::pair<std::string, std::string>> values;
  for (std::size_t k = 0; k < equations.parameters.size(); ++k)
    values.emplace_back(equations.parameters[k].name, to_string(equations.parameter_values[k]));
  return values;
}

}  // namespace

void bind_derivation(py::module_& module) {
  py::class_<Equations>(module, "Equations", "Equations of motion as a tape with names.")
      .def_property_readonly("system", [](const Equations& e) { return e.system; })
      .def_property_readonly("method", [](const Equations& e) { return e.method; })
      .def_property_readonly("coordinates", [](const Equations& e) { return names_of(e.coordinates); })
      .def_property_readonly("parameters", &values_of)
      .def_property_readonly("further_outputs", [](const Equations& e) { return e.further_outputs; })
      .def_property_readonly("operations", [](const Equations& e) { return operations(e.tape); })
      .def("written", &written);
  module.def("derive_named", &derive_named);
  module.def("derive_object", &derive_object);
  module.def("derivation_methods", [] {
    std::vector<std::pair<std::string, std::string>> methods;
    for (const DerivationMethod& method : derivation_methods())
      methods.emplace_back(method.name, method.title);
    return methods;
  });
}

}  // namespace pfaff::python
