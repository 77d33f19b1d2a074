#include <pfaff/bench/experiment/results.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/process/child_program.hpp>

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
// The cells of an invariant or a residual, as many as it has column heads; all of them empty where the
// summary has no entry for it.
std::string drift_cells(const nlohmann::json* found) {
  std::string text;
  for (const char* m : {"max", "rms", "final", "slope"}) text += "," + (found ? cell((*found)[m]) : "");
  for (const std::size_t end : {0U, 1U}) text += "," + (found ? cell((*found)["slope_interval"][end]) : "");
  for (const char* m : {"oscillation", "exponent", "class"}) text += "," + (found ? cell((*found)[m]) : "");
  return text;
}
std::string measured(double number) { return std::isfinite(number) ? formatted("%.17g", number) : ""; }
const nlohmann::json* entry(const nlohmann::json& summary, const char* list, const std::string& name) {
  if (!summary.contains(list)) return nullptr;
  for (const nlohmann::json& e : summary[list])
    if (e["name"] == name && e.contains("max")) return &e;
  return nullptr;
}
}  // namespace

std::vector<nlohmann::json> read_summaries(const fs::path& directory, const std::vector<ExperimentRun>& runs,
                                           const std::string& folder) {
  std::vector<nlohmann::json> summaries;
  for (const ExperimentRun& run : runs)
    summaries.push_back(nlohmann::json::parse(read_file(directory / folder / run.slug / "summary.json")));
  return summaries;
}

std::string results_csv(const std::vector<ExperimentRun>& runs,
                        const std::vector<nlohmann::json>& summaries) {
  std::vector<std::string> invariants;
  for (const nlohmann::json& s : summaries)
    for (const nlohmann::json& i : s["invariants"])
      if (i["expected"] != "free" &&
          std::find(invariants.begin(), invariants.end(), i["name"]) == invariants.end())
        invariants.push_back(i["name"]);
  std::vector<std::string> residuals;
  for (const nlohmann::json& s : summaries)
    if (s.contains("constraints"))
      for (const nlohmann::json& c : s["constraints"])
        if (std::find(residuals.begin(), residuals.end(), c["name"]) == residuals.end())
          residuals.push_back(c["name"]);
  const bool tolerances =
      std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) { return !r.tolerance.empty(); });
  const bool seeds = std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) { return r.seed > 0; });
  const bool by_quantity =
      std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) { return !r.which->error.empty(); });
  const bool formulated = std::any_of(runs.begin(), runs.end(), [](const ExperimentRun& r) {
    return !r.resolved.settings.formulation.empty();
  });

  TextStream text;
  text << "case,system,method,integrator,parameters,step,time,steps,precision,status,message,error_max,error_"
          "final,"
          "structure_residual,rhs_per_step,jacobians_per_step,iterations_per_step,factorisations_per_step";
  for (const auto* names : {&invariants, &residuals})
    for (const std::string& name : *names) {
      for (const char* m :
           {"max", "rms", "final", "slope", "slope_low", "slope_high", "oscillation", "exponent", "class"})
        text << ',' << name << ':' << m;
      if (names == &residuals) text << ',' << name << ":growth," << name << ":growth_rate";
    }
  text << (by_quantity ? ",relative_drift_max" : "") << (tolerances ? ",tolerance" : "")
       << (seeds ? ",seed" : "") << (formulated ? ",formulation" : "") << ",run\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    const nlohmann::json& s = summaries[k];
    const double steps = std::max(1.0, s["counts"]["steps"].get<double>());
    text << csv_quoted(run.which->name) << ',' << csv_quoted(run.which->system) << ','
         << csv_quoted(run.method->label) << ',' << csv_quoted(run.method->integrator) << ','
         << csv_quoted(parameters_of(run)) << ',' << csv_quoted(run.step) << ','
         << to_string(run.resolved.time) << ',' << s["completed"] << ',' << s["precision"].get<std::string>()
         << ',' << s["status"].get<std::string>() << ',' << csv_quoted(s["message"]) << ','
         << cell(s["error_max"]) << ',' << cell(s["error_final"]) << ',' << cell(s["structure_residual"]);
    for (const char* count : {"right_hand_sides", "jacobians", "iterations", "factorisations"})
      text << ',' << formatted("%.6g", s["counts"][count].get<double>() / steps);
    for (const std::string& name : invariants) text << drift_cells(entry(s, "invariants", name));
    for (const std::string& name : residuals) {
      const nlohmann::json* found = entry(s, "constraints", name);
      text << drift_cells(found);
      for (const char* m : {"growth", "growth_rate"}) text << ',' << (found ? cell((*found)[m]) : "");
    }
    if (by_quantity) text << ',' << (run.which->error.empty() ? "" : measured(error_of(*run.which, s)));
    if (tolerances) text << ',' << run.tolerance;
    if (seeds) text << ',' << (run.seed > 0 ? std::to_string(run.seed) : "");
    if (formulated) text << ',' << run.resolved.settings.formulation;
    text << ',' << run.slug << '\n';
  }
  return text.str();
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
