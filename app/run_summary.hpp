// What `pfaff run` says of a run in the terminal, from its summary.json.
#pragma once

#include <string>

#include <pfaff/bench/runner/json.hpp>
#include <pfaff/bench/runner/text_table.hpp>

namespace pfaff::app {

/// What is said of a reference solution that ends before the run.
std::string of_the_reference(const nlohmann::json& summary);

/// The summary as a table, with the rows of `tables`, and where it was `written` in the directory `out`.
std::string summary_table(const nlohmann::json& summary, const std::string& written, const std::string& out,
                          const TableRows& tables);

}  // namespace pfaff::app
