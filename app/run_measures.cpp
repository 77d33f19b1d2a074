#include <pfaff/app/run_measures.hpp>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/errors/budget.hpp>

namespace pfaff::app {

bool left_unmeasured(const nlohmann::json& summary) {
  return summary["status"] == "interrupted" || summary["completed"] == 0;
}

Measures fitting_measures(const std::vector<std::string>& texts, const std::string& out,
                          const ResolvedRun& resolved) {
  Measures measures = measures_asked_for(texts);
  if (!measures.empty() && out == "-")
    throw InputError("--measure: tables of measures go to the directory of the run; expected --out DIR");
  for (const auto& measure : measures)
    if (const std::string reason = refuses(*measure, resolved); !reason.empty())
      throw InputError("--measure: " + reason);
  return measures;
}

nlohmann::json tables_of_measures(const std::string& out, const ResolvedRun& resolved,
                                  const Measures& measures, const nlohmann::json& summary) {
  nlohmann::json list = nlohmann::json::array();
  if (measures.empty() || left_unmeasured(summary)) return list;
  ResolvedRun as_far = resolved;
  as_far.steps = summary["completed"];
  const Interruption interruption;
  const Budget budget({}, &Interruption::stop());
  std::vector<MeasureTable> tables;
  try {
    tables = tables_of(out, as_far, summary["checksum"], measures, *solution_of(as_far));
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped()) throw;
    throw RunError("interrupted while the run was measured; the run in '" + out + "' is complete");
  }
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const std::string& name = measures[m]->descriptor().name;
    list.push_back({{"name", name},
                    {"rows", tables[m].lines.size()},
                    {"file", out + "/" + measures_directory + "/" + name + ".csv"}});
    if (!tables[m].ended.empty()) list.back()["ended"] = tables[m].ended;
  }
  return list;
}

TableRows rows_on(const nlohmann::json& tables) {
  TableRows rows;
  for (const nlohmann::json& table : tables)
    rows.push_back(
        {table["name"],
         table["rows"].dump() + " rows in " + table["file"].get<std::string>() +
             (table.contains("ended") ? "; ended early: " + table["ended"].get<std::string>() : "")});
  return rows;
}

}  // namespace pfaff::app
