// Reading experiments from TOML.
#include <pfaff/bench/runner/experiment.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

namespace fs = std::filesystem;

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_directory() / "experiments", error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Experiment read_experiment(const std::string& name_or_path, bool quick) {
  fs::path path = name_or_path;
  if (path.extension() != ".toml") {
    path = data_directory() / "experiments" / (name_or_path + ".toml");
    std::error_code error;
    if (!fs::exists(path, error))
      throw InputError(unknown_name("experiment", name_or_path, experiment_names()));
  }
  const toml::table root = parse_toml(path);
  const std::string where = path.filename().string();
  Experiment experiment;
  experiment.name = path.stem().string();
  experiment.quick = quick;
  Keys keys(root, where);
  if (const std::string schema = keys.required("schema"); schema != "1")
    throw InputError(where + ": key 'schema': expected 1, got " + schema);
  experiment.title = keys.required("title");
  experiment.description = keys.text("description", "");
  experiment.reference = keys.list("reference");
  experiment.notes = keys.list("notes");
  for (const toml::table* table : keys.tables("method")) {
    Keys m(*table, where + " [[method]]");
    ExperimentMethod method;
    method.label = m.required("label");
    method.integrator = m.required("integrator");
    method.formulation = m.text("formulation", "");
    method.set = m.assignments("set");
    m.finish();
    experiment.methods.push_back(std::move(method));
  }
  for (const toml::table* table : keys.tables("case")) {
    Keys c(*table, where + " [[case]]");
    ExperimentCase one;
    one.name = c.required("name");
    one.title = c.text("title", one.name);
    one.system = c.required("system");
    one.time = c.required("time");
    one.set = c.assignments("set");
    one.initial = c.list("initial");
    one.steps = c.list("steps");
    one.conserved = c.text("conserved", "");
    one.precision = parse_precision(c.text("precision", "double"));
    one.methods = c.list("methods");
    if (const toml::table* less = c.table("quick")) {
      Keys q(*less, where + " [case.quick]");
      const std::string time = q.text("time", one.time);
      const auto steps = q.list("steps", one.steps);
      q.finish();
      if (quick) {
        one.time = time;
        one.steps = steps;
      }
    }
    c.finish();
    if (one.steps.empty()) throw InputError(where + " [[case]] " + one.name + ": key 'steps' is missing");
    for (const std::string& label : one.methods)
      if (std::none_of(experiment.methods.begin(), experiment.methods.end(),
                       [&](const ExperimentMethod& m) { return m.label == label; })) {
        std::vector<std::string> labels;
        for (const ExperimentMethod& m : experiment.methods) labels.push_back(m.label);
        throw InputError(where + " [[case]] " + one.name + ": " + unknown_name("method", label, labels));
      }
    experiment.cases.push_back(std::move(one));
  }
  keys.finish();
  return experiment;
}

}  // namespace pfaff
