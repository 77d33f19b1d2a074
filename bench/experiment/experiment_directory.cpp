#include <pfaff/bench/experiment/experiment_directory.hpp>

#include <pfaff/bench/runner/files.hpp>

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

void remove_derived(const fs::path& directory) {
  std::error_code error;
  for (const char* name :
       {"results.csv", "equal_cost.csv", "ensembles.csv", "contraction.csv", "loops.csv", "reversibility.csv",
        "frequencies.csv", "findings.csv", "fits.csv", "report.html", "report.json", "figures"})
    fs::remove_all(directory / name, error);
}

}  // namespace pfaff
