// Timing of runs. What has been timed is kept in cost.csv from one call to the next.
#include <pfaff/bench/experiment/costs.hpp>

#include <charconv>
#include <sstream>

#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/experiment/machine.hpp>
#include <pfaff/bench/runner/files.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
bool any_tolerance(const std::vector<ExperimentRun>& runs) {
  for (const ExperimentRun& run : runs)
    if (!run.tolerance.empty()) return true;
  return false;
}
// The first cells of a run's row. They leave the seed out, so that all runs of an ensemble share one row,
// timed with the first seed.
std::string key_of(const ExperimentRun& run, bool tolerances) {
  return csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," + csv_quoted(run.step) +
         (tolerances ? "," + csv_quoted(run.tolerance) : "");
}
std::string header(bool tolerances) {
  return std::string("case,method,step,") + (tolerances ? "tolerance," : "") +
         "ns_per_step,ns_per_step_min,ns_per_step_max,repetitions,seconds,host";
}
std::string costs_csv(const std::vector<ExperimentRun>& runs, const Costs& costs) {
  const bool tolerances = any_tolerance(runs);
  std::string text = header(tolerances) + "\n";
  for (const ExperimentRun& run : runs)
    if (const auto row = costs.find(key_of(run, tolerances)); run.seed <= 1 && row != costs.end())
      text += row->second.text + "\n";
  return text;
}
// A row of cost.csv whose numbers begin at `begin`.
CostRow row_of(const std::string& line, std::size_t begin) {
  const char* const last = line.data() + line.size();
  double median = 0, minimum = 0;
  const char* const end = std::from_chars(line.data() + begin, last, median).ptr;
  const bool two = end != last && std::from_chars(end + 1, last, minimum).ec == std::errc();
  return {line, median, two ? minimum : median};
}
}  // namespace

Costs read_costs(const fs::path& path, const std::vector<ExperimentRun>& runs) {
  Costs costs;
  std::error_code error;
  if (!fs::exists(path, error)) return costs;
  const bool tolerances = any_tolerance(runs);
  std::istringstream stream(read_file(path));
  std::string line;
  std::getline(stream, line);
  if (line != header(tolerances)) return costs;  // of a version with other columns
  while (std::getline(stream, line))
    for (const ExperimentRun& run : runs)
      if (const std::string key = key_of(run, tolerances); line.starts_with(key + ","))
        costs[key] = row_of(line, key.size() + 1);
  return costs;
}

std::optional<double> cost_of(const ExperimentRun& run, const Costs& costs,
                              const std::vector<ExperimentRun>& runs, Repetition which) {
  const auto row = costs.find(key_of(run, any_tolerance(runs)));
  if (row == costs.end()) return std::nullopt;
  return which == Repetition::median ? row->second.median : row->second.fastest;
}

void keep_costs(const fs::path& directory, const std::vector<ExperimentRun>& runs,
                const std::function<bool(const ExperimentRun&)>& keeps) {
  const fs::path path = directory / "cost.csv";
  std::error_code error;
  if (!fs::exists(path, error)) return;
  const bool tolerances = any_tolerance(runs);
  Costs costs = read_costs(path, runs);
  for (const ExperimentRun& run : runs)
    if (run.seed <= 1 && !keeps(run)) costs.erase(key_of(run, tolerances));
  write_file(path, costs_csv(runs, costs));
}

bool write_costs(const fs::path& directory, const std::vector<ExperimentRun>& runs, double seconds,
                 const ExperimentProgress& progress, const std::atomic<bool>* stop) {
  const fs::path path = directory / "cost.csv";
  const bool tolerances = any_tolerance(runs);
  Costs costs = read_costs(path, runs);
  std::size_t done = 0;
  bool timed = false;
  const double before = load();
  for (const ExperimentRun& run : runs) {
    if (stop != nullptr && *stop) return false;
    if (progress)
      progress({2,
                "timing " + run.which->name + ", " + run.method->label + ", " +
                    (run.tolerance.empty() ? "h = " + run.step : "tolerance " + run.tolerance),
                done, runs.size()});
    ++done;
    const std::string key = key_of(run, tolerances);
    if (run.seed > 1 || costs.contains(key)) continue;
    timed = true;
    const StepTime time = time_steps(run.resolved, seconds);
    costs[key].text = key + "," + formatted("%.6g", time.median) + "," + formatted("%.6g", time.minimum) +
                      "," + formatted("%.6g", time.maximum) + "," + std::to_string(time.repetitions) + "," +
                      formatted("%.4g", time.seconds) + "," + csv_quoted(host_name());
    write_file(
        path,
        costs_csv(runs, costs));  // after each run, so that no timing is lost when the program is killed
  }
  write_file(
      path,
      costs_csv(runs, costs));  // also without new timings: rows of runs no longer asked for are dropped
  if (timed) write_file(path.parent_path() / "machine.json", machine(before, load()).dump(1) + "\n");
  return true;
}

}  // namespace pfaff
