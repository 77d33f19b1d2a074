// The tables of an experiment: the columns of each stand in one list, from which its file, the description in
// experiment.json and thereby the report are made.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/runs/measure_statement.hpp>

namespace pfaff {

inline constexpr const char *results_file = "results.csv", *costs_file = "cost.csv",
                            *equal_cost_file = "equal_cost.csv", *ensembles_file = "ensembles.csv",
                            *findings_file = "findings.csv";

using Columns = std::vector<Column>;

/// Columns of pure numbers, and of texts where a name has a * behind it.
Columns columns_named(const std::vector<std::string>& names);
/// The first line of a table, without its end.
std::string head_of(const Columns& columns);

/// The quantities of which results.csv has columns: invariants that are expected to stay or to go one way,
/// then residuals of constraints.
struct TableQuantity {
  std::string name, unit, time;  // units, of which that of times is time's
  bool residual;
};
std::vector<TableQuantity> quantities_of(const std::vector<ExperimentRun>& runs);

/// What experiment.json says of tables and quantities: `tables`, in which each has a file, what a row of it
/// stands for, its columns and, of those that are drawn by themselves, what over; `quantities`, and the
/// `fields` that each has as columns.
void describe_tables(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                     nlohmann::json& description);

}  // namespace pfaff
