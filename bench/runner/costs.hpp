// What steps cost: cost.csv, comparable only within one machine and build.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/experiment.hpp>

namespace pfaff {

/// A row of cost.csv, and its median in nanoseconds a step.
struct CostRow {
  std::string text;
  double median = 0;
};
/// Rows by their first cells.
using Costs = std::map<std::string, CostRow>;

/// The rows of these runs that a cost.csv holds; none without the file.
Costs read_costs(const std::filesystem::path& path, const std::vector<ExperimentRun>& runs);

/// Nanoseconds a step of a run; nothing where it has not been timed.
std::optional<double> cost_of(const ExperimentRun& run, const Costs& costs,
                              const std::vector<ExperimentRun>& runs);

/// Times every run that cost.csv does not hold yet, one after another, and writes cost.csv. Of an ensemble,
/// the first seed alone.
void write_costs(const std::filesystem::path& directory, const Experiment& experiment,
                 const std::vector<ExperimentRun>& runs, const ExperimentProgress& progress);

}  // namespace pfaff
