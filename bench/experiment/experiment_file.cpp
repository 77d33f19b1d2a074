// Reading experiments from TOML.
#include <cmath>
#include <deque>

#include <pfaff/bench/experiment/case_frequencies.hpp>
#include <pfaff/bench/experiment/case_steps.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/method_selection.hpp>
#include <pfaff/bench/runner/expressions.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>
#include <pfaff/core/text/vocabulary.hpp>
#include <pfaff/runs/asked_for.hpp>

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

double positive(const std::string& text, const std::string& where, const std::string& key) {
  const auto number = Real::parse(text);
  if (!number || !(number->value() > 0) || !std::isfinite(number->value()))
    throw InputError(where + ": key '" + key + "': expected a number > 0, got '" + text + "'");
  return number->value();
}

// Labels are those of methods and, where a method is a point of a grid, of the grid.
void check_label(const Experiment& experiment, const std::string& label, const std::string& where,
                 bool of_grids = true) {
  std::vector<std::string> labels;
  for (const ExperimentMethod& m : experiment.methods) {
    labels.push_back(m.label);
    if (of_grids && !m.of_grid.empty()) labels.push_back(m.of_grid);
  }
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
  claim.step = as_decimal(without_sign(evaluated(f.text("step", ""), where + ": key 'step'")));
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
  for (const ExperimentCase& c : experiment.cases) {
    cases.push_back(c.name);
    if (c.name == claim.of && c.automatic &&
        (!claim.second.empty() || !claim.step.empty() || claim.at_least > 0))
      throw InputError(
          where + ": case " + c.name +
          " chooses steps for each method by itself; expected a 'bound' for all of them, without "
          "'than', 'step' and 'at_least'");
  }
  if (std::find(cases.begin(), cases.end(), claim.of) == cases.end())
    throw InputError(where + ": " + unknown_name("case", claim.of, cases));
  if (claim.relation != "exceeds" && claim.relation != "stays-below")
    throw InputError(where + ": " + unknown_name("relation", claim.relation, {"exceeds", "stays-below"}));
  if (claim.second.empty() == bound.empty())
    throw InputError(where + ": expected one of the keys 'than' (a method) and 'bound' (a number)");
  check_label(experiment, claim.first, where, false);
  if (!claim.second.empty()) check_label(experiment, claim.second, where, false);
  if (!bound.empty()) claim.bound = positive(bound, where, "bound");
  return claim;
}

// A file of an experiment: the one that is asked for, or one that it includes.
struct Part {
  fs::path path;
  toml::table root;
  [[nodiscard]] std::string name() const { return path.filename().string(); }
};

// The file and what it includes, in the order in which their tables are read: included ones first, each once.
// `open` are the files that are being read, of which none may include itself.
void read_parts(const fs::path& path, std::deque<Part>& parts, std::vector<fs::path>& open) {
  const fs::path whole = fs::weakly_canonical(path);
  const auto same = [&](const Part& part) { return fs::weakly_canonical(part.path) == whole; };
  if (std::any_of(parts.begin(), parts.end(), same)) return;
  open.push_back(whole);
  Part part{path, parse_toml(path)};
  Keys keys(part.root, part.name());
  for (const std::string& file : keys.one_or_more("include")) {
    const fs::path included = path.parent_path() / file;
    std::error_code error;
    if (included.extension() != ".toml" || !fs::is_regular_file(included, error))
      keys.refuse("include",
                  "expected a TOML file, from the folder of " + part.name() + ", got '" + file + "'");
    if (std::find(open.begin(), open.end(), fs::weakly_canonical(included)) != open.end())
      keys.refuse("include", "'" + file + "' includes itself");
    read_parts(included, parts, open);
  }
  open.pop_back();
  parts.push_back(std::move(part));
}

// What the report of a case is asked, which a case takes from the head where it says nothing.
void read_question(Keys& keys, const std::string& where, Asked& asked) {
  // As ANSWERS of bench/report/first_screen.py.
  const std::vector<std::string> answers{"cost",        "energy",    "structure",  "growth",
                                         "constraints", "agreement", "frequencies"};
  asked.equation = keys.text("equation", asked.equation);
  asked.question = keys.text("question", asked.question);
  asked.answer = keys.text("answer", asked.answer);
  if (!asked.answer.empty() && std::find(answers.begin(), answers.end(), asked.answer) == answers.end())
    throw InputError(where + ": " + unknown_name("answer", asked.answer, answers));
}

// Adds the methods of a table [[method]]: one for each point of the grid of its parameters.
void read_method(const toml::table& table, const Part& part, Experiment& experiment) {
  Keys m(table, part.name() + " [[method]]");
  ExperimentMethod method;
  method.label = m.required("label");
  method.integrator = m.required("integrator");
  if (text::is_text_file(method.integrator))
    method.integrator = text::beside(method.integrator, part.path.string());
  method.formulation = m.text("formulation", "");
  method.tolerances = m.one_or_more("tolerance");
  for (std::string& tolerance : method.tolerances) tolerance = as_decimal(tolerance);
  method.absolute = m.one_or_more("absolute");
  const std::vector<GridPoint> points = points_of(m.assignment_lists("set"));
  m.finish();
  for (const GridPoint& point : points) {
    ExperimentMethod& one = experiment.methods.emplace_back(method);
    one.set = point.values;
    if (point.varying.empty()) continue;
    one.of_grid = method.label;
    one.label += ", " + point.varying;
  }
}

// Adds the cases of a table [[case]] likewise.
void read_case(const toml::table& table, const Part& part, Experiment& experiment) {
  Keys c(table, part.name() + " [[case]]");
  ExperimentCase one;
  one.name = c.required("name");
  const std::string where = part.name() + " [[case]] " + one.name;
  one.title = c.text("title", one.name);
  one.system = c.required("system");
  if (text::is_text_file(one.system)) one.system = text::beside(one.system, part.path.string());
  one.time = c.required("time");
  const std::vector<GridPoint> points = points_of(c.assignment_lists("set"));
  one.initial = c.list_of_some("initial");
  one.initial_velocities = c.list_of_some("initial_velocities");
  read_steps(c, one);
  one.conserved = c.text("conserved", "");
  one.asked = experiment.asked;
  read_question(c, where, one.asked);
  const std::string error = c.text("error", "");
  one.motion = c.list("motion");
  if (!one.motion.empty() && one.motion.size() != 2)
    throw InputError(where + ": key 'motion': expected two coordinates, got " +
                     std::to_string(one.motion.size()));
  one.frequencies = read_vectors(c, part.name());
  one.precision = c.read("precision", "double", parse_precision);
  one.methods = c.list("methods");
  one.seeds = static_cast<int>(whole(c.text("seeds", "0"), 0, 10000, where, "seeds"));
  const AskedReference reference =
      parse_reference(c.text("reference", "solution"), where + ": key 'reference'",
                      {ErrorsAgainst::solution, ErrorsAgainst::none});
  one.reference = reference.against == ErrorsAgainst::solution;
  one.errors_at_every_row = reference.every_row;
  one.structure = c.read("structure", "residual", [](const std::string& text) {
    if (text != "residual" && text != "none")
      throw InputError(unknown_name("structure", text, {"residual", "none"}));
    return text == "residual";
  });
  if (error == "solution" && !one.reference)
    throw InputError(
        where +
        ": key 'error': expected the name of a conserved quantity beside reference = \"none\", got '" +
        error + "'");
  if (error != "solution") one.error = error;
  if (const toml::table* less = c.table("quick")) {
    Keys q(*less, part.name() + " [case.quick]");
    ExperimentCase quick = one;
    quick.title = q.text("title", one.title);
    quick.time = q.text("time", one.time);
    read_steps(q, quick);
    quick.seeds = static_cast<int>(whole(q.text("seeds", std::to_string(one.seeds)), one.seeds > 0 ? 1 : 0,
                                         std::max(one.seeds, 0), part.name() + " [case.quick]", "seeds"));
    q.finish();
    if (experiment.quick) one = quick;
  }
  c.finish();
  for (const std::string& label : one.methods) check_label(experiment, label, where);
  const bool fixed =
      experiment.methods.empty() ||
      std::any_of(experiment.methods.begin(), experiment.methods.end(),
                  [&](const ExperimentMethod& m) { return m.tolerances.empty() && takes(one, m); });
  if (fixed) check_steps(one, where);
  for (const GridPoint& point : points) {
    ExperimentCase& next = experiment.cases.emplace_back(one);
    next.set = point.values;
    evaluate_numbers(next, where);
    if (point.varying.empty()) continue;
    next.name += ", " + point.varying;
    next.title += ", " + point.varying;
  }
}

// What a file says of itself and of the experiment; what an included one says of itself is read and left.
void read_head(Keys& keys, const Part& part, bool included, Experiment& experiment) {
  if (const std::string schema = keys.required("schema"); schema != "1")
    throw InputError(part.name() + ": key 'schema': expected 1, got " + schema);
  (void)keys.one_or_more("include");
  const auto add = [](std::vector<std::string>& list, const std::vector<std::string>& more) {
    for (const std::string& text : more)
      if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  };
  add(experiment.reference, keys.list("reference"));
  add(experiment.notes, keys.list("notes"));
  std::string title = included ? keys.text("title", "") : keys.required("title");
  std::string description = keys.text("description", "");
  const bool compile = keys.read("compile", "no", [](const std::string& text) {
    if (text != "yes" && text != "no") throw InputError(unknown_name("answer", text, {"no", "yes"}));
    return text == "yes";
  });
  if (const toml::table* less = keys.table("quick")) {
    Keys q(*less, part.name() + " [quick]");
    const std::string quick_title = q.text("title", title),
                      quick_description = q.text("description", description);
    q.finish();
    if (experiment.quick) title = quick_title, description = quick_description;
  }
  Asked asked;
  read_question(keys, part.name(), asked);
  const bool measures_named = part.root.get("measures") != nullptr;
  const std::vector<std::string> measures = keys.list("measures");
  if (included) return;
  if (measures_named) {
    try {
      experiment.measures = measures_asked_for(measures);
    } catch (const InputError& error) {
      keys.refuse("measures", error.what());
    }
  }
  experiment.asked = asked;
  experiment.title = title;
  experiment.description = description;
  experiment.compile = compile;
}

// The selection of methods, which one file at most may have, and the methods that it may take.
void read_methods_by_selection(const std::deque<Part>& parts, std::deque<Keys>& keys,
                               Experiment& experiment) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].root.get("methods") == nullptr) continue;
    if (experiment.selection)
      keys[k].refuse("methods", "expected one selection, and an included file has another");
    experiment.selection = read_selection(keys[k], parts[k].name());
    for (ExperimentMethod& method : selected_methods(*experiment.selection))
      experiment.methods.push_back(std::move(method));
  }
}
}  // namespace

bool takes(const ExperimentCase& one, const ExperimentMethod& method) {
  return one.methods.empty() ||
         std::any_of(one.methods.begin(), one.methods.end(), [&](const std::string& label) {
           return label == method.label || (label == method.of_grid && !label.empty());
         });
}

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  const auto data = find_data_directory();
  if (!data) return names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(*data / "experiments", error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Experiment read_experiment(const std::string& name_or_path, bool quick, bool others) {
  fs::path path = name_or_path;
  if (path.extension() != ".toml") {
    const fs::path directory = data_directory() / "experiments";
    std::error_code error;
    path = directory / (name_or_path + ".toml");
    if (!fs::exists(path, error)) path = directory / (in_small_letters(name_or_path) + ".toml");
    if (!fs::exists(path, error))
      throw InputError(unknown_name("experiment", name_or_path, experiment_names()));
  }
  std::deque<Part> parts;
  std::vector<fs::path> open;
  read_parts(path, parts, open);
  const std::string where = path.filename().string();
  Experiment experiment;
  experiment.name = path.stem().string();
  experiment.quick = quick;
  experiment.asked_for = name_or_path;
  std::deque<Keys> keys;
  for (const Part& part : parts) {
    keys.emplace_back(part.root, part.name());
    read_head(keys.back(), part, &part != &parts.back(), experiment);
  }
  const std::vector<std::string> kinds{"runs", "derivation"};
  const std::string kind = keys.back().text("kind", kinds.front());
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError(where + ": " + unknown_name("kind", kind, kinds));
  if (kind == "derivation") {
    experiment.derivation = read_derivation_study(keys.back(), where, quick);
    for (const Keys& of_part : keys) of_part.finish();
    return experiment;
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const toml::table* table : keys[k].tables("method", false))
      read_method(*table, parts[k], experiment);
  read_methods_by_selection(parts, keys, experiment);
  if (experiment.methods.empty() && !others)
    throw InputError(where + ": expected at least one [[method]], or the key 'methods'");
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const toml::table* table : keys[k].tables("case", false)) read_case(*table, parts[k], experiment);
  if (experiment.cases.empty()) throw InputError(where + ": expected at least one [[case]]");
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const toml::table* table : keys[k].tables("finding", false))
      experiment.claims.push_back(read_claim(*table, experiment, parts[k].name()));
  for (const Keys& of_part : keys) of_part.finish();
  return experiment;
}

}  // namespace pfaff
