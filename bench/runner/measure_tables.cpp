#include <pfaff/bench/runner/measure_tables.hpp>

#include <algorithm>
#include <sstream>

#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/origins.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/runs/measuring.hpp>
#include <pfaff/runs/support/with_unit.hpp>

namespace pfaff {

namespace fs = std::filesystem;

Measures measures_asked_for(const std::vector<std::string>& texts) {
  Measures asked;
  for (const std::string& text : texts) {
    asked.push_back(measure_asked_for(text));
    const std::string& name = asked.back()->descriptor().name;
    if (std::count_if(asked.begin(), asked.end(),
                      [&](const auto& other) { return other->descriptor().name == name; }) > 1)
      throw InputError("measure '" + name + "' is asked for twice; expected it once");
  }
  return asked;
}

std::string refuses(const MeasureInstance& measure, const ResolvedRun& run) {
  if (run.adaptive())
    return measure.descriptor().name + " looks at steps of one size; expected --step instead of --tolerance";
  return measure.refuses(*run.model, *run.method);
}

namespace {
// What a table was made of: where all of this is as it was, so is the table.
nlohmann::json identity(const MeasureInstance& measure, const std::string& made_of) {
  Origins origins;
  add_origins(measures().get(measure.descriptor().name, "measure"), {}, origins);
  nlohmann::json j{{"schema", 2},
                   {"measure", measure.called()},
                   {"version", measure.descriptor().version},
                   {"run", made_of}};
  for (const auto& [path, build] : origins.plugins) j["plugins"][path] = build;
  return j;
}

fs::path file_of(const fs::path& directory, const MeasureInstance& measure, const char* extension) {
  return directory / measures_directory / (measure.descriptor().name + extension);
}

std::string text_of(const MeasureTable& table) {
  std::string text;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    text += (k == 0 ? "" : ",") + csv_quoted(with_unit(table.columns[k], table.units[k]));
  text += '\n';
  for (const std::string& line : table.lines) text += line + '\n';
  return text;
}

// The table that the directory holds; nullopt where it holds none that is whole and up to date.
std::optional<MeasureTable> kept_table(const fs::path& directory, const MeasureInstance& measure,
                                       const std::string& made_of) {
  const auto text = text_in(file_of(directory, measure, ".csv")),
             about = text_in(file_of(directory, measure, ".json"));
  if (!text || !about) return std::nullopt;
  nlohmann::json j = nlohmann::json::parse(*about, nullptr, false);
  if (!j.is_object() || j.value("table", "") != sha1_of(*text) || !j["columns"].is_array() ||
      !j["units"].is_array())
    return std::nullopt;
  MeasureTable table{j["columns"], j["units"], {}, j.value("ended", "")};
  for (const char* key : {"table", "columns", "units", "ended"}) j.erase(key);
  if (j != identity(measure, made_of)) return std::nullopt;
  std::istringstream lines(text->substr(text->find('\n') + 1));
  for (std::string line; std::getline(lines, line);) table.lines.push_back(line);
  return table;
}

// The table is written before what says that it is whole.
void leave(const fs::path& directory, const MeasureInstance& measure, const std::string& made_of,
           const MeasureTable& table) {
  std::error_code error;
  fs::create_directories(directory / measures_directory, error);
  fs::remove(file_of(directory, measure, ".json"), error);
  const std::string text = text_of(table);
  write_file(file_of(directory, measure, ".csv"), text);
  nlohmann::json j = identity(measure, made_of);
  j["table"] = sha1_of(text);
  j["columns"] = table.columns;
  j["units"] = table.units;
  if (!table.ended.empty()) j["ended"] = table.ended;
  write_file(file_of(directory, measure, ".json"), j.dump(1) + "\n");
}

// The time of a line, elapsed since the start.
template <class T>
std::string elapsed(std::int64_t step, const T& h) {
  return text_of(Cell(T(static_cast<double>(step)) * h), {.name = "t", .digits = 12});
}

template <class T>
std::vector<MeasureTable> measured_in(const ResolvedRun& run, const Measures& measures,
                                      const SharedSolution& solution) {
  std::vector<const MeasureInstance*> asked;
  for (const auto& measure : measures) asked.push_back(measure.get());
  const Integration<T> start(start_of<T>(run));
  std::vector<MeasureTable> tables;
  for (const MeasuredTable& measured : pfaff::measured(start, run.steps, asked, &solution)) {
    MeasureTable& table = tables.emplace_back();
    table.columns = {"t"}, table.units = {start.model()->time_unit()};
    table.ended = measured.ended;
    for (const Column& column : measured.columns)
      table.columns.push_back(column.name), table.units.push_back(column.unit);
    for (const MeasuredTable::Line& line : measured.lines) {
      std::string text = elapsed(line.step, start.step());
      for (std::size_t k = 0; k < line.cells.size(); ++k)
        text += "," + csv_quoted(text_of(line.cells[k], measured.columns[k]));
      table.lines.push_back(std::move(text));
    }
  }
  return tables;
}
}  // namespace

std::vector<MeasureTable> tables_of(const fs::path& directory, const ResolvedRun& run,
                                    const std::string& made_of, const Measures& measures,
                                    const SharedSolution& solution) {
  std::vector<MeasureTable> tables(measures.size());
  Measures missing;
  std::vector<std::size_t> places;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (auto kept = kept_table(directory, *measures[m], made_of)) {
      tables[m] = std::move(*kept);
    } else {
      missing.push_back(measures[m]);
      places.push_back(m);
    }
  }
  if (missing.empty()) return tables;
  std::vector<MeasureTable> made = run.settings.precision == Precision::quad
                                       ? measured_in<Quad>(run, missing, solution)
                                       : measured_in<double>(run, missing, solution);
  for (std::size_t k = 0; k < missing.size(); ++k) {
    leave(directory, *missing[k], made_of, made[k]);
    tables[places[k]] = std::move(made[k]);
  }
  return tables;
}

nlohmann::json description_of(const MeasureInstance& measure) {
  const MeasureDescriptor& d = measure.descriptor();
  nlohmann::json j{{"name", d.name},
                   {"measure", measure.called()},
                   {"title", d.title},
                   {"description", d.description},
                   {"reference", d.reference},
                   {"version", d.version},
                   {"view", d.over == Over::time ? "time" : "step"},
                   {"watches", nlohmann::json::array()},
                   {"file", std::string(measures_directory) + "/" + d.name + ".csv"}};
  for (const Claim claim : d.watches) j["watches"].push_back(to_string(claim));
  return j;
}

}  // namespace pfaff
