// pfaff compare: runs an experiment from its TOML file, shows its table, and writes results.csv, cost.csv,
// figures and report.html; of all experiments an index too.
#include <chrono>
#include <iostream>
#include <map>
#include <optional>

#include <pfaff/app/figure_options.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/stage_text.hpp>
#include <pfaff/bench/experiment/team.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/bench/studies/studies.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff::app {

namespace {

struct CompareOptions {
  std::vector<std::string> names;
  bool all = false, quick = false, force = false, compile = false, no_report = false;
  std::optional<double> timing;
  std::string out;
  PaperFigures paper;
};

// What the selection of methods left out, a paragraph for each case: the methods behind each reason.
std::string left_out_text(const std::vector<LeftOut>& left_out) {
  std::map<std::string, std::map<std::string, std::string>> by_case;
  for (const LeftOut& one : left_out) {
    // "verlet needs separable; x offers ..." is the reason of every method that needs the same.
    std::string reason = one.reason.substr(0, one.reason.find(';'));
    if (const auto at = reason.find(" needs "); at != std::string::npos) reason = reason.substr(at + 1);
    std::string& methods = by_case[one.of_case][reason];
    methods += (methods.empty() ? "" : ", ") + one.method;
  }
  std::string text;
  for (const auto& [name, reasons] : by_case) {
    std::string line = "left out of " + name + ": ";
    for (const auto& [reason, methods] : reasons)
      line += (line.ends_with(": ") ? "" : "; ") + methods + " (" + reason + ")";
    text += paragraph(line);
  }
  return text;
}

// The sentence of every case, as its report begins.
std::string verdict_text(const nlohmann::json& cases) {
  std::string text;
  for (const nlohmann::json& one : cases)
    text += paragraph((cases.size() > 1 ? one.at("case").get<std::string>() + ": " : "") +
                      one.at("sentence").get<std::string>());
  return text.empty() ? text : "\n" + text;
}

// InputError for the first system or method that is not there.
void require_names(const Experiment& experiment) {
  for (const ExperimentCase& one : experiment.cases) (void)system_named(one.system);
  for (const ExperimentMethod& one : experiment.methods) (void)integrator_named(one.integrator);
}

int compare(const CompareOptions& options, const Common& common) {
  const std::unique_ptr<Team> team = launched_team();
  const std::vector<std::string> names = options.all ? experiment_names() : options.names;
  if (names.empty())
    throw InputError("compare: expected files of experiments in '" +
                     (data_directory() / "experiments").string() + "', found none");
  nlohmann::json j{{"schema", 1}, {"experiments", nlohmann::json::array()}};
  bool failed = false;
  const std::filesystem::path above = options.out.empty() ? "pfaff-out" : options.out;
  // Quick and long experiments without --out stand side by side, and so do their indices.
  const std::filesystem::path index =
      above / (options.quick && options.out.empty() ? "index-quick.html" : "index.html");
  const bool indexed = options.all && !options.no_report;
  if (indexed) refuse_what_is_no_index(index);
  check(options.paper);
  std::vector<std::filesystem::path> reported;
  std::vector<Experiment> experiments;
  for (const std::string& name : names) {
    experiments.push_back(read_experiment(name, options.quick));
    for (const std::string& plugin : common.plugins) experiments.back().asked_for += " --plugin " + plugin;
    // What is missing is seen before anything is run.
    if (experiments.back().derivation) (void)studies();
    if (!plugins_left_out().empty()) require_names(experiments.back());
  }
  for (Experiment& experiment : experiments) {
    experiment.compile = experiment.compile || options.compile;
    std::filesystem::path directory = above;
    if (options.out.empty())
      directory /= experiment.name + (options.quick ? "-quick" : "");
    else if (names.size() > 1)
      directory /= experiment.name;
    ExperimentOutcome outcome;
    {
      // Studies of derivations do not look whether they should stop: a signal ends them as usual.
      std::optional<Interruption> interruption;
      if (!experiment.derivation) interruption.emplace();
      ProgressLine line(common.quiet);
      StageText text;
      const auto begin = std::chrono::steady_clock::now();
      outcome = run_experiment(
          experiment, directory,
          [&](const ExperimentStage& stage) {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
            line.show(
                text.at(stage, passed.count()),
                stage.all == 0 ? 1.0 : static_cast<double>(stage.done) / static_cast<double>(stage.all));
          },
          {.force = options.force,
           .stop = &Interruption::stop(),
           .team = team.get(),
           .report = !options.no_report,
           .timing = options.timing});
    }
    if (team != nullptr && !team->leads()) continue;
    if (outcome.interrupted && outcome.runs == 0)
      throw RunError("interrupted while steps were chosen; the same command chooses them again");
    if (outcome.interrupted)
      throw RunError("interrupted: " + std::to_string(outcome.resumed) + " of " +
                     std::to_string(outcome.runs) + " runs are in " + directory.string() +
                     "; the same command resumes");
    MadeFigures figures;
    if (!options.paper.kinds.empty()) figures = make_paper_figures(directory, options.paper);
    nlohmann::json verdict = nlohmann::json::array();
    if (!outcome.report.empty()) {
      verdict = verdicts_of(directory);
      reported.push_back(directory);
    }
    failed = failed || outcome.failed == outcome.runs || !outcome.failed_claims.empty();
    j["experiments"].push_back({{"name", experiment.name},
                                {"directory", directory.string()},
                                {"runs", outcome.runs},
                                {"resumed", outcome.resumed},
                                {"failed", outcome.failed}});
    if (!outcome.report.empty()) {
      j["experiments"].back()["report"] = outcome.report.string();
      j["experiments"].back()["verdict"] = verdict;
    }
    if (!figures.path.empty()) j["experiments"].back()["figures"] = figures.path.string();
    if (!outcome.findings.empty()) j["experiments"].back()["findings"] = outcome.findings;
    for (const LeftOut& one : outcome.left_out)
      j["experiments"].back()["left_out"].push_back(
          {{"case", one.of_case}, {"method", one.method}, {"reason", one.reason}});
    if (!common.json && !common.quiet)
      std::cout << paragraph(experiment.title) << printable(outcome.table) << '\n'
                << outcome.runs << (outcome.runs == 1 ? " run (" : " runs (") << outcome.resumed
                << " resumed, " << outcome.failed << " ended early)\nresults  "
                << (directory / "results.csv").string() << '\n'
                << (outcome.report.empty() ? "" : "report   " + outcome.report.string() + "\n")
                << (figures.path.empty() ? "" : "figures  " + figures.path.string() + "\n")
                << left_out_text(outcome.left_out) << verdict_text(verdict);
    if (!figures.left_out.empty())
      std::cerr << printable("pfaff: " + experiment.name + ": " + figures.left_out) << '\n';
    if (!outcome.failed_claims.empty())
      std::cerr << printable("pfaff: " + experiment.name +
                             ": a finding does not hold: " + outcome.failed_claims)
                << '\n';
  }
  if (indexed && (team == nullptr || team->leads())) {
    make_index(index, reported);
    j["index"] = index.string();
    if (!common.json && !common.quiet) std::cout << "\nindex    " << index.string() << '\n';
  }
  if (common.json) std::cout << json_text(j);
  return failed ? 1 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "compare", "Run an experiment: table, CSV, figures, report");
  add_quiet(*sub, common);
  auto options = std::make_shared<CompareOptions>();
  sub->add_option("experiment", options->names,
                  "Name of one that ships (pfaff list experiments), or a TOML file")
      ->type_name("EXPERIMENT|FILE");
  sub->add_flag("--all", options->all, "Every experiment that ships");
  sub->add_flag("--quick", options->quick, "Shorter horizons and fewer steps, to look at");
  sub->add_flag(
      "--force", options->force,
      "Run anew what was made from other files or builds, and replace another experiment of the same name");
  sub->add_flag("--compile", options->compile,
                "Compile the systems' formulas with the C++ compiler of this machine");
  sub->add_flag("--no-report", options->no_report, "Leave out the figures and report.html");
  sub->add_option("--timing", options->timing,
                  "How long each run is timed, in seconds (default 0.3, with --quick 0.05)")
      ->type_name("SECONDS")
      ->check(positive_number());
  sub->add_option("--out", options->out, "Where results go (default pfaff-out/NAME), or resume from")
      ->type_name("DIR");
  add_figure_options(*sub, options->paper);
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      if (options->all == !options->names.empty())
        throw InputError("compare: expected the name of an experiment, or --all");
      return compare(*options, common);
    };
  });
}

}  // namespace pfaff::app
