// What is known about a plug-in or an experiment, as JSON.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

namespace pfaff::app {

/// Descriptions of everything named `name`, which may also be the file of a text model, a bracket or a table
/// of coefficients. A system and an experiment may share a name; the plug-in comes first. InputError where
/// there is none, with the nearest of all names and of `also_known`.
std::vector<nlohmann::json> describe(const std::string& name,
                                     const std::vector<std::string>& also_known = {});

}  // namespace pfaff::app
