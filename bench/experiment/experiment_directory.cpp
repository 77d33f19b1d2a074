#include <pfaff/bench/experiment/experiment_directory.hpp>

#include <pfaff/bench/experiment/tables.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/measure_tables.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace fs = std::filesystem;

std::unique_ptr<DirectoryLock> take_experiment_directory(const fs::path& directory, const std::string& work) {
  return take_output_directory(directory, work, {experiment_file}, experiment_file);
}

std::unique_ptr<DirectoryLock> take_experiment_of(const fs::path& run, const std::string& work) {
  std::error_code error;
  const fs::path experiment = fs::weakly_canonical(run, error).parent_path().parent_path();
  if (error || !fs::is_regular_file(experiment / experiment_file, error)) return nullptr;
  return std::make_unique<DirectoryLock>(experiment, work);
}

void refuse_another_experiment(const fs::path& directory, const nlohmann::json& theirs,
                               const nlohmann::json& mine, bool force) {
  if (theirs == mine) return;
  const bool same_name = theirs.at("name") == mine.at("name");
  if (same_name && force) return;
  throw InputError("output directory '" + directory.string() + "' holds another experiment" +
                   (same_name ? " of the same name; expected a new directory, or --force to replace it"
                              : "; expected a new directory or the same experiment to resume"));
}

void remove_derived(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {results_file, equal_cost_file, ensembles_file, measures_directory, findings_file,
                           "fits.csv", "report.html", "report.json", "verdict.csv", "figures"})
    fs::remove_all(directory / name, error);
}

}  // namespace pfaff
