// What is made of an experiment's runs: results.csv, the table in the terminal, and the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/tables.hpp>

namespace pfaff {

/// The summaries of all runs, in order.
std::vector<nlohmann::json> read_summaries(const std::filesystem::path& directory,
                                           const std::vector<ExperimentRun>& runs,
                                           const std::string& folder = "runs");

/// The columns of results.csv. They are deterministic only, so that the same experiment gives the same file;
/// timings are in cost.csv.
Columns results_columns(const std::vector<ExperimentRun>& runs);
/// The text of such a table, one row per run, with the columns that `all` runs of the experiment need.
std::string results_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                        const std::vector<ExperimentRun>& all);

/// The table for the terminal, with error, drift, structure residual or constraints, and cost of every run,
/// as wide as the terminal allows.
std::string results_table(const std::filesystem::path& directory, const Experiment& experiment,
                          const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries);

/// Runs the report scripts, which draw the figures and write report.html, and returns the path of the report.
/// RunError with the message of the scripts when they fail.
std::filesystem::path make_report(const std::filesystem::path& directory);

/// What the report of a directory says of each case, as report.json holds it: the sentence, the line below
/// it, and a row for each method.
nlohmann::json verdicts_of(const std::filesystem::path& directory);

/// Refuses a file in the place of an index that is none.
void refuse_what_is_no_index(const std::filesystem::path& page);

/// Runs the report scripts, which write one page of the reports in these directories: their sentences, a
/// picture of each, and what became of every method with every problem. RunError as above.
void make_index(const std::filesystem::path& page, const std::vector<std::filesystem::path>& directories);

/// Figures for papers, as the report scripts take them.
struct PaperFigures {
  std::string kinds;  // of pdf, svg, pgf and png some, with commas between them
  std::string width = "85mm";
  std::string style;  // a style file of matplotlib's; empty for the one that ships
};

/// Refuses what the report scripts do not make. InputError with their message.
void check(const PaperFigures& wanted);

/// What the scripts made of figures.
struct MadeFigures {
  std::filesystem::path path;
  std::string sentence;  // what the figures of a run show
  std::string left_out;  // what could not be made, and why; empty where nothing was left out
};

/// Runs the report scripts, which draw figures and write tables for papers, and returns the directory of
/// these. RunError with the message of the scripts when they fail.
MadeFigures make_paper_figures(const std::filesystem::path& directory, const PaperFigures& wanted);

/// Where the figures of a run stand in its directory.
constexpr const char* run_figures_directory = "plot";

/// Runs the scripts that draw one run, which make plot/ in its directory, and returns the path of the page
/// there. The motion is drawn in the plane of two coordinates, "q1,q2", or where none are named of those that
/// the system suggests. InputError with the message of the scripts when they refuse.
MadeFigures make_run_figures(const std::filesystem::path& directory, const PaperFigures& wanted,
                             const std::string& coordinates);

}  // namespace pfaff
