// pfaff plot: draws a run that `pfaff run` or an experiment has left.
#include <filesystem>
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/bench/runner/terminal.hpp>

namespace pfaff::app {

namespace {

int plot(const std::filesystem::path& directory, bool json) {
  for (const std::string& name : run_file_names())
    if (std::error_code error; !std::filesystem::is_regular_file(directory / name, error))
      throw InputError("plot: '" + directory.string() + "' holds no " + name +
                       "; expected the directory of a run");
  const auto experiment = take_experiment_of(directory, "pfaff plot");
  const DirectoryLock lock(directory, "pfaff plot");
  const std::filesystem::path page = make_run_figures(directory);
  if (json) {
    std::cout << json_text({{"schema", 1}, {"page", page.string()}});
  } else {
    std::cout << "page     " << page.string() << "\nfigures  " << page.parent_path().string()
              << " (SVG and PNG)\n";
  }
  return 0;
}

}  // namespace

void add_plot(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "plot", "Draw a run: its motion, and what drifts against time");
  auto directory = std::make_shared<std::string>();
  sub->add_option("run", *directory, "Directory of a run, as pfaff run or an experiment leaves it")
      ->type_name("DIR")
      ->required();
  sub->callback([=, &common, &action] { action = [=, &common] { return plot(*directory, common.json); }; });
}

}  // namespace pfaff::app
