// An evaluation for people: the tables of `pfaff evaluate`.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace pfaff::app {

/// What evaluation() found, in tables of at most 100 columns and six digits; every digit is in --json.
std::string evaluation_text(const nlohmann::json& j);

}  // namespace pfaff::app
