// Experiments: what `pfaff compare` runs, with methods that are objects beside those of the file.
#include <pybind11/stl.h>

#include <filesystem>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/json_value.hpp>
#include <pfaff/python/src/objects.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {

using NamedMethods = std::vector<std::pair<std::string, PyMethod>>;

// Adds methods to every case that they fit.
void add_methods(Experiment& experiment, const NamedMethods& methods) {
  for (const auto& [label, method] : methods) {
    if (experiment.derivation)
      throw InputError(experiment.name + ": an experiment of derivations has no integrators; expected none");
    ExperimentMethod& added = experiment.methods.emplace_back();
    added.label = label;
    added.integrator = method.method->descriptor().name;
    added.object = method.method;
    added.selected = true;
    for (ExperimentCase& one : experiment.cases)
      if (!one.methods.empty()) one.methods.push_back(label);
    if (!experiment.selection) experiment.selection.emplace();  // asks nothing more than that they fit
  }
}

// `asked_for`, where it is not empty, is what the report calls the experiment.
py::dict compared(const std::string& name, const std::string& asked_for, const NamedMethods& methods,
                  const std::string& directory, bool quick, bool force, bool compile, bool report,
                  std::optional<double> timing) {
  Experiment experiment = read_experiment(name, quick, !methods.empty());
  if (!asked_for.empty()) experiment.asked_for = asked_for;
  experiment.compile = experiment.compile || compile;
  add_methods(experiment, methods);
  ExperimentOutcome outcome;
  nlohmann::json verdicts = nlohmann::json::array();
  without_lock(
      [&] {
        const std::atomic<bool>* const stop = Budget::current()->stop();
        outcome = run_experiment(
            experiment, directory, [](const ExperimentStage&) {},
            {.force = force, .stop = stop, .team = nullptr, .report = report, .timing = timing});
        if (outcome.interrupted)
          throw RunError(std::to_string(outcome.resumed) + " of " + std::to_string(outcome.runs) +
                         " runs are in " + directory + "; the same call resumes");
        if (!outcome.report.empty()) verdicts = verdicts_of(directory);
      },
      true);  // runs are made on several threads
  py::dict result;
  result["name"] = experiment.name;
  result["title"] = experiment.title;
  result["directory"] = directory;
  result["runs"] = outcome.runs;
  result["resumed"] = outcome.resumed;
  result["failed"] = outcome.failed;
  result["report"] = outcome.report.empty() ? py::object(py::none()) : py::str(outcome.report.string());
  result["table"] = outcome.table;
  result["findings"] = python_value(outcome.findings);
  result["failed_claims"] = outcome.failed_claims;
  result["verdicts"] = python_value(verdicts);
  py::list left_out;
  for (const LeftOut& one : outcome.left_out)
    left_out.append(py::make_tuple(one.of_case, one.method, one.reason));
  result["left_out"] = left_out;
  return result;
}

}  // namespace

void bind_experiments(py::module_& module) {
  module.def("experiment_names", &experiment_names);
  // Where what ships stands, under its name in the source tree, such as examples/models.
  module.def("shipped_path", [](const std::string& name) { return shipped_path(name).string(); });
  module.def("compare", &compared);
}

}  // namespace pfaff::python
