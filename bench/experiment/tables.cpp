#include <pfaff/bench/experiment/tables.hpp>

#include <algorithm>

#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/equal_cost.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/measured_runs.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

namespace {
nlohmann::json columns_in_json(const Columns& columns) {
  nlohmann::json list = nlohmann::json::array();
  for (const Column& column : columns)
    list.push_back({{"name", column.name},
                    {"unit", column.unit},
                    {"kind", column.kind == Column::Kind::number ? "number" : "text"}});
  return list;
}

// The tables of the measures that say something of a run.
void describe_measures(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                       nlohmann::json& tables) {
  for (const MeasureOfRuns& of : measures_of_runs(experiment, runs)) {
    nlohmann::json table = description_of(*of.measure);
    Columns columns = columns_before_measures(of.first->resolved.model->time_unit());
    for (const Column& key : columns) table["keys"].push_back(key.name);
    // What a table names first is what its rows belong to.
    bool names = true;
    for (const Column& column : of.columns) {
      names = names && column.kind == Column::Kind::text;
      if (names) table["keys"].push_back(column.name);
      columns.push_back(column);
    }
    table["columns"] = columns_in_json(columns);
    tables.push_back(std::move(table));
  }
}
}  // namespace

Columns columns_named(const std::vector<std::string>& names) {
  Columns columns;
  for (const std::string& name : names)
    if (name.ends_with('*')) {
      columns.push_back({.name = name.substr(0, name.size() - 1), .kind = Column::Kind::text});
    } else {
      columns.push_back({name});
    }
  return columns;
}

std::string head_of(const Columns& columns) {
  std::string text;
  for (const Column& column : columns) text += (text.empty() ? "" : ",") + csv_quoted(column.name);
  return text;
}

std::vector<TableQuantity> quantities_of(const std::vector<ExperimentRun>& runs) {
  std::vector<TableQuantity> quantities;
  const auto add = [&](const TableQuantity& quantity) {
    if (std::none_of(quantities.begin(), quantities.end(), [&](const TableQuantity& other) {
          return other.name == quantity.name && other.residual == quantity.residual;
        }))
      quantities.push_back(quantity);
  };
  for (const bool residual : {false, true})
    for (const ExperimentRun& run : runs) {
      const Model& model = *run.resolved.model;
      if (residual) {
        for (const std::string& name : constraint_residual_names(model))
          add({name, "", model.time_unit(), true});
      } else {
        for (const Invariant& i : model.invariants())
          if (i.behaviour != Behaviour::free) add({i.name, i.unit, model.time_unit(), false});
      }
    }
  return quantities;
}

void describe_tables(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                     nlohmann::json& description) {
  nlohmann::json& tables = description["tables"] = nlohmann::json::array();
  for (const auto& [file, rows, columns] : {std::tuple(results_file, "runs", results_columns(runs)),
                                            {costs_file, "timings of runs", cost_columns(runs)},
                                            {equal_cost_file, "runs at equal cost", equal_cost_columns(runs)},
                                            {ensembles_file, "spreads over seeds", ensemble_columns()},
                                            {findings_file, "claims of the experiment", finding_columns()}})
    tables.push_back({{"file", file}, {"rows", rows}, {"columns", columns_in_json(columns)}});
  describe_measures(experiment, runs, tables);
  for (const TableQuantity& quantity : quantities_of(runs))
    description["quantities"].push_back(
        {{"name", quantity.name}, {"unit", quantity.unit}, {"residual", quantity.residual}});
  for (const QuantityField& field : quantity_fields())
    if (field.column)
      description["fields"].push_back({{"name", field.name},
                                       {"unit", field.unit},
                                       {"meaning", field.meaning},
                                       {"residuals_alone", field.of == QuantityField::Of::residuals}});
}

}  // namespace pfaff
