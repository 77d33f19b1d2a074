// What the extension module consists of: a function for each subject, which adds its classes and functions.
#pragma once

#include <pybind11/pybind11.h>

namespace pfaff::python {

void bind_derivation(pybind11::module_& module);
void bind_ensembles(pybind11::module_& module);
void bind_errors(pybind11::module_& module);
void bind_evaluation(pybind11::module_& module);
void bind_experiments(pybind11::module_& module);
void bind_integrations(pybind11::module_& module);
void bind_interruption(pybind11::module_& module);
void bind_methods(pybind11::module_& module);
void bind_model_source(pybind11::module_& module);
void bind_papers(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_scalars(pybind11::module_& module);
void bind_systems(pybind11::module_& module);
void bind_text_formulas(pybind11::module_& module);
void bind_verification(pybind11::module_& module);

}  // namespace pfaff::python
