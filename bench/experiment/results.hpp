// What is made of an experiment's runs: results.csv, the table in the terminal, and the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// The summaries of all runs, in order.
std::vector<nlohmann::json> read_summaries(const std::filesystem::path& directory,
                                           const std::vector<ExperimentRun>& runs,
                                           const std::string& folder = "runs");

/// The text of results.csv, one row per run. It has deterministic columns only, so that the same experiment
/// gives the same file; timings are in cost.csv.
std::string results_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries);

/// The table for the terminal, with error, drift, structure residual or constraints, and cost of every run,
/// as wide as the terminal allows.
std::string results_table(const std::filesystem::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries);

/// Runs the report scripts, which draw the figures and write report.html, and returns the path of the report.
/// RunError with the message of the scripts when they fail.
std::filesystem::path make_report(const std::filesystem::path& directory);

/// Figures for papers, as the report scripts take them.
struct PaperFigures {
  std::string kinds;  // of pdf, svg, pgf and png some, with commas between them
  std::string width = "85mm";
  std::string style;  // a style file of matplotlib's; empty for the one that ships
};

/// Runs the report scripts, which draw figures and write tables for papers, and returns the directory of
/// these. RunError with the message of the scripts when they fail.
std::filesystem::path make_paper_figures(const std::filesystem::path& directory, const PaperFigures& wanted);

/// Where the figures of a run stand in its directory.
constexpr const char* run_figures_directory = "plot";

/// Runs the scripts that draw one run, which make plot/ in its directory, and returns the path of the page
/// there. RunError with the message of the scripts when they fail.
std::filesystem::path make_run_figures(const std::filesystem::path& directory);

}  // namespace pfaff
