#include <pfaff/bench/experiment/measured_runs.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <pfaff/bench/experiment/case_frequencies.hpp>
#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/parallel.hpp>

namespace pfaff {

namespace fs = std::filesystem;

Measures measures_of(const Experiment& experiment, const ExperimentCase& one) {
  Measures found;
  if (experiment.measures) {
    found = *experiment.measures;
  } else {
    for (const MeasurePlugin* measure : measures().all())
      if (measure->descriptor().usual) found.push_back(measure->make({}));
  }
  // The motion is looked at in the plane that the case names; of what is set twice the last counts.
  for (auto& measure : found) {
    if (measure->descriptor().name != "motion") continue;
    Assignments settings = measure->parameters();
    if (!one.motion.empty()) settings.insert(settings.end(), {{"x", one.motion[0]}, {"y", one.motion[1]}});
    if (!one.reference) settings.emplace_back("exact", "no");
    measure = measures().get("motion", "measure").make(settings);
  }
  if (auto vectors = frequencies_of(one)) {
    std::erase_if(
        found, [&](const auto& measure) { return measure->descriptor().name == vectors->descriptor().name; });
    found.push_back(std::move(vectors));
  }
  return found;
}

std::vector<const ExperimentRun*> measured_runs(const MeasureInstance& measure, const ExperimentCase& one,
                                                const std::vector<ExperimentRun>& runs,
                                                const std::vector<nlohmann::json>& summaries) {
  std::vector<const ExperimentRun*> found;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    if (run.which != &one || run.seed > 0 || summaries[k]["status"] != "converged" ||
        !refuses(measure, run.resolved).empty())
      continue;
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const ExperimentRun* other) { return other->method == run.method; });
    if (measure.descriptor().over == Over::step || same == found.end()) {
      found.push_back(&run);
    } else if (std::abs((*same)->resolved.step.value()) < std::abs(run.resolved.step.value())) {
      *same = &run;
    }
  }
  return found;
}

namespace {
// The cells of a line as they stand there, quoted or not.
std::vector<std::string> cells_in(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

// Adds the table of a run to the joined one. Where it has no column of a name the cell is empty.
void join(const ExperimentRun& run, const MeasureInstance& measure, const MeasureTable& table,
          MeasureTable& joined, std::string& notes) {
  const auto note = [&](const std::string& what) {
    notes += measure.descriptor().name + " of " + in_words(run) + " " + what + "\n";
  };
  if (!table.ended.empty()) note("ends early: " + table.ended);
  const std::string begin =
      csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," + csv_quoted(run.step);
  for (const std::string& line : table.lines) {
    const std::vector<std::string> cells = cells_in(line);
    std::string joined_line = begin;
    for (const std::string& name : joined.columns) {
      const auto place = std::find(table.columns.begin(), table.columns.end(), name);
      joined_line += ',';
      if (place != table.columns.end())
        joined_line += cells.at(static_cast<std::size_t>(place - table.columns.begin()));
    }
    joined.lines.push_back(std::move(joined_line));
  }
}

// Why a measure that was asked for says nothing of a case.
std::string why(const MeasureInstance& measure, const ExperimentCase& one,
                const std::vector<ExperimentRun>& runs) {
  if (one.seeds > 0) return ": its runs have seeds\n";
  std::string reason;
  for (const ExperimentRun& run : runs)
    if (run.which == &one) {
      const std::string of_run = refuses(measure, run.resolved);
      if (of_run.empty()) return ": no run of it ended well\n";
      if (reason.empty()) reason = of_run;
    }
  return ": " + reason + '\n';
}
}  // namespace

std::vector<MeasureOfRuns> measures_of_runs(const Experiment& experiment,
                                            const std::vector<ExperimentRun>& runs) {
  std::vector<MeasureOfRuns> found;
  for (const ExperimentRun& run : runs)
    for (const auto& measure : measures_of(experiment, *run.which)) {
      if (run.seed > 0 || !refuses(*measure, run.resolved).empty()) continue;
      const std::string& name = measure->descriptor().name;
      auto place = std::find_if(found.begin(), found.end(), [&](const MeasureOfRuns& one) {
        return one.measure->descriptor().name == name;
      });
      if (place == found.end()) place = found.insert(found.end(), {measure, &run, {}});
      Columns& columns = place->columns;
      for (const Column& column : measure->columns(*run.resolved.model))
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const Column& other) { return other.name == column.name; }))
          columns.push_back(column);
    }
  return found;
}

Columns columns_before_measures(const std::string& time_unit) {
  const auto& [one, method, step, t] = columns_of_the_run;
  return {{.name = one, .kind = Column::Kind::text},
          {.name = method, .kind = Column::Kind::text},
          {step, time_unit},
          {t, time_unit}};
}

void write_measures(const fs::path& directory, const Experiment& experiment,
                    const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
                    References& references, std::string& notes) {
  std::map<const ExperimentRun*, Measures> wanted;
  std::vector<std::string> names;  // of the tables
  for (const ExperimentCase& one : experiment.cases) {
    const Measures found = measures_of(experiment, one);
    for (auto measure : found) {
      const std::string& name = measure->descriptor().name;
      if (measure == found.back() && !one.frequencies.empty())
        measure = frequencies_of(one, time_of_frequencies(one, runs, summaries));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      const std::vector<const ExperimentRun*> fitting = measured_runs(*measure, one, runs, summaries);
      for (const ExperimentRun* run : fitting) wanted[run].push_back(measure);
      if (fitting.empty() && experiment.measures)
        notes += name + " of " + one.name + " is left out" + why(*measure, one, runs);
    }
  }
  std::vector<std::vector<MeasureTable>> tables(runs.size());
  in_parallel(runs.size(), [&](std::size_t k) {
    if (const auto found = wanted.find(&runs[k]); found != wanted.end())
      tables[k] =
          tables_of(directory / "runs" / runs[k].slug, runs[k].resolved,
                    summaries[k]["checksum"].get<std::string>(), found->second, references.problem(runs[k]));
  });
  std::error_code error;
  fs::remove_all(directory / measures_directory, error);
  const std::vector<MeasureOfRuns> measures = measures_of_runs(experiment, runs);
  for (const std::string& name : names) {
    MeasureTable joined;
    joined.columns = {"t"};
    for (const MeasureOfRuns& of : measures)
      if (of.measure->descriptor().name == name)
        for (const Column& column : of.columns) joined.columns.push_back(column.name);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const Measures& of_run = wanted[&runs[k]];
      for (std::size_t m = 0; m < of_run.size(); ++m)
        if (of_run[m]->descriptor().name == name) join(runs[k], *of_run[m], tables[k][m], joined, notes);
    }
    if (joined.lines.empty()) continue;
    Columns columns = columns_before_measures("");
    for (auto own = joined.columns.begin() + 1; own != joined.columns.end(); ++own) columns.push_back({*own});
    std::string text = head_of(columns);
    for (const std::string& line : joined.lines) text += "\n" + line;
    fs::create_directories(directory / measures_directory, error);
    write_file(directory / measures_directory / (name + ".csv"), text + "\n");
  }
  if (notes.empty()) return;
  fs::create_directories(directory / measures_directory, error);
  write_file(directory / measures_directory / "notes.txt", notes);
}

}  // namespace pfaff
