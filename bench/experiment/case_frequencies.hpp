// The vectors that a case names, whose frequencies are measured along its runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

/// The settings of the measure of the tables [[case.frequency]]; none without such tables. `file` is named
/// where they are refused.
Assignments read_vectors(Keys& keys, const std::string& file);

/// The measure of the vectors that a case names, which takes the time to be compared from all of its runs;
/// null where it names none.
std::shared_ptr<const MeasureInstance> frequencies_of(const ExperimentCase& one, const Real& time = 0);

/// The time for which the frequencies of a case are compared: that of a thousand of the largest steps with
/// which its runs have ended well, or the whole of these where it is shorter; 0 where there are none.
Real time_of_frequencies(const ExperimentCase& one, const std::vector<ExperimentRun>& runs,
                         const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
