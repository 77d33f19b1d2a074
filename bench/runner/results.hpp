// What an experiment's runs come to: results.csv, cost.csv, the terminal table, the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/runner/experiment.hpp>

namespace pfaff {

/// The summaries of all runs, in order.
std::vector<nlohmann::json> read_summaries(const std::filesystem::path& directory,
                                           const std::vector<ExperimentRun>& runs);

/// One row per run, deterministic columns only.
std::string results_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries);

/// The terminal's table: status, error, drift, structure, cost of every run; at most 100 columns.
std::string results_table(const std::filesystem::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries);

/// Draws the figures and writes report.html with the report scripts. RunError with their message when they
/// fail.
std::filesystem::path make_report(const std::filesystem::path& directory);

}  // namespace pfaff
