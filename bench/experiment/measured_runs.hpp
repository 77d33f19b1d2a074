// What measures say of the runs of an experiment: a table for each measure, joined of those of the runs.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/references.hpp>
#include <pfaff/bench/experiment/tables.hpp>

namespace pfaff {

/// The measures of a case of an experiment: those that the experiment names, or without a list all that say
/// they are usual, and that of the vectors of the case.
Measures measures_of(const Experiment& experiment, const ExperimentCase& one);

/// The runs of a case of which a measure has a table: none of one with seeds, and of measures over time each
/// method at the largest step at which its run has ended well, of others each run that has.
std::vector<const ExperimentRun*> measured_runs(const MeasureInstance& measure, const ExperimentCase& one,
                                                const std::vector<ExperimentRun>& runs,
                                                const std::vector<nlohmann::json>& summaries);

/// A measure that says something of a run, the first such run, and the columns of its joined table.
struct MeasureOfRuns {
  std::shared_ptr<const MeasureInstance> measure;
  const ExperimentRun* first;
  Columns columns;
};
/// The measures of an experiment, in the order in which runs have them. Their columns are those of all runs:
/// what only other systems have than that of the first, as quantities of theirs, follows.
std::vector<MeasureOfRuns> measures_of_runs(const Experiment& experiment,
                                            const std::vector<ExperimentRun>& runs);

/// The columns of a joined table before those of its measure; the elapsed time is the last of them.
Columns columns_before_measures(const std::string& time_unit);

/// Makes the tables of the runs that are not there yet, several at a time, and writes measures/NAME.csv of
/// each measure that says something of a run.
/// Why a table ends early, or a measure that was asked for says nothing of a case, is a line of `notes`,
/// which also go to measures/notes.txt.
void write_measures(const std::filesystem::path& directory, const Experiment& experiment,
                    const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                    References& references, std::string& notes);

}  // namespace pfaff
