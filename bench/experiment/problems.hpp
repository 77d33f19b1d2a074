// What is said of the problems of an experiment, the motions that its runs are compared with.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/json.hpp>

namespace pfaff {

/// A line for each reference solution that ends before its runs, for each problem in which something is said
/// to be conserved and is not, and for each case whose methods have friction of different forms.
std::string said_of_problems(const std::vector<ExperimentRun>& runs,
                             const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
