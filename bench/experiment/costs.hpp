// What steps cost in processor time, kept in cost.csv. The numbers are comparable only within one machine and
// build.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/tables.hpp>

namespace pfaff {

/// The columns of cost.csv.
Columns cost_columns(const std::vector<ExperimentRun>& runs);

/// A row of cost.csv as text, and nanoseconds per step in it: of the median and of the fastest repetition.
struct CostRow {
  std::string text;
  double median = 0, fastest = 0;
};
/// Rows of cost.csv by their first cells: case, method, and step or tolerance.
using Costs = std::map<std::string, CostRow>;

/// True where something can have taken so many seconds. A number that is read may have been edited.
bool plausible_seconds(double seconds);

/// The rows of cost.csv that belong to `runs`; none where the file does not exist. A row that is cut, or
/// whose numbers no timing can have given, is left out as if the run had not been timed.
Costs read_costs(const std::filesystem::path& path, const std::vector<ExperimentRun>& runs);

/// Which of the repetitions of a timing is meant.
enum class Repetition { median, fastest };

/// Nanoseconds per step of `run`; nothing where it has not been timed. `runs` are all runs of the experiment.
std::optional<double> cost_of(const ExperimentRun& run, const Costs& costs,
                              const std::vector<ExperimentRun>& runs, Repetition which = Repetition::median);

/// Removes from cost.csv, where there is one, the rows of runs for which `keeps` is false.
void keep_costs(const std::filesystem::path& directory, const std::vector<ExperimentRun>& runs,
                const std::function<bool(const ExperimentRun&)>& keeps);

/// Times every run that cost.csv does not hold yet, one after another, and writes cost.csv, with the name of
/// the machine at the end of each row. What is made of timings goes before the first new one. The runs of an
/// ensemble differ only in their seed, so that only the first of them is timed. Where it is asked to stop
/// before all were timed, rows that are written by then are kept. Each run is timed for about `seconds`.
void write_costs(const std::filesystem::path& directory, const std::vector<ExperimentRun>& runs,
                 double seconds, const ExperimentProgress& progress);

}  // namespace pfaff
