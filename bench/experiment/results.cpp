#include <pfaff/bench/experiment/results.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/process/child_program.hpp>
#include <pfaff/runs/support/counter_fields.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
std::string cell(const nlohmann::json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  return formatted("%.17g", value.get<double>());
}
std::string parameters_of(const ExperimentRun& run) {
  std::string text;
  for (const auto& [key, value] : run.resolved.method->parameters())
    text += (text.empty() ? "" : " ") + key + "=" + value;
  for (const auto& [key, value] : run.resolved.model->source().formulation_parameters)
    text += (text.empty() ? "" : " ") + ("formulation." + key) + "=" + value;
  return text;
}
std::string measured(double number) { return std::isfinite(number) ? formatted("%.17g", number) : ""; }
// A field of a quantity; null where the summary has no such entry.
nlohmann::json field_of(const nlohmann::json& summary, const TableQuantity& quantity,
                        const std::string& field) {
  const char* const list = quantity.residual ? "constraints" : "invariants";
  if (summary.contains(list))
    for (const nlohmann::json& e : summary[list])
      if (e["name"] == quantity.name && e.contains(field)) return e[field];
  return nullptr;
}

// A column of results.csv with its cells.
struct ResultColumn {
  Column column;
  std::function<std::string(const ExperimentRun& run, const nlohmann::json& summary)> cell;
};

std::vector<ResultColumn> columns_of(const std::vector<ExperimentRun>& runs) {
  using Run = ExperimentRun;
  using Json = nlohmann::json;
  std::vector<ResultColumn> columns;
  const auto text = [&](const char* name, auto&& cell) {
    columns.push_back({Column{.name = name, .kind = Column::Kind::text}, cell});
  };
  const auto number = [&](const std::string& name, const std::string& unit, auto&& cell) {
    columns.push_back({Column{name, unit}, cell});
  };
  const auto any = [&](const auto& holds) { return std::any_of(runs.begin(), runs.end(), holds); };
  const std::string time = runs.empty() ? "" : runs.front().resolved.model->time_unit();
  text("case", [](const Run& r, const Json&) { return csv_quoted(r.which->name); });
  text("system", [](const Run& r, const Json&) { return csv_quoted(system_name(r)); });
  text("method", [](const Run& r, const Json&) { return csv_quoted(r.method->label); });
  text("integrator", [](const Run& r, const Json&) { return csv_quoted(r.method->integrator); });
  text("parameters", [](const Run& r, const Json&) { return csv_quoted(parameters_of(r)); });
  number("step", time, [](const Run& r, const Json&) { return csv_quoted(r.step); });
  number("time", time, [](const Run& r, const Json&) { return to_string(r.resolved.time); });
  number("steps", "", [](const Run&, const Json& s) { return s["completed"].dump(); });
  text("precision", [](const Run&, const Json& s) { return s["precision"].get<std::string>(); });
  text("status", [](const Run&, const Json& s) { return s["status"].get<std::string>(); });
  text("message", [](const Run&, const Json& s) { return csv_quoted(s["message"]); });
  for (const char* name : {"error_max", "error_final", "structure_residual"})
    number(name, "", [name](const Run&, const Json& s) { return cell(s[name]); });
  for (const CounterField& field : counter_fields)
    number(std::string(field.per_step), "", [name = field.name](const Run&, const Json& s) {
      const double steps = std::max(1.0, s["counts"]["steps"].get<double>());
      return formatted("%.6g", s["counts"][name].get<double>() / steps);
    });
  for (const TableQuantity& quantity : quantities_of(runs))
    for (const QuantityField& field : quantity_fields())
      if (field.column && field.is_of(quantity.residual))
        number(quantity.name + ":" + field.name, unit_of(field, quantity.unit, quantity.time),
               [quantity, name = field.name](const Run&, const Json& s) {
                 return cell(field_of(s, quantity, name));
               });
  if (any([](const Run& r) { return !r.which->error.empty(); }))
    number("relative_drift_max", "", [](const Run& r, const Json& s) {
      return r.which->error.empty() ? "" : measured(error_of(*r.which, s));
    });
  if (any([](const Run& r) { return !r.tolerance.empty(); }))
    number("tolerance", "", [](const Run& r, const Json&) { return r.tolerance; });
  if (any([](const Run& r) { return r.seed > 0; }))
    number("seed", "", [](const Run& r, const Json&) { return r.seed > 0 ? std::to_string(r.seed) : ""; });
  if (any([](const Run& r) { return !r.resolved.settings.formulation.empty(); }))
    text("formulation", [](const Run& r, const Json&) { return r.resolved.settings.formulation; });
  text("run", [](const Run& r, const Json&) { return r.slug; });
  return columns;
}
}  // namespace

std::vector<nlohmann::json> read_summaries(const fs::path& directory, const std::vector<ExperimentRun>& runs,
                                           const std::string& folder) {
  std::vector<nlohmann::json> summaries;
  for (const ExperimentRun& run : runs)
    summaries.push_back(nlohmann::json::parse(read_file(directory / folder / run.slug / "summary.json")));
  return summaries;
}

Columns results_columns(const std::vector<ExperimentRun>& runs) {
  Columns columns;
  for (const ResultColumn& one : columns_of(runs)) columns.push_back(one.column);
  return columns;
}

std::string results_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                        const std::vector<ExperimentRun>& all) {
  const std::vector<ResultColumn> columns = columns_of(all);
  std::string text = head_of(results_columns(all)) + "\n";
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const ResultColumn& one : columns)
      text += one.cell(runs[k], summaries[k]) + (&one == &columns.back() ? "\n" : ",");
  return text;
}

namespace {
// A report script, run with these arguments; what it says that it made, which is an object in its last line.
// When it fails, RunError begins with `what`; where that is empty the script was given wrong input, and it is
// an InputError.
//
// Python runs apart from what surrounds it: -I leaves out its environment variables, the user's packages and
// the current directory, from which matplotlib would take its settings too. Paths among the arguments are
// absolute.
nlohmann::json run_script(const std::string& name, const std::vector<std::string>& arguments,
                          const std::string& what) {
  const fs::path folder = data_directory() / "report";
  // matplotlib is installed as a package of the operating system and is seen by its own Python only, so that
  // /usr/bin/python3 goes before any other.
  std::error_code error;
  const std::string python = fs::exists("/usr/bin/python3", error) ? "/usr/bin/python3" : "python3";
  ChildProgram program{.words = {python, "-I", (folder / name).string()},
                       .without = {"MPLBACKEND=", "MATPLOTLIBRC="},
                       .directory = folder};
  program.words.insert(program.words.end(), arguments.begin(), arguments.end());
  ChildEnding ending = run_program(program);
  std::string& said = ending.output;
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const std::string last = said.substr(said.rfind('\n') + 1);  // all of it where there is one line
  if (ending.succeeded())
    if (nlohmann::json made = nlohmann::json::parse(last, nullptr, false); made.is_object()) return made;
  if (what.empty() && last.starts_with(name + ": ")) throw InputError(last.substr(name.size() + 2));
  throw RunError((what.empty() ? name : what) + ": " +
                 (last.empty() ? python + " " + ending.in_words() : last));
}

// The options of figures for papers, none where no kind of file is asked for.
std::vector<std::string> options_of(const PaperFigures& wanted) {
  if (wanted.kinds.empty()) return {};
  std::vector<std::string> options{"--figures", wanted.kinds, "--width", wanted.width};
  if (!wanted.style.empty()) {
    (void)read_file(wanted.style);  // which refuses what Python would wait for
    options.insert(options.end(), {"--style", fs::absolute(wanted.style).string()});
  }
  return options;
}
}  // namespace

fs::path make_report(const fs::path& directory) {
  (void)run_script("report.py", {fs::absolute(directory).string()},
                   "the report could not be made (results.csv and cost.csv are complete)");
  return directory / "report.html";
}

nlohmann::json verdicts_of(const fs::path& directory) {
  nlohmann::json cases = nlohmann::json::parse(read_file(directory / "report.json"))["cases"];
  for (nlohmann::json& one : cases) one.erase("assertions");
  return cases;
}

void refuse_what_is_no_index(const fs::path& page) {
  std::error_code error;
  if (fs::exists(page, error) && read_file(page).find("<p class=\"kicker\">Pfaff ") == std::string::npos)
    throw InputError("'" + page.string() +
                     "' is no index of Pfaff's; expected a directory without such a file");
}

void make_index(const fs::path& page, const std::vector<fs::path>& directories) {
  std::vector<std::string> arguments{fs::absolute(page).string()};
  for (const fs::path& directory : directories) arguments.push_back(fs::absolute(directory).string());
  (void)run_script("index.py", arguments, "the index could not be made (reports are complete)");
}

void check(const PaperFigures& wanted) {
  if (const auto options = options_of(wanted); !options.empty()) (void)run_script("wanted.py", options, "");
}

MadeFigures make_paper_figures(const fs::path& directory, const PaperFigures& wanted) {
  std::vector<std::string> arguments = options_of(wanted);
  arguments.insert(arguments.begin(), fs::absolute(directory).string());
  const nlohmann::json made = run_script("report.py", arguments, "the figures for papers could not be made");
  return {directory / "figures" / "paper", "", made.value("left_out", "")};
}

MadeFigures make_run_figures(const fs::path& directory, const PaperFigures& wanted,
                             const std::string& coordinates) {
  std::vector<std::string> arguments = options_of(wanted);
  arguments.insert(arguments.begin(), fs::absolute(directory).string());
  if (!coordinates.empty()) arguments.insert(arguments.end(), {"--coordinates", coordinates});
  const nlohmann::json made = run_script("plot.py", arguments, "");
  return {directory / run_figures_directory / "plot.html", made.value("sentence", ""),
          made.value("left_out", "")};
}

}  // namespace pfaff
