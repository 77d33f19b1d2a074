// Runs at equal cost: every method of a case at a step (or tolerance) at which its run takes the same time.
#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include <pfaff/bench/experiment/references.hpp>
#include <pfaff/bench/experiment/tables.hpp>

namespace pfaff {

/// A run as the choice of steps sees it.
struct PricedRun {
  double size = 0;   // its step or tolerance
  double cost = 0;   // ns
  double error = 0;  // not a number where there is none
};
/// The runs of a method, from the coarsest to the finest.
using PricedRuns = std::vector<PricedRun>;

/// Charges no run more than a finer one: a timing that says so was disturbed.
void settle(PricedRuns& runs);

/// The cost at which methods are compared: of 1, 2, 5 times a power of ten the one that the runs of most
/// methods span; of several the nearest to the least cost at which a method reaches the error 1e-6, or to the
/// middle of all costs where none does. 0 where there is none that two methods span.
double cost_level(const std::vector<PricedRuns>& methods);

/// The step or tolerance at which a method costs `level`, straight between its runs in logarithms; 0 where
/// its runs do not span that.
double size_at_cost(const PricedRuns& runs, double level);

/// Gives runs directories of their own. Names of cases and methods that differ in other signs than letters
/// and digits make one name of a directory; each of the runs that would share one gets the beginning of a
/// checksum of its settings behind it. Only what is the same run, as of two cases that differ in their lists
/// of steps alone, has one directory.
void tell_apart(std::vector<ExperimentRun>& runs);

/// The columns of equal_cost.csv.
Columns equal_cost_columns(const std::vector<ExperimentRun>& runs);

/// Chooses, from the timings of cost.csv, a level for each case without seeds and the step of each method
/// there, makes the runs that `directory` does not hold, under equal-cost/, and writes equal_cost.csv: the
/// columns of results.csv after the level in nanoseconds. Both follow from timings and differ from machine to
/// machine. Where it is asked to stop before everything is there, what is whole stays.
void write_equal_cost(const std::filesystem::path& directory, const Experiment& experiment,
                      const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                      References& references, const ExperimentProgress& progress);

}  // namespace pfaff
