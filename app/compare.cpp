// pfaff compare: runs an experiment from its TOML file, shows its table, and writes results.csv, cost.csv,
// figures and report.html.
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/results.hpp>

namespace pfaff::app {

namespace {

struct Options {
  std::vector<std::string> names;
  bool all = false, quick = false, force = false, compile = false;
  std::string out;
  PaperFigures paper;
};

int compare(const Options& options, const Common& common) {
  const std::vector<std::string> names = options.all ? experiment_names() : options.names;
  nlohmann::json j{{"schema", 1}, {"experiments", nlohmann::json::array()}};
  bool failed = false;
  for (const std::string& name : names) {
    Experiment experiment = read_experiment(name, options.quick);
    experiment.compile = experiment.compile || options.compile;
    std::filesystem::path directory = options.out;
    if (options.out.empty())
      directory = std::filesystem::path("pfaff-out") / (experiment.name + (options.quick ? "-quick" : ""));
    if (!options.out.empty() && names.size() > 1) directory /= experiment.name;
    ExperimentOutcome outcome;
    {
      ProgressLine line(common.quiet);
      outcome = run_experiment(
          experiment, directory,
          [&](const std::string& what, std::size_t done, std::size_t all) {
            line.show(what, all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all));
          },
          options.force);
    }
    std::filesystem::path figures;
    if (!options.paper.kinds.empty()) figures = make_paper_figures(directory, options.paper);
    failed = failed || outcome.failed == outcome.runs || !outcome.failed_claims.empty();
    j["experiments"].push_back({{"name", experiment.name},
                                {"directory", directory.string()},
                                {"runs", outcome.runs},
                                {"resumed", outcome.resumed},
                                {"failed", outcome.failed},
                                {"report", outcome.report.string()}});
    if (!figures.empty()) j["experiments"].back()["figures"] = figures.string();
    if (!outcome.findings.empty()) j["experiments"].back()["findings"] = outcome.findings;
    if (!common.json && !common.quiet)
      std::cout << paragraph(experiment.title) << printable(outcome.table) << '\n'
                << outcome.runs << (outcome.runs == 1 ? " run (" : " runs (") << outcome.resumed
                << " resumed, " << outcome.failed << " ended early)\nresults  "
                << (directory / "results.csv").string() << "\nreport   " << outcome.report.string() << '\n'
                << (figures.empty() ? "" : "figures  " + figures.string() + "\n");
    if (!outcome.failed_claims.empty())
      std::cerr << printable("pfaff: " + experiment.name +
                             ": a finding does not hold: " + outcome.failed_claims)
                << '\n';
  }
  if (common.json) std::cout << json_text(j);
  return failed ? 1 : 0;
}

}  // namespace

void add_compare(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "compare", "Run an experiment: table, CSV, figures, report");
  add_quiet(*sub, common);
  auto options = std::make_shared<Options>();
  sub->add_option("experiment", options->names,
                  "Name of one that ships (pfaff list experiments), or a TOML file")
      ->type_name("EXPERIMENT|FILE");
  sub->add_flag("--all", options->all, "Every experiment that ships");
  sub->add_flag("--quick", options->quick, "Shorter horizons and fewer steps, to look at");
  sub->add_flag("--force", options->force, "Run anew what was made from other files or builds");
  sub->add_flag("--compile", options->compile,
                "Compile the systems' formulas with the C++ compiler of this machine");
  sub->add_option("--out", options->out, "Where results go (default pfaff-out/NAME), or resume from")
      ->type_name("DIR");
  sub->add_option("--figures", options->paper.kinds,
                  "Figures and tables for papers too: some of pdf, svg, pgf, png")
      ->type_name("KIND,...");
  sub->add_option("--width", options->paper.width, "Width of the figures for papers (default 85mm)")
      ->type_name("LENGTH");
  sub->add_option("--style", options->paper.style, "A style file of matplotlib's for the figures for papers")
      ->type_name("FILE");
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      if (options->all == !options->names.empty())
        throw InputError("compare: expected the name of an experiment, or --all");
      return compare(*options, common);
    };
  });
}

}  // namespace pfaff::app
