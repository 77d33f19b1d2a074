// Timing of runs. What has been timed is kept in cost.csv from one call to the next.
#include <pfaff/bench/experiment/costs.hpp>

#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/experiment/machine.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
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
std::string costs_csv(const std::vector<ExperimentRun>& runs, const Costs& costs) {
  const bool tolerances = any_tolerance(runs);
  std::string text = head_of(cost_columns(runs)) + "\n";
  for (const ExperimentRun& run : runs)
    if (const auto row = costs.find(key_of(run, tolerances)); run.seed <= 1 && row != costs.end())
      text += row->second.text + "\n";
  return text;
}
// The cells behind the key, as numbers as long as they are such; the rest is the name of the host.
std::vector<double> numbers_in(const std::string& line, std::size_t begin) {
  std::vector<double> numbers;
  for (const char *at = line.data() + begin, *const end = line.data() + line.size(); at < end;) {
    double x = 0;
    const auto [after, failure] = std::from_chars(at, end, x);
    if (failure != std::errc() || after == end || *after != ',') break;
    numbers.push_back(x);
    at = after + 1;
  }
  return numbers;
}

// The row of cost.csv whose numbers begin at `begin`; nothing where no timing can have given them. A median
// of 0 says that no step could be taken.
std::optional<CostRow> row_of(const std::string& line, std::size_t begin) {
  const std::vector<double> x = numbers_in(line, begin);
  if (x.size() < 5) return std::nullopt;
  const double median = x[0], least = x[1], most = x[2], repetitions = x[3], seconds = x[4];
  constexpr double rounded = 1.01;  // the numbers have four digits at least
  // Each repetition took a step at least, and all of them together took `seconds`.
  const bool plausible = 0 <= least && least <= median && median <= most && repetitions >= 1 &&
                         repetitions <= 1e6 && repetitions == std::floor(repetitions) &&
                         plausible_seconds(seconds) &&
                         1e-9 * (most + (repetitions - 1) * least) <= rounded * seconds;
  if (!plausible) return std::nullopt;
  return CostRow{line, median, least};
}
}  // namespace

Columns cost_columns(const std::vector<ExperimentRun>& runs) {
  const std::string time = runs.empty() ? "" : runs.front().resolved.model->time_unit();
  Columns columns = columns_named({"case*", "method*", "step", "ns_per_step", "ns_per_step_min",
                                   "ns_per_step_max", "repetitions", "seconds", "host*"});
  columns[2].unit = time;
  for (Column& column : columns)
    if (column.name.starts_with("ns_")) column.unit = "ns";
  columns[7].unit = "s";
  if (any_tolerance(runs)) columns.insert(columns.begin() + 3, {"tolerance"});
  return columns;
}

bool plausible_seconds(double seconds) {
  constexpr double thirty_years = 1e9;
  return seconds > 0 && seconds < thirty_years;
}

Costs read_costs(const fs::path& path, const std::vector<ExperimentRun>& runs) {
  Costs costs;
  std::error_code error;
  if (!fs::exists(path, error)) return costs;
  const bool tolerances = any_tolerance(runs);
  std::istringstream stream(read_file(path));
  std::string line;
  std::getline(stream, line);
  if (line != head_of(cost_columns(runs))) return costs;  // of a version with other columns
  while (std::getline(stream, line) && !stream.eof())     // the last line is cut where nothing ends it
    for (const ExperimentRun& run : runs)
      if (const std::string key = key_of(run, tolerances); line.starts_with(key + ","))
        if (const auto row = row_of(line, key.size() + 1)) costs[key] = *row;
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
  const fs::path path = directory / costs_file;
  std::error_code error;
  if (!fs::exists(path, error)) return;
  const bool tolerances = any_tolerance(runs);
  Costs costs = read_costs(path, runs);
  for (const ExperimentRun& run : runs)
    if (run.seed <= 1 && !keeps(run)) costs.erase(key_of(run, tolerances));
  write_file(path, costs_csv(runs, costs));
}

void write_costs(const fs::path& directory, const std::vector<ExperimentRun>& runs, double seconds,
                 const ExperimentProgress& progress) {
  const fs::path path = directory / costs_file;
  const bool tolerances = any_tolerance(runs);
  const fs::path of_machine = directory / "machine.json";
  // Timings say something together with the machine that they were taken on. Those of a program that was
  // interrupted have no such file yet.
  std::error_code error;
  Costs costs = !fs::exists(of_machine, error) || is_machine(of_machine) ? read_costs(path, runs) : Costs();
  std::size_t done = 0;
  bool timed = false;
  const double before = load();
  for (const ExperimentRun& run : runs) {
    spend(0, 0);
    if (progress)
      progress({2,
                "timing " + run.which->name + ", " + run.method->label + ", " +
                    (run.tolerance.empty() ? "h = " + run.step : "tolerance " + run.tolerance),
                done, runs.size()});
    ++done;
    const std::string key = key_of(run, tolerances);
    if (run.seed > 1 || costs.contains(key)) continue;
    if (!timed) remove_derived(directory);
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
  if (timed) write_file(of_machine, machine(before, load()).dump(1) + "\n");
}

}  // namespace pfaff
