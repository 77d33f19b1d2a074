// Reading experiments from TOML.
#include <cmath>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>
#include <pfaff/core/text/vocabulary.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
std::int64_t whole(const std::string& text, std::int64_t low, std::int64_t high, const std::string& where,
                   const std::string& key) {
  const auto number = Real::parse(text);
  if (!number || !number->is_fraction() || number->denominator() != 1 || number->numerator() < low ||
      number->numerator() > high)
    throw InputError(where + ": key '" + key + "': expected a whole number in " + std::to_string(low) +
                     " .. " + std::to_string(high) + ", got '" + text + "'");
  return number->numerator();
}

// Reads a key whose value is either `what`, which is also its default, or "none"; true for `what`.
bool wanted(Keys& keys, const std::string& key, const std::string& what, const std::string& where) {
  const std::string text = keys.text(key, what);
  if (text != what && text != "none")
    throw InputError(where + ": " + unknown_name(key, text, {what, "none"}));
  return text == what;
}

double positive(const std::string& text, const std::string& where, const std::string& key) {
  const auto number = Real::parse(text);
  if (!number || !(number->value() > 0) || !std::isfinite(number->value()))
    throw InputError(where + ": key '" + key + "': expected a number > 0, got '" + text + "'");
  return number->value();
}

void check_label(const Experiment& experiment, const std::string& label, const std::string& where) {
  std::vector<std::string> labels;
  for (const ExperimentMethod& m : experiment.methods) labels.push_back(m.label);
  if (std::find(labels.begin(), labels.end(), label) == labels.end())
    throw InputError(where + ": " + unknown_name("method", label, labels));
}

ExperimentClaim read_claim(const toml::table& table, const Experiment& experiment, const std::string& file) {
  const std::string where = file + " [[finding]]";
  Keys f(table, where);
  ExperimentClaim claim;
  claim.of = f.required("case");
  claim.measure = f.required("measure");
  claim.first = f.required("method");
  claim.relation = f.required("relation");
  claim.second = f.text("than", "");
  const std::string bound = f.text("bound", "");
  claim.factor = positive(f.text("factor", "1"), where, "factor");
  claim.step = f.text("step", "");
  std::string at_least = f.text("at_least", "0");
  if (const toml::table* less = f.table("quick")) {
    Keys q(*less, file + " [finding.quick]");
    const std::string fewer = q.text("at_least", at_least);
    q.finish();
    if (experiment.quick) at_least = fewer;
  }
  f.finish();
  claim.at_least = static_cast<std::size_t>(whole(at_least, 0, 1000000, where, "at_least"));
  std::vector<std::string> cases;
  for (const ExperimentCase& c : experiment.cases) cases.push_back(c.name);
  if (std::find(cases.begin(), cases.end(), claim.of) == cases.end())
    throw InputError(where + ": " + unknown_name("case", claim.of, cases));
  if (claim.relation != "exceeds" && claim.relation != "stays-below")
    throw InputError(where + ": " + unknown_name("relation", claim.relation, {"exceeds", "stays-below"}));
  if (claim.second.empty() == bound.empty())
    throw InputError(where + ": expected one of the keys 'than' (a method) and 'bound' (a number)");
  check_label(experiment, claim.first, where);
  if (!claim.second.empty()) check_label(experiment, claim.second, where);
  if (!bound.empty()) claim.bound = positive(bound, where, "bound");
  return claim;
}
}  // namespace

bool takes(const ExperimentCase& one, const ExperimentMethod& method) {
  return one.methods.empty() ||
         std::find(one.methods.begin(), one.methods.end(), method.label) != one.methods.end();
}

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
  const std::vector<std::string> kinds{"runs", "derivation"};
  const std::string kind = keys.text("kind", kinds.front());
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError(where + ": " + unknown_name("kind", kind, kinds));
  if (kind == "derivation") {
    experiment.derivation = read_derivation_study(keys, where, quick);
    keys.finish();
    return experiment;
  }
  experiment.compile = keys.read("compile", "no", [](const std::string& text) {
    if (text != "yes" && text != "no") throw InputError(unknown_name("answer", text, {"no", "yes"}));
    return text == "yes";
  });
  for (const toml::table* table : keys.tables("method")) {
    Keys m(*table, where + " [[method]]");
    ExperimentMethod method;
    method.label = m.required("label");
    method.integrator = m.required("integrator");
    if (text::is_text_file(method.integrator))
      method.integrator = text::beside(method.integrator, path.string());
    method.formulation = m.text("formulation", "");
    method.set = m.assignments("set");
    method.tolerances = m.one_or_more("tolerance");
    m.finish();
    experiment.methods.push_back(std::move(method));
  }
  for (const toml::table* table : keys.tables("case")) {
    Keys c(*table, where + " [[case]]");
    ExperimentCase one;
    one.name = c.required("name");
    one.title = c.text("title", one.name);
    one.system = c.required("system");
    if (text::is_text_file(one.system)) one.system = text::beside(one.system, path.string());
    one.time = c.required("time");
    one.set = c.assignments("set");
    one.initial = c.list_of_some("initial");
    one.steps = c.list("steps");
    one.conserved = c.text("conserved", "");
    one.motion = c.list("motion");
    if (!one.motion.empty() && one.motion.size() != 2)
      throw InputError(where + " [[case]] " + one.name + ": key 'motion': expected two coordinates, got " +
                       std::to_string(one.motion.size()));
    one.precision = c.read("precision", "double", parse_precision);
    one.methods = c.list("methods");
    one.seeds =
        static_cast<int>(whole(c.text("seeds", "0"), 0, 10000, where + " [[case]] " + one.name, "seeds"));
    one.reference = wanted(c, "reference", "solution", where + " [[case]] " + one.name);
    one.structure = wanted(c, "structure", "residual", where + " [[case]] " + one.name);
    if (const toml::table* less = c.table("quick")) {
      Keys q(*less, where + " [case.quick]");
      const std::string time = q.text("time", one.time);
      const auto steps = q.list("steps", one.steps);
      const auto seeds =
          static_cast<int>(whole(q.text("seeds", std::to_string(one.seeds)), one.seeds > 0 ? 1 : 0,
                                 std::max(one.seeds, 0), where + " [case.quick]", "seeds"));
      q.finish();
      if (quick) {
        one.time = time;
        one.steps = steps;
        one.seeds = seeds;
      }
    }
    c.finish();
    for (const std::string& label : one.methods)
      check_label(experiment, label, where + " [[case]] " + one.name);
    const bool fixed =
        std::any_of(experiment.methods.begin(), experiment.methods.end(),
                    [&](const ExperimentMethod& m) { return m.tolerances.empty() && takes(one, m); });
    if (fixed && one.steps.empty())
      throw InputError(where + " [[case]] " + one.name + ": key 'steps' is missing");
    experiment.cases.push_back(std::move(one));
  }
  for (const toml::table* table : keys.tables("finding", false))
    experiment.claims.push_back(read_claim(*table, experiment, where));
  keys.finish();
  return experiment;
}

}  // namespace pfaff
