// pfaff evaluate: shows everything the formulas of a system give at one state and time.
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/evaluation_text.hpp>
#include <pfaff/app/state_file.hpp>
#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/bench/runner/initial_state.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/runs/motion.hpp>

namespace pfaff::app {

namespace {

struct EvaluateOptions {
  RunSettings settings;
  std::vector<std::string> set;
  std::string state, time, precision, centre;
};

EvaluationSettings settings_of(const EvaluateOptions& options) {
  RunSettings run = options.settings;
  if (run.system.empty()) throw InputError("--system is missing (see pfaff list systems)");
  run.set = parse_settings(options.set);
  if (!options.state.empty()) {
    for (const auto& [key, value] : run.set)
      if (key == "initial" || key == "initial_velocities")
        throw InputError("--state and --set " + key + " exclude each other");
    run.t0.clear();
    read_state(options.state, run);
    if (!options.time.empty() && !run.t0.empty())
      throw InputError("--time and the t of " + options.state + " exclude each other");
    if (run.t0.empty()) run.t0 = "0";
  }
  if (!options.time.empty()) run.t0 = options.time;
  EvaluationSettings settings;
  if (!options.precision.empty()) settings.precision = parse_precision(options.precision);
  settings.at = resolve_state(run);
  if (!options.centre.empty())
    settings.centre = state_numbers(*settings.at.model, split_commas(options.centre), "centre");
  return settings;
}

}  // namespace

void add_evaluate(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "evaluate", "A system at one state: its field, energy, structure");
  auto options = std::make_shared<EvaluateOptions>();
  sub->add_option("system,--system", options->settings.system,
                  "The system: its name, or the file of one written as text")
      ->type_name("SYSTEM|FILE");
  sub->add_option("--formulation", options->settings.formulation,
                  "Motion of a system with constraints (without: " + dirac_formulation().name() + " or " +
                      nonholonomic_formulation().name() + ")")
      ->type_name("FORMULATION");
  sub->add_option(
         "--set", options->set,
         "A parameter (nu=0.3) or the state: initial=a,b,..., or its velocities, initial_velocities=a,b,...")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--state", options->state, "JSON file with the state: t, and z, q and p or q and v")
      ->type_name("FILE");
  sub->add_option("--time", options->time, "The time, 0 without")->type_name("t");
  sub->add_option("--precision", options->precision, "The numbers; double without")->type_name("double|quad");
  sub->add_flag("--compile", options->settings.compile,
                "Compile the system's formulas with the C++ compiler of this machine");
  sub->add_option("--centre", options->centre, "F and B from K and D about this point: a,b,...")
      ->type_name("a,b,...");
  sub->callback([options, &common, &action] {
    action = [options, &common] {
      const nlohmann::json j = evaluation(settings_of(*options));
      if (common.json) {
        std::cout << json_text(j);
      } else {
        std::cout << evaluation_text(j);
      }
      if (j["status"] == "converged") return 0;
      const std::string what =
          j["status"] == "singular" ? "is singular" : "is none where all of this is finite";
      throw RunError("the state of " + j["system"].get<std::string>() + " " + what +
                     (j.contains("reason") ? ": " + j["reason"].get<std::string>() : ""));
    };
  });
}

}  // namespace pfaff::app
