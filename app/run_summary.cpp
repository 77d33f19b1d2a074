#include <pfaff/app/run_summary.hpp>

#include <cmath>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/bench/runner/terminal.hpp>

namespace pfaff::app {

std::string of_the_reference(const nlohmann::json& j) {
  return (j["error_max"].is_null() ? "no reference: " : "errors end early: ") +
         j["reference_ended"].get<std::string>();
}

namespace {
// At how many rows errors are measured, where these are not all to which the reference solution reaches.
std::string rows_with_errors(const nlohmann::json& j) {
  if (!j.contains("error_rows")) return {};
  const nlohmann::json& rows = j["error_rows"];
  return ", at " + rows["measured"].dump() + " of " + rows["of"].dump() + " rows";
}
}  // namespace

std::string summary_table(const nlohmann::json& j, const std::string& written, const std::string& out,
                          const TableRows& tables) {
  const auto number = [&](const nlohmann::json& x) {
    return x.is_number() && std::isfinite(x.get<double>()) ? scientific(x.get<double>()) : "not finite";
  };
  std::vector<std::vector<std::string>> rows{
      {"status", j["status"].get<std::string>() + " after " +
                     std::to_string(j["completed"].get<std::int64_t>()) + " steps"}};
  if (!j["error_max"].is_null())
    rows.push_back({"error", "max " + number(j["error_max"]) + ", final " + number(j["error_final"]) +
                                 rows_with_errors(j)});
  if (j.contains("reference_ended")) rows.push_back({"reference", of_the_reference(j)});
  const int failures = j.value("structure_failures", 0);
  if (!j["structure_residual"].is_null() || failures > 0)
    rows.push_back({"structure", "residual " + number(j["structure_residual"]) +
                                     (failures > 0 ? ", not finite at " + std::to_string(failures) +
                                                         (failures == 1 ? " sample" : " samples")
                                                   : "")});
  for (const auto& i : j["invariants"])
    if (i.contains("max"))
      rows.push_back({i["name"], "drift max " + number(i["max"]) + ", rms " + number(i["rms"]) + ", slope " +
                                     number(i["slope"]) + ", " + i["class"].get<std::string>()});
    else if (const auto setback = setback_in(i))
      rows.push_back({i["name"], "largest " + setback->move + " " + number(setback->size) + ", expected to " +
                                     setback->expected});
  if (j.contains("constraints"))
    for (const auto& c : j["constraints"])
      rows.push_back({c["name"], "residual max " + number(c["max"]) + ", final " + number(c["final"]) + ", " +
                                     c["class"].get<std::string>()});
  if (j.contains("projected_initial"))
    rows.push_back(
        {"initial", "moved onto the constraints, relative change " + number(j["projected_initial"])});
  if (j.contains("redundant_constraints")) {
    std::string names;
    for (const auto& name : j["redundant_constraints"])
      names += (names.empty() ? "" : ", ") + name.get<std::string>();
    rows.push_back(
        {"redundant", names + (j["redundant_constraints"].size() == 1
                                   ? ", which follows from the other constraints, has no reaction"
                                   : ", which follow from the other constraints, have no reactions")});
  }
  rows.insert(rows.end(), tables.begin(), tables.end());
  rows.push_back({written, out + "/{config.toml, series.csv, summary.json}"});
  return facts(rows);
}

}  // namespace pfaff::app
