// What the runs of an experiment show together: the numbers of one run by name, their spread over the runs of
// an ensemble, and whether the claims of the experiment about its methods hold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/tables.hpp>

namespace pfaff {

/// Names of the numbers that a run measures: error_max and error_final, with a reference
/// solution; NAME:FIELD of conserved invariants and of constraint residuals, with the fields that are
/// compared (quantity_fields); NAME:rise of invariants that are to decrease in the direction of the run and
/// NAME:fall of those that are to increase.
std::vector<std::string> measures_of(const ResolvedRun& run, bool reference);
/// The number named `measure` in a run's summary, without its sign for finals; nothing where the run has
/// none.
std::optional<double> measured(const nlohmann::json& summary, const std::string& measure);

/// Median and range of a number over those runs of one method, step and case that finished.
struct Spread {
  std::size_t runs = 0, finished = 0, measured = 0;
  double median = 0, low = 0, high = 0;
};
/// The spread of `measure` over the runs that differ from `of` at most in their seed.
Spread spread_over_seeds(const ExperimentRun& of, const std::string& measure,
                         const std::vector<ExperimentRun>& runs,
                         const std::vector<nlohmann::json>& summaries);

/// The columns of ensembles.csv and of findings.csv.
Columns ensemble_columns();
Columns finding_columns();

/// The text of ensembles.csv: one row for every measure of every method and step of an ensemble; empty where
/// there is no ensemble.
std::string ensembles_csv(const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries);

/// A claim and what the runs show of it. The runs of its two methods are compared in pairs: both runs have
/// the same seed and the same step, or the same tolerance where both choose their steps; where only one of
/// the methods chooses its steps, the seed alone decides. The claim does not hold for a pair in which a run
/// ended early.
struct Finding {
  const ExperimentClaim* claim = nullptr;
  std::size_t pairs = 0, holding = 0, needed = 0;
  double first_median = 0, second_median = 0, ratio_median = 0;  // over the pairs that finished
  [[nodiscard]] bool holds() const { return holding >= needed; }
};

/// Throws InputError where a claim names a number that its runs do not measure, or asks for more pairs than
/// there are.
void check_claims(const Experiment& experiment, const std::vector<ExperimentRun>& runs);

std::vector<Finding> findings_of(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                                 const std::vector<nlohmann::json>& summaries);

/// A finding as a phrase, such as "constraint:max of lmm exceeds dirac's in 31 of 32 runs".
std::string in_words(const Finding& finding);
std::string findings_csv(const std::vector<Finding>& findings);
/// Lines for the terminal, empty without findings.
std::string findings_table(const std::vector<Finding>& findings);
nlohmann::json to_json(const Finding& finding);
/// One line on the claims that do not hold; empty where all of them do.
std::string failed_claims(const std::vector<Finding>& findings);

}  // namespace pfaff
