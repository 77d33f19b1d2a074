// The extension module pfaff._pfaff: what the package pfaff calls of the C++ libraries. It is no interface of
// its own; users import the package.
#include <pfaff/core/registry/version.hpp>
#include <pfaff/python/src/bindings.hpp>

PYBIND11_MODULE(_pfaff, module) {
  module.doc() = "What the package pfaff calls of the C++ libraries; import pfaff instead.";
  module.attr("__version__") = PFAFF_VERSION_TEXT;
  if (const std::string& left_out = pfaff::plugins_left_out(); !left_out.empty())
    throw pybind11::import_error(left_out);
  // Classes come before the functions that take them: signatures, of which stubs are made, name them.
  pfaff::python::bind_errors(module);
  pfaff::python::bind_recording(module);
  pfaff::python::bind_systems(module);
  pfaff::python::bind_model_source(module);
  pfaff::python::bind_scalars(module);
  pfaff::python::bind_methods(module);
  pfaff::python::bind_integrations(module);
  pfaff::python::bind_interruption(module);
  pfaff::python::bind_runs(module);
  pfaff::python::bind_ensembles(module);
  pfaff::python::bind_derivation(module);
  pfaff::python::bind_evaluation(module);
  pfaff::python::bind_experiments(module);
  pfaff::python::bind_papers(module);
  pfaff::python::bind_text_formulas(module);
  pfaff::python::bind_verification(module);
}
