#include <pfaff/bench/runner/config_file.hpp>

#include <sstream>

#include <pfaff/bench/runner/toml_keys.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

namespace {
// The text as a TOML string on one line, with quotation marks, backslashes and control characters escaped.
std::string quoted(const std::string& text) {
  TextStream stream;
  const toml::value<std::string> value(text);
  stream << toml::toml_formatter(value, toml::format_flags::allow_unicode_strings);
  return stream.str();
}

void write_table(std::ostream& text, const std::string& name, const Assignments& entries) {
  if (entries.empty()) return;
  text << "\n[" << name << "]\n";
  for (const auto& [key, value] : entries) text << quoted(key) << " = " << quoted(value) << '\n';
}
}  // namespace

std::string settings_text(const ResolvedRun& run) {
  const RunSettings& s = run.settings;
  TextStream text;
  text << "schema = 1\n";
  const auto line = [&](const char* key, std::string_view value) {
    text << key << " = " << quoted(std::string(value)) << '\n';
  };
  const auto list = [&](const char* key, const std::vector<Real>& numbers) {
    text << key << " = [";
    for (std::size_t k = 0; k < numbers.size(); ++k)
      text << (k == 0 ? "" : ", ") << quoted(to_string(numbers[k]));
    text << "]\n";
  };
  if (!s.of_case.empty()) line("case", s.of_case);
  if (!s.of_method.empty()) line("method", s.of_method);
  line("system", s.system);  // of a text model the path, which is absolute
  line("integrator", s.integrator);
  if (!s.formulation.empty()) line("formulation", s.formulation);
  line("precision", to_string(s.precision));
  line("t0", to_string(run.t0));
  line("time", to_string(run.time));
  if (run.adaptive()) {
    line("tolerance", to_string(run.tolerance));
    if (!run.absolute.empty()) list("absolute", run.absolute);
  } else {
    line("step", to_string(run.step));
    text << "every = " << run.every << '\n';
  }
  if (s.step_budget != default_step_budget) text << "max_steps = " << s.step_budget << '\n';
  line("reference", to_string(AskedReference{s.reference, s.errors_at_every_row}));
  line("structure", s.structure_residuals ? "residual" : "none");
  if (s.compile) line("compile", "yes");
  if (s.project_initial) line("project_initial", "yes");
  if (s.allow_inconsistent) line("allow_inconsistent", "yes");
  list("initial", s.project_initial ? run.given_initial : run.initial);
  Assignments set;
  for (const auto& [key, value] : run.model->parameters()) set.emplace_back("system." + key, value);
  for (const auto& [key, value] : run.model->source().formulation_parameters)
    set.emplace_back("formulation." + key, value);
  for (const auto& [key, value] : run.method->parameters()) set.emplace_back("integrator." + key, value);
  write_table(text, "set", set);
  return text.str();
}

std::string config_text(const ResolvedRun& run) {
  TextStream text;
  text << settings_text(run);
  write_table(text, "files", run.origins.files);
  write_table(text, "plugins", run.origins.plugins);
  write_table(text, "libraries", run.origins.libraries);
  return text.str();
}

RunConfig read_config(const std::string& path) {
  const toml::table root = parse_toml(path);
  Keys keys(root, path);
  if (const std::string schema = keys.required("schema"); schema != "1")
    throw InputError(path + ": key 'schema': expected 1, got " + schema);
  const auto choice = [&](const char* key, const std::string& fallback, const std::string& other) {
    return keys.read(key, fallback, [&](const std::string& text) {
      if (text != fallback && text != other)
        throw InputError(unknown_name("answer", text, {fallback, other}));
      return text == other;
    });
  };
  RunConfig config;
  RunSettings& settings = config.settings;
  settings.of_case = keys.text("case", "");
  settings.of_method = keys.text("method", "");
  settings.system = keys.required("system");
  settings.integrator = keys.required("integrator");
  settings.formulation = keys.text("formulation", "");
  settings.precision = keys.read("precision", "double", parse_precision);
  settings.t0 = keys.text("t0", "0");
  settings.time = keys.required("time");
  settings.step = keys.text("step", "");
  settings.tolerance = keys.text("tolerance", "");
  settings.absolute = keys.one_or_more("absolute");
  if (const std::string every = keys.text("every", ""); !every.empty())
    settings.every = parse_every(every, path + ": key 'every'");
  if (const std::string most = keys.text("max_steps", ""); !most.empty())
    settings.step_budget = parse_every(most, path + ": key 'max_steps'");
  const AskedReference reference =
      parse_reference(keys.text("reference", "exact"), path + ": key 'reference'", references_of_runs);
  settings.reference = reference.against;
  settings.errors_at_every_row = reference.every_row;
  settings.structure_residuals = !choice("structure", "residual", "none");
  settings.compile = choice("compile", "no", "yes");
  settings.project_initial = choice("project_initial", "no", "yes");
  settings.allow_inconsistent = choice("allow_inconsistent", "no", "yes");
  settings.initial = keys.list_of_some("initial");
  settings.set = keys.assignments("set");
  config.origins.files = keys.assignments("files");
  config.origins.plugins = keys.assignments("plugins");
  config.origins.libraries = keys.assignments("libraries");
  keys.finish();
  return config;
}

}  // namespace pfaff
