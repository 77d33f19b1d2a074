// What is compared, as experiment.json says it: the identity of an experiment's directory.
#pragma once

#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// The content of experiment.json: the texts of the experiment, its cases and methods with their parameters
/// and claims, the drift classes, and versions. `runs` are those that the experiment expands to, one at least
/// of each case; `left_out` are the pairs of case and method that do not fit.
nlohmann::json description(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                           const std::vector<LeftOut>& left_out);

}  // namespace pfaff
