// The tables of `pfaff evaluate`, which show an evaluation in the terminal.
#pragma once

#include <string>

#include <pfaff/bench/runner/json.hpp>

namespace pfaff::app {

/// The result of evaluation() as tables, with six digits; --json gives every digit.
std::string evaluation_text(const nlohmann::json& j);

}  // namespace pfaff::app
