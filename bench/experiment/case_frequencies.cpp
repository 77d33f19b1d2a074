#include <pfaff/bench/experiment/case_frequencies.hpp>

namespace pfaff {

Assignments read_vectors(Keys& keys, const std::string& file) {
  std::string names, x, y, definitions;
  const std::vector<const toml::table*> tables = keys.tables("frequency", false);
  for (const toml::table* table : tables) {
    Keys f(*table, file + " [[case.frequency]]");
    const char* const begin = table == tables.front() ? "" : " | ";
    names += begin + f.required("name"), x += begin + f.required("x"), y += begin + f.required("y");
    definitions += begin;
    for (const auto& [name, expression] : f.assignments("let"))
      definitions.append(name).append(" = ").append(expression).append("; ");
    f.finish();
  }
  if (tables.empty()) return {};
  return {{"name", names}, {"x", x}, {"y", y}, {"let", definitions}};
}

std::shared_ptr<const MeasureInstance> frequencies_of(const ExperimentCase& one, const Real& time) {
  if (one.frequencies.empty()) return nullptr;
  Assignments settings = one.frequencies;
  settings.emplace_back("time", to_string(time));
  return measures().get("frequency", "measure").make(settings);
}

Real time_of_frequencies(const ExperimentCase& one, const std::vector<ExperimentRun>& runs,
                         const std::vector<nlohmann::json>& summaries) {
  Real most = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ResolvedRun& run = runs[k].resolved;
    if (runs[k].which != &one || runs[k].seed > 0 || run.adaptive() || summaries[k]["status"] != "converged")
      continue;
    const Real some = Real(1000) * run.step, time = some.value() < 0 ? -some : some,
               whole = run.backwards() ? -run.time : run.time, here = time < whole ? time : whole;
    if (here > most) most = here;
  }
  return most;
}

}  // namespace pfaff
