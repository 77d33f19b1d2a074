// What the runs of an experiment say together: numbers of one run by name, spreads over the runs of an
// ensemble, and whether what the experiment claims of its methods holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/experiment.hpp>

namespace pfaff {

/// Names of what a run of this model measures: error_max and error_final with a reference solution, NAME:max,
/// NAME:rms and NAME:final of conserved invariants and of constraint residuals, NAME:growth and
/// NAME:growth_rate of residuals, NAME:rise of decreasing invariants.
std::vector<std::string> measures_of(const Model& model, bool reference);
/// That number in a run's summary, its absolute value for finals; nothing where the run has none.
std::optional<double> measured(const nlohmann::json& summary, const std::string& measure);

/// Median and range of a number over the runs of one method, step and case that finished.
struct Spread {
  std::size_t runs = 0, finished = 0, measured = 0;
  double median = 0, low = 0, high = 0;
};
/// Of the runs that are the same as `of` but for the seed.
Spread spread_over_seeds(const ExperimentRun& of, const std::string& measure,
                         const std::vector<ExperimentRun>& runs,
                         const std::vector<nlohmann::json>& summaries);

/// One row for every measure of every method and step of an ensemble; empty where there is no ensemble.
std::string ensembles_csv(const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries);

/// A claim and what the runs say of it. Pairs are runs of both methods that agree in seed, and in step where
/// both take steps, or in tolerance where both choose them; a pair with a run that ended early does not hold.
struct Finding {
  const ExperimentClaim* claim = nullptr;
  std::size_t pairs = 0, holding = 0, needed = 0;
  double first_median = 0, second_median = 0, ratio_median = 0;  // over the pairs that finished
  [[nodiscard]] bool holds() const { return holding >= needed; }
};

/// InputError where a claim names what its runs do not measure, or asks for more pairs than there are.
void check_claims(const Experiment& experiment, const std::vector<ExperimentRun>& runs);

std::vector<Finding> findings_of(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                                 const std::vector<nlohmann::json>& summaries);

/// "constraint:max of lmm exceeds dirac's in 31 of 32 runs"
std::string in_words(const Finding& finding);
std::string findings_csv(const std::vector<Finding>& findings);
/// Lines for the terminal, at most 100 columns; empty without findings.
std::string findings_table(const std::vector<Finding>& findings);
nlohmann::json to_json(const Finding& finding);
/// One line on those that do not hold; empty where all do.
std::string failed_claims(const std::vector<Finding>& findings);

}  // namespace pfaff
