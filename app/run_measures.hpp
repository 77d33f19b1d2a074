// The measures of `pfaff run`: which are asked for, and what is said of the tables that they leave.
#pragma once

#include <string>
#include <vector>

#include <pfaff/app/run_summary.hpp>
#include <pfaff/bench/runner/measure_tables.hpp>

namespace pfaff::app {

/// The measures that texts name, for a run that goes to `out`. InputError where one does not fit it.
Measures fitting_measures(const std::vector<std::string>& texts, const std::string& out,
                          const ResolvedRun& resolved);

/// True of a run, by its summary, of which measures have nothing to say, or of which nobody waits for what
/// they say.
bool left_unmeasured(const nlohmann::json& summary);

/// Makes the tables of measures in the directory of a run, as far as it came, and says of each its name,
/// rows, file, and why it ended early. RunError where it is interrupted.
nlohmann::json tables_of_measures(const std::string& out, const ResolvedRun& resolved,
                                  const Measures& measures, const nlohmann::json& summary);

/// A row of words for each of these tables.
TableRows rows_on(const nlohmann::json& tables);

}  // namespace pfaff::app
