// pfaff run: one run, to a directory or to standard output.
#include <fstream>
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/state_file.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>

namespace pfaff::app {

namespace {

struct Options {
  RunSettings settings;
  std::vector<std::string> set;
  std::string every, precision, out, state, config;
};

// What the options ask for, from a config.toml or from the options themselves, unresolved.
RunSettings settings_of(const Options& options) {
  if (options.out.empty())
    throw InputError("--out is missing: a new directory for the run, or - for its series on standard output");
  RunSettings settings = options.settings;
  if (!options.config.empty()) {
    for (const std::string& other :
         {settings.system, settings.formulation, settings.integrator, settings.time, settings.step,
          settings.tolerance, options.every, options.precision, options.state})
      if (!other.empty() || !options.set.empty())
        throw InputError("--config holds the whole run; expected no other settings beside it");
    return read_config(options.config);
  }
  if (settings.system.empty()) throw InputError("--system is missing (see pfaff list systems)");
  if (settings.project_initial && settings.allow_inconsistent)
    throw InputError("--project-initial and --allow-inconsistent exclude each other");
  if (settings.integrator.empty()) throw InputError("--integrator is missing (see pfaff list integrators)");
  if (settings.time.empty()) throw InputError("--time is missing: the duration of the run");
  settings.set = parse_settings(options.set);
  if (!options.precision.empty()) settings.precision = parse_precision(options.precision);
  if (!options.every.empty()) settings.every = parse_every(options.every, "--every");
  if (!options.state.empty()) {
    for (const auto& [key, value] : settings.set)
      if (key == "initial") throw InputError("--state and --set initial exclude each other");
    read_state(options.state, settings);
  }
  return settings;
}

int run(const Options& options, bool json) {
  const ResolvedRun resolved = resolve(settings_of(options));
  const bool to_stdout = options.out == "-";
  if (!to_stdout) make_output_directory(options.out);

  std::unique_ptr<ReferenceSolution> reference;
  if (resolved.model->facets().has(Facet::exact_solution)) {
    std::vector<Quad> initial;
    for (const Real& x : resolved.initial) initial.push_back(x.quad());
    reference = std::make_unique<ReferenceSolution>(resolved.model, resolved.t0.quad(), initial,
                                                    resolved.time.quad());
  }
  RunRecord record;
  {
    ProgressLine line;
    record = execute(resolved, reference.get(), [&](double fraction) {
      line.show(resolved.model->name() + ", " + resolved.settings.integrator, fraction);
    });
  }
  if (to_stdout) {
    std::cout << series_csv(resolved, record) << std::flush;
    if (!std::cout) throw RunError("cannot write to standard output");
  } else {
    const std::filesystem::path directory = options.out;
    const nlohmann::json j = summary(resolved, record);
    write_file(directory / "config.toml", config_text(resolved));
    write_file(directory / "series.csv", series_csv(resolved, record));
    write_file(directory / "summary.json", j.dump(1) + "\n");
    if (json) {
      std::cout << j.dump(1) << '\n';
    } else {
      std::vector<std::vector<std::string>> rows{
          {"status",
           std::string(to_string(record.status)) + " after " + std::to_string(record.completed) + " steps"}};
      const auto scientific = [](double x) {
        char text[32];
        std::snprintf(text, sizeof text, "%.3g", x);
        return std::string(text);
      };
      if (record.error_max)
        rows.push_back(
            {"error", "max " + scientific(*record.error_max) + ", final " + scientific(*record.error_final)});
      if (record.structure_residual)
        rows.push_back({"structure", "residual " + scientific(*record.structure_residual)});
      for (const auto& i : j["invariants"])
        if (i.contains("max"))
          rows.push_back({i["name"], "drift max " + scientific(i["max"]) + ", rms " + scientific(i["rms"]) +
                                         ", slope " + scientific(i["slope"]) + ", " +
                                         i["class"].get<std::string>()});
        else if (i.contains("largest_rise"))
          rows.push_back(
              {i["name"], "largest rise " + scientific(i["largest_rise"]) + ", expected to decrease"});
      if (j.contains("constraints"))
        for (const auto& c : j["constraints"])
          rows.push_back({c["name"], "residual max " + scientific(c["max"]) + ", final " +
                                         scientific(c["final"]) + ", " + c["class"].get<std::string>()});
      if (j.contains("projected_initial"))
        rows.push_back(
            {"initial", "moved onto the constraints, relative change " + scientific(j["projected_initial"])});
      rows.push_back({"written", options.out + "/{config.toml, series.csv, summary.json}"});
      std::cout << table(rows);
    }
  }
  if (record.status != Status::converged) {
    std::cerr << "pfaff: the run ended early: " << record.message << " (" << to_string(record.status)
              << "); completed samples are kept\n";
    return 1;
  }
  return 0;
}

}  // namespace

void add_run(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "run", "Integrate one system with one method");
  auto options = std::make_shared<Options>();
  RunSettings& s = options->settings;
  sub->add_option("--system", s.system, "Name of the system")->type_name("NAME");
  sub->add_option("--formulation", s.formulation, "Vector field of a constrained system (dirac without)")
      ->type_name("NAME");
  sub->add_option("--integrator", s.integrator, "Name of the integrator")->type_name("NAME");
  sub->add_option("--step", s.step, "Step h > 0")->type_name("h");
  sub->add_option("--tolerance", s.tolerance, "Instead of --step, for methods that choose their steps")
      ->type_name("e");
  sub->add_option("--time", s.time, "Duration of the run, of which whole steps are taken")->type_name("T");
  sub->add_option("--every", options->every, "Sample every k-th step (default: about a thousand samples)")
      ->type_name("k");
  sub->add_option("--set", options->set, "A parameter (nu=0.3, integrator.order=4) or initial=a,b,...")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--state", options->state, "JSON file with the initial state: t, and z or q and p")
      ->type_name("FILE");
  sub->add_option("--precision", options->precision, "double (default) or quad")->type_name("NAME");
  sub->add_flag("--project-initial", s.project_initial, "Move the initial state onto the constraints");
  sub->add_flag("--allow-inconsistent", s.allow_inconsistent, "Take an initial state off the constraints");
  sub->add_option("--config", options->config, "config.toml of an earlier run, to run it again")
      ->type_name("FILE");
  sub->add_option("--out", options->out, "New directory for the run, or - for its series on standard output")
      ->type_name("DIR|-");
  sub->callback(
      [options, &common, &action] { action = [options, &common] { return run(*options, common.json); }; });
}

}  // namespace pfaff::app
