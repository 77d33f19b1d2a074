// Evaluation: a system at one state and time, as `pfaff evaluate` shows it, and brackets of functions.
#include <pybind11/stl.h>

#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/bench/runner/initial_state.hpp>
#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/json_value.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {

// A system with constraints is taken in the formulation that is named, or in the default one.
std::shared_ptr<const Model> motion_in(const std::shared_ptr<const Model>& model,
                                       const std::string& formulation) {
  if (formulation.empty()) return motion_of(model);
  const AskedFormulation asked = formulation_asked_for(*model, formulation);
  return asked.plugin->apply(model, asked.parameters);
}

py::dict evaluated_at(const PySystem& system, const std::vector<std::string>& state, const std::string& t,
                      const std::string& formulation, const std::string& precision,
                      const std::optional<std::vector<std::string>>& centre) {
  return python_value(without_lock([&] {
           EvaluationSettings settings;
           settings.at.model = motion_in(system.model, formulation);
           settings.at.t = finite_number(t, "time");
           settings.at.state = state.empty() ? initial_state(*settings.at.model, {}, settings.at.t)
                                             : state_numbers(*settings.at.model, state, "state");
           settings.precision = parse_precision(precision);
           if (centre) settings.centre = state_numbers(*settings.at.model, *centre, "centre");
           return evaluation(settings);
         }))
      .cast<py::dict>();
}

std::vector<double> values_of(std::shared_ptr<const Tape> tape, double t, const std::vector<double>& z) {
  Replay<double> replay(std::move(tape));
  std::vector<double> values(replay.tape().outputs.size());
  replay(t, z.data(), values.data());
  return values;
}

// The tensor of the bracket that makes a motion of an energy: Dirac's or the nonholonomic one where the
// system has constraints, otherwise its own.
Matrix<double> tensor_of(const Model& model, const Model& motion, double t, const std::vector<double>& z) {
  if (model.nonholonomic()) return nonholonomic_point(model, t, z).tensor;
  if (motion.constrained()) return dirac_tensor(constraint_brackets<double>(motion, t, z));
  if (!motion.facets().meets(facets(Facet::hamiltonian, Facet::metriplectic, Facet::structure)))
    throw InputError("on: " + model.name() +
                     " states a field alone; expected a system whose energy and structure make its field");
  Matrix<double> tensor(z.size(), z.size());
  const std::vector<double> entries = values_of(motion.tape(Formula::poisson_tensor), t, z);
  for (std::size_t k = 0; k < entries.size(); ++k) tensor(k / z.size(), k % z.size()) = entries[k];
  return tensor;
}

// {f, g} = df . Pi dg.
double bracket_of(const PySystem& system, const PyTape& f, const PyTape& g, double t,
                  const std::vector<double>& z) {
  return without_lock([&] {
    const auto model = motion_of(system.model);
    if (static_cast<std::size_t>(model->dimension()) != z.size())
      throw InputError("z: expected " + std::to_string(model->dimension()) + " numbers, got " +
                       std::to_string(z.size()));
    const auto gradient = [&](const PyTape& of) {
      return values_of(std::make_shared<const Tape>(jacobian_tape(*of.tape)), t, z);
    };
    const Matrix<double> tensor = tensor_of(*system.model, *model, t, z);
    const std::vector<double> df = gradient(f), dg = gradient(g);
    double sum = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      for (std::size_t j = 0; j < z.size(); ++j) sum += df[i] * tensor(i, j) * dg[j];
    return sum;
  });
}

}  // namespace

void bind_evaluation(py::module_& module) {
  module.def("evaluate", &evaluated_at);
  module.def("bracket", &bracket_of);
}

}  // namespace pfaff::python
