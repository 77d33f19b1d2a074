// pfaff plot: draws a run that `pfaff run` or an experiment has left.
#include <filesystem>
#include <iostream>
#include <memory>

#include <pfaff/app/figure_options.hpp>
#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/bench/runner/terminal.hpp>

namespace pfaff::app {

namespace {

struct PlotOptions {
  std::string directory, coordinates;
  PaperFigures paper;
};

int plot(const PlotOptions& options, bool json) {
  const std::filesystem::path directory = options.directory;
  for (const std::string& name : run_file_names())
    if (std::error_code error; !std::filesystem::is_regular_file(directory / name, error))
      throw InputError("plot: '" + directory.string() + "' holds no " + name +
                       "; expected the directory of a run");
  const auto experiment = take_experiment_of(directory, "pfaff plot");
  const DirectoryLock lock(directory, "pfaff plot");
  check_undamaged(directory);
  const MadeFigures made = make_run_figures(directory, options.paper, options.coordinates);
  const std::filesystem::path figures = made.path.parent_path();
  const bool printed = !options.paper.kinds.empty();
  if (json) {
    nlohmann::json j{{"schema", 1}, {"page", made.path.string()}, {"sentence", made.sentence}};
    if (printed) j["figures"] = (figures / "paper").string();
    std::cout << json_text(j);
  } else {
    std::cout << paragraph(made.sentence) << "page     " << made.path.string() << "\nfigures  "
              << figures.string() << " (SVG and PNG)"
              << (printed ? ", " + (figures / "paper").string() : std::string()) << '\n';
  }
  if (!made.left_out.empty()) std::cerr << printable("pfaff: " + made.left_out) << '\n';
  return 0;
}

}  // namespace

void add_plot(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "plot", "Draw a run: its motion, and what drifts against time");
  auto options = std::make_shared<PlotOptions>();
  sub->add_option("run", options->directory, "Directory of a run, as pfaff run or an experiment leaves it")
      ->type_name("DIR")
      ->required();
  sub->add_option("--coordinates", options->coordinates,
                  "The two coordinates in whose plane the motion is drawn, such as q1,q2")
      ->type_name("X,Y");
  add_figure_options(*sub, options->paper);
  sub->callback([=, &common, &action] { action = [=, &common] { return plot(*options, common.json); }; });
}

}  // namespace pfaff::app
