// Methods that an experiment takes from the registry, by what they need, keep and claim.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

/// Reads the key `methods` of an experiment: "all", or a table with the keys keeps, needs, order and set.
/// `where` names the file.
MethodSelection read_selection(Keys& keys, const std::string& where);

/// Every registered method at every point of the selection's grid, of which it gets the parameters that it
/// has.
std::vector<ExperimentMethod> selected_methods(const MethodSelection& selection);

/// Why the selection leaves a method out of a case with this system; empty where it takes it.
std::string reason_to_leave_out(const MethodSelection& selection, const ExperimentMethod& method,
                                const ExperimentCase& of, const std::shared_ptr<const Model>& system);

}  // namespace pfaff
