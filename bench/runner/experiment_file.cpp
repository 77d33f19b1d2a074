// Reading experiments from TOML.
#include <algorithm>
#include <array>
#include <charconv>
#include <toml++/toml.h>

#include <pfaff/bench/runner/experiment.hpp>
#include <pfaff/bench/runner/files.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

// A table whose keys are checked: what is not asked for by the end is an error that names the nearest key.
class Keys {
 public:
  Keys(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

  std::string text(std::string_view key, const std::string& fallback) {
    const toml::node* node = find(key);
    return node == nullptr ? fallback : scalar(*node, key);
  }
  std::string required(std::string_view key) {
    if (table_.get(key) == nullptr) throw InputError(where_ + ": key '" + std::string(key) + "' is missing");
    return text(key, {});
  }
  std::vector<std::string> list(std::string_view key, std::vector<std::string> fallback = {}) {
    const toml::node* node = find(key);
    if (node == nullptr) return fallback;
    if (!node->is_array()) throw InputError(where_ + ": key '" + std::string(key) + "': expected a list");
    std::vector<std::string> items;
    for (const toml::node& item : *node->as_array()) items.push_back(scalar(item, key));
    return items;
  }
  Assignments assignments(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    if (!node->is_table()) throw InputError(where_ + ": key '" + std::string(key) + "': expected a table");
    Assignments result;
    for (const auto& [name, value] : *node->as_table()) result.emplace_back(name.str(), scalar(value, name.str()));
    return result;
  }
  const toml::table* table(std::string_view key) {
    const toml::node* node = find(key);
    return node == nullptr ? nullptr : node->as_table();
  }
  std::vector<const toml::table*> tables(std::string_view key) {
    const toml::node* node = find(key);
    std::vector<const toml::table*> result;
    if (node == nullptr || !node->is_array_of_tables())
      throw InputError(where_ + ": expected at least one [[" + std::string(key) + "]]");
    for (const toml::node& item : *node->as_array()) result.push_back(item.as_table());
    return result;
  }
  void finish() const {
    for (const auto& [key, value] : table_) {
      const std::string name(key.str());
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end())
        throw InputError(where_ + ": " + unknown_name("key", name, asked_));
    }
  }

 private:
  const toml::node* find(std::string_view key) {
    asked_.emplace_back(key);
    return table_.get(key);
  }
  std::string scalar(const toml::node& node, std::string_view key) const {
    if (const auto* s = node.as_string()) return s->get();
    if (const auto* i = node.as_integer()) return std::to_string(i->get());
    if (const auto* x = node.as_floating_point()) {  // the shortest decimal, which is the one that was written
      std::array<char, 40> digits{};
      return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x->get()).ptr};
    }
    if (const auto* b = node.as_boolean()) return b->get() ? "yes" : "no";
    throw InputError(where_ + ": key '" + std::string(key) + "': expected a number or a string");
  }

  const toml::table& table_;
  std::string where_;
  std::vector<std::string> asked_;
};

}  // namespace

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
    if (!fs::exists(path, error)) throw InputError(unknown_name("experiment", name_or_path, experiment_names()));
  }
  toml::table root;
  try {
    root = toml::parse(read_file(path), path.string());
  } catch (const toml::parse_error& e) {
    throw InputError(path.string() + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
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
