// pfaff run: makes one run and writes it to a directory or to standard output.
#include <unistd.h>

#include <iostream>
#include <sstream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/run_measures.hpp>
#include <pfaff/app/run_summary.hpp>
#include <pfaff/app/state_file.hpp>
#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/measure_tables.hpp>
#include <pfaff/bench/runner/row_file.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/runs/motion.hpp>

namespace pfaff::app {

namespace {

struct RunOptions {
  RunSettings settings;
  std::vector<std::string> set, measures;
  std::string every, absolute, precision, out, state, config, reference, max_steps;
  bool force = false;
};

// Names all options that are missing at once.
void require_options(const RunOptions& options) {
  const RunSettings& s = options.settings;
  const bool here = options.config.empty();  // the settings, which a config.toml has otherwise
  std::string missing;
  for (const auto& [absent, what] :
       {std::pair(here && s.system.empty(), "--system (see pfaff list systems)"),
        {here && s.integrator.empty(), "--integrator (see pfaff list integrators)"},
        {here && s.step.empty() && s.tolerance.empty(), "--step, or --tolerance"},
        {here && s.time.empty(), "--time, the duration of the run"},
        {options.out.empty(),
         "--out, a new directory for the run, or - for its series on standard output"}}) {
    if (absent) missing += (missing.empty() ? "" : "; ") + std::string(what);
  }
  if (!missing.empty()) throw InputError("missing: " + missing);
}

// What the options ask for, read from a config.toml or from the options themselves, not yet resolved.
RunConfig config_of(const RunOptions& options) {
  require_options(options);
  RunConfig config{options.settings, {}};
  RunSettings& settings = config.settings;
  if (!options.config.empty()) {
    for (const std::string& other :
         {settings.system, settings.formulation, settings.integrator, settings.time, settings.step,
          settings.tolerance, options.absolute, options.every, options.precision, options.state,
          options.reference, options.max_steps})
      if (!other.empty() || !options.set.empty() || settings.compile || settings.project_initial ||
          settings.allow_inconsistent)
        throw InputError("--config holds the whole run; expected no other settings beside it");
    return read_config(options.config);
  }
  if (settings.project_initial && settings.allow_inconsistent)
    throw InputError("--project-initial and --allow-inconsistent exclude each other");
  settings.set = parse_settings(options.set);
  if (!options.precision.empty()) settings.precision = parse_precision(options.precision);
  if (!options.absolute.empty()) settings.absolute = split_commas(options.absolute);
  if (!options.every.empty()) settings.every = parse_every(options.every, "--every");
  if (!options.reference.empty()) {
    const AskedReference reference = parse_reference(options.reference, "--reference", references_of_runs);
    settings.reference = reference.against;
    settings.errors_at_every_row = reference.every_row;
  }
  if (!options.max_steps.empty()) settings.step_budget = parse_every(options.max_steps, "--max-steps");
  if (!options.state.empty()) {
    for (const auto& [key, value] : settings.set)
      if (key == "initial" || key == "initial_velocities")
        throw InputError("--state and --set " + key + " exclude each other");
    read_state(options.state, settings);
  }
  return config;
}

// The run that the options ask for. One that was made before is not repeated from other files and builds
// than then, unless that is forced.
ResolvedRun resolved_run(const RunOptions& options) {
  const RunConfig config = config_of(options);
  require_plugins(config.origins, options.config);
  ResolvedRun run = resolve(config.settings);
  if (const auto changed = differences(config.origins, run.origins); !changed.empty() && !options.force)
    throw InputError(options.config + ": " + in_one_line(changed) +
                     "; expected what it was made from, or --force to run it as things are now");
  return run;
}

// Prints what a run left, made now or before, and gives the exit status.
int finish(const nlohmann::json& j, const std::string& text, bool measures = false) {
  std::cout << text;
  if (j["status"] == "converged") return 0;
  std::cerr << "pfaff: the run ended early: " + j["message"].get<std::string>() + " (" +
                   j["status"].get<std::string>() + "); completed samples are kept" +
                   (measures && left_unmeasured(j) ? ", nothing was measured\n" : "\n");
  return 1;
}

// The series as one object: the summary, the columns with their units, and the rows.
nlohmann::json series_json(const ResolvedRun& run, const std::string& series, nlohmann::json summary) {
  summary.erase("series");  // the name of the file, of which there is none
  std::istringstream lines(series);
  std::string line;
  for (bool head = true; std::getline(lines, line); head = false) {
    nlohmann::json row = nlohmann::json::array();
    for (const std::string& cell : split_commas(line)) {
      const auto number = head ? std::nullopt : Real::parse(cell);
      if (cell.empty())
        row.push_back(nullptr);
      else if (!number || run.settings.precision == Precision::quad)
        row.push_back(cell);
      else
        row.push_back(number->value());
    }
    if (head)
      summary["columns"] = row;
    else
      summary["rows"].push_back(row);
  }
  return summary;
}

// What stands around a run while it is made: the handling of signals, the reference solution, progress.
class Attended {
 public:
  Attended(const ResolvedRun& run, bool quiet) : run_(run), line_(quiet) {}
  [[nodiscard]] const ReferenceSolution* reference() const { return reference_.get(); }
  [[nodiscard]] Progress progress() {
    return [this, what = run_.model->name() + ", " + run_.settings.integrator](double fraction) {
      line_.show(what, fraction);
    };
  }

 private:
  Interruption interruption_;
  const ResolvedRun& run_;
  std::shared_ptr<const ReferenceSolution> reference_ = reference_asked_for(run_);
  ProgressLine line_;
};

// Makes a run whose series goes to standard output.
int run_to_standard_output(const ResolvedRun& resolved, const Common& common) {
  nlohmann::json j;
  if (common.json) {  // one object, which begins with the end of the run
    std::string series;
    {
      SeriesWriter writer(resolved, [&](std::string_view rows) { series += rows; });
      Attended attended(resolved, common.quiet);
      j = summary(resolved, execute(resolved, attended.reference(), attended.progress(),
                                    &Interruption::stop(), &writer));
    }
    std::cout << json_text(series_json(resolved, series, j));
  } else {
    RowFile out;
    SeriesWriter writer(resolved, [&](std::string_view rows) { out.take(rows); });
    Attended attended(resolved, common.quiet || isatty(STDOUT_FILENO) != 0);
    j = summary(resolved,
                execute(resolved, attended.reference(), attended.progress(), &Interruption::stop(), &writer));
    writer.finish();
  }
  require_written_output();
  if (j.contains("reference_ended") && !common.quiet) std::cerr << "pfaff: " + of_the_reference(j) + "\n";
  return finish(j, "");
}

// Makes a run in a directory; its summary.
nlohmann::json made_in(const std::filesystem::path& directory, const ResolvedRun& resolved, bool quiet) {
  // Figures and tables of the run before would stand beside this one.
  std::error_code error;
  for (const char* of_the_run_before : {run_figures_directory, measures_directory})
    std::filesystem::remove_all(directory / of_the_run_before, error);
  Attended attended(resolved, quiet);
  return write_run(directory, resolved, attended.reference(), attended.progress(), &Interruption::stop());
}

int run(const RunOptions& options, const Common& common) {
  const ResolvedRun resolved = resolved_run(options);
  const Measures measures = fitting_measures(options.measures, options.out, resolved);
  for (const std::string& said : {other_duration(resolved), resolved.not_conserved})
    if (!said.empty() && !common.quiet) std::cerr << "pfaff: " + said + "\n";
  if (options.out == "-") return run_to_standard_output(resolved, common);
  const std::filesystem::path directory = options.out;
  std::vector<std::string> ours = run_file_names();
  ours.insert(ours.end(), {run_figures_directory, measures_directory});
  const auto experiment = take_experiment_of(directory, "pfaff run");
  const auto held = take_output_directory(directory, "pfaff run", ours);
  const KeptRun kept = kept_run(directory, resolved);
  if (!options.force) {
    refuse_to_replace(kept, directory, "--force");
    refuse_files_of_others(directory, resolved, ours,
                           "a new directory, an empty one, or --force to replace it");
  }
  const nlohmann::json j = kept.current() ? kept.summary : made_in(directory, resolved, common.quiet);
  nlohmann::json tables = tables_of_measures(options.out, resolved, measures, j);
  if (common.quiet) return finish(j, "", !measures.empty());
  const TableRows rows = rows_on(tables);
  nlohmann::json with_tables = j;
  if (!tables.empty()) with_tables["measures"] = std::move(tables);
  return finish(j,
                common.json ? json_text(with_tables)
                            : summary_table(j, kept.current() ? "kept" : "written", options.out, rows),
                !measures.empty());
}

}  // namespace

void add_run(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "run", "Integrate one system with one method");
  add_quiet(*sub, common);
  auto options = std::make_shared<RunOptions>();
  RunSettings& s = options->settings;
  sub->add_option("system,--system", s.system, "The system: its name, or the file of one written as text")
      ->type_name("SYSTEM|FILE");
  sub->add_option("integrator,--integrator", s.integrator,
                  "The integrator: its name, or the file of a table of coefficients")
      ->type_name("INTEGRATOR|FILE");
  sub->add_option("--formulation", s.formulation,
                  "Motion of a system with constraints (without: " + dirac_formulation().name() + " or " +
                      nonholonomic_formulation().name() + ")")
      ->type_name("FORMULATION");
  sub->add_option("--step", s.step, "Size of the steps; this and other numbers may be expressions: 2*pi/200")
      ->type_name("h");
  sub->add_option("--tolerance", s.tolerance,
                  "Instead of --step, for methods that choose their steps: error per step, relative to the "
                  "scale of each coordinate along the motion")
      ->type_name("e");
  sub->add_option("--absolute", options->absolute,
                  "Error to allow beside --tolerance in every coordinate, or one for each")
      ->type_name("a[,a...]");
  sub->add_option("--time", s.time,
                  "Duration of the run, negative to go back in time; the last whole step ends within it")
      ->type_name("T");
  sub->add_option("--every", options->every,
                  "Sample every k-th step (default: about a thousand samples, 200 of processed methods)")
      ->type_name("k");
  sub->add_option("--set", options->set,
                  "A parameter (nu=0.3, integrator.order=4), initial=a,b,... or initial_velocities=a,b,...")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--state", options->state, "JSON file with the initial state: t, and z, q and p or q and v")
      ->type_name("FILE");
  sub->add_option("--precision", options->precision, "The numbers; double without")->type_name("double|quad");
  sub->add_option("--reference", options->reference,
                  "What errors are against: the system's own solution where it has one (default), that or a "
                  "30-digit one, nothing; "
                  "every: at every row, not at 200 of them")
      ->type_name("exact|solution|none[,every]");
  sub->add_option("--max-steps", options->max_steps, "Steps that a run may take (default 1e12)")
      ->type_name("N");
  sub->add_flag("--compile", s.compile,
                "Compile the system's formulas with the C++ compiler of this machine");
  sub->add_flag("--project-initial", s.project_initial, "Move the initial state onto the constraints");
  sub->add_flag("--allow-inconsistent", s.allow_inconsistent, "Take an initial state off the constraints");
  sub->add_option("--measure", options->measures,
                  "Measure the run too: a measure of pfaff list measures, with settings as in NAME(looks=10)")
      ->type_name("MEASURE")
      ->expected(1)
      ->take_all();
  sub->add_option("--config", options->config, "config.toml of an earlier run, to run it again")
      ->type_name("FILE");
  sub->add_flag("--force", options->force,
                "Replace what the directory holds: another run, or one of other files or builds");
  sub->add_option("--out", options->out, "New directory for the run, or - for its series on standard output")
      ->type_name("DIR|-");
  sub->callback(
      [options, &common, &action] { action = [options, &common] { return run(*options, common); }; });
}

}  // namespace pfaff::app
