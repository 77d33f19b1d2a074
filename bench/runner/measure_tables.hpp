// The tables that measures leave in the directory of a run: measures/NAME.csv, with what it was made of
// beside it in measures/NAME.json.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/runs/measure.hpp>

namespace pfaff {

/// Measures, as they are asked for.
using Measures = std::vector<std::shared_ptr<const MeasureInstance>>;

/// The measures that texts name, NAME or NAME(key=value, …). InputError for one that is no measure, with the
/// nearest name, and where a name stands twice.
Measures measures_asked_for(const std::vector<std::string>& texts);

/// The folder of tables in the directory of a run, and in that of an experiment.
constexpr const char* measures_directory = "measures";

/// Why a measure says nothing of a run; empty where it does.
std::string refuses(const MeasureInstance& measure, const ResolvedRun& run);

/// The table of one run.
struct MeasureTable {
  std::vector<std::string> columns, units;  // names and units; the first is t
  std::vector<std::string> lines;           // the text of each row
  std::string ended;                        // why it ends before the run does; or empty
};

/// The tables of a run whose files have the checksum `made_of`, in the order of the measures, none of which
/// refuses it. Those that its directory holds are read, unless they were made of other files or by another
/// version, are cut or were edited; the others are made and left there. BudgetSpent passes. `solution` is
/// that of the run's problem.
std::vector<MeasureTable> tables_of(const std::filesystem::path& directory, const ResolvedRun& run,
                                    const std::string& made_of, const Measures& measures,
                                    const SharedSolution& solution);

/// What a report has to know of a measure: its name, title, description and the file of its table, as JSON.
nlohmann::json description_of(const MeasureInstance& measure);

}  // namespace pfaff
