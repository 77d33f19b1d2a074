#include <pfaff/bench/runner/run_directory.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/row_file.hpp>
#include <pfaff/core/process/checksum.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
constexpr const char *config_name = "config.toml", *series_name = "series.csv",
                     *summary_name = "summary.json";
constexpr const char* checksum_key = "checksum";

std::string text_of(const nlohmann::json& summary) { return summary.dump(1) + "\n"; }

// The checksum of the three files, of the summary without the checksum itself. `series` is that of the second
// one.
std::string checksum(const std::string& config, const std::string& series, nlohmann::json summary) {
  summary.erase(checksum_key);
  return sha1_of(sha1_of(config) + series + sha1_of(text_of(summary)));
}

// The time of a row; 0 where there is none.
double time_of(std::string_view row) {
  double t = 0;
  (void)std::from_chars(row.data(), row.data() + row.size(), t);
  return t;
}

// What is known of a series from reading it once.
struct SeriesRead {
  std::int64_t rows = 0;  // behind the head
  double begin = 0, end = 0;
  std::string checksum;
};

// Nothing where there is no file that can be read.
std::optional<SeriesRead> read_series(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  SeriesRead read;
  RunningChecksum sum;
  std::int64_t lines = 0;
  for (std::string line; std::getline(file, line); ++lines) {
    if (lines > 0) read.end = time_of(line);
    if (lines == 1) read.begin = read.end;
    if (!file.eof()) line += '\n';
    sum.add(line);
  }
  if (file.bad()) return std::nullopt;
  read.rows = std::max<std::int64_t>(0, lines - 1);
  read.checksum = sum.digits();
  return read;
}

// How the series of a directory is longer than that of a run will be; empty where it is not.
std::string longer_than(const ResolvedRun& run, const SeriesRead& series) {
  const double lasts = std::abs(series.end - series.begin), asked = std::abs(run.time.value());
  const bool farther = lasts > asked * (1 + 1e-9), more = !run.adaptive() && series.rows > run.rows() + 1;
  if (!farther && !more) return {};
  return std::to_string(series.rows) + " rows to t = " + to_string(Quad(series.end), 10);
}

// The summary of a directory whose files belong together and are undamaged; null otherwise.
nlohmann::json verified_summary(const fs::path& directory, const std::string& config,
                                const std::optional<SeriesRead>& series) {
  const auto text = text_in(directory / summary_name);
  if (!series || !text) return nullptr;
  nlohmann::json summary = nlohmann::json::parse(*text, nullptr, false);
  if (!summary.is_object() || summary.value("schema", 0) != schema_of_runs ||
      !summary.contains(checksum_key) || text_of(summary) != *text)
    return nullptr;
  if (summary[checksum_key] != checksum(config, series->checksum, summary)) return nullptr;
  return summary;
}
}  // namespace

const std::vector<std::string>& run_file_names() {
  static const std::vector<std::string> names{config_name, series_name, summary_name};
  return names;
}

void refuse_files_of_others(const fs::path& directory, const ResolvedRun& run,
                            const std::vector<std::string>& ours, const std::string& expected) {
  std::error_code error;
  const auto other = std::find_if(ours.begin(), ours.end(), [&](const std::string& name) {
    return fs::exists(fs::symlink_status(directory / name, error));
  });
  if (other == ours.end()) return;
  if (const auto config = text_in(directory / config_name); config && config_text(run).starts_with(*config))
    return;  // the machine stopped while it was written
  try {
    (void)read_config((directory / config_name).string());
    return;
  } catch (const InputError&) {  // of systems that no file can name there are no settings
    const auto text = text_in(directory / summary_name);
    const nlohmann::json summary = nlohmann::json::parse(text.value_or(""), nullptr, false);
    if (summary.is_object() && summary.contains("schema")) return;
  }
  throw InputError(
      "output directory '" + directory.string() + "' holds " + *other +
      ", but neither a config.toml nor a summary.json of a run, as a run would leave them; expected " +
      expected);
}

RunFiles::RunFiles(fs::path directory, const ResolvedRun& run, std::vector<FileOfRun> beside)
    : directory_(std::move(directory)),
      beside_(std::move(beside)),
      series_(run, [this](std::string_view rows) { take(rows); }) {}

void RunFiles::take(std::string_view rows) {
  if (!rows_) {
    std::error_code error;
    fs::remove(directory_ / summary_name, error);
    for (const FileOfRun& file : beside_)
      if (file.text.empty()) {
        fs::remove(directory_ / file.name, error);
      } else {
        write_file(directory_ / file.name, file.text);
      }
    rows_.emplace(directory_ / series_name);
  }
  rows_->take(rows);
}

nlohmann::json RunFiles::finish(nlohmann::json summary) {
  series_.finish();
  rows_->finish();
  const auto config = std::find_if(beside_.begin(), beside_.end(),
                                   [](const FileOfRun& file) { return file.name == config_name; });
  summary[checksum_key] = checksum(config == beside_.end() ? "" : config->text, rows_->checksum(), summary);
  write_file(directory_ / summary_name, text_of(summary));
  return summary;
}

nlohmann::json write_run(const fs::path& directory, const ResolvedRun& run,
                         const ReferenceSolution* reference, const Progress& progress,
                         const std::atomic<bool>* stop) {
  RunFiles files(directory, run, {{config_name, config_text(run)}});
  return files.finish(summary(run, execute(run, reference, progress, stop, &files.series())));
}

KeptRun kept_run(const fs::path& directory, const ResolvedRun& run) {
  KeptRun kept;
  const auto config = text_in(directory / config_name);
  const auto series = read_series(directory / series_name);
  if (series) kept.longer = longer_than(run, *series);
  if (!config) return kept;
  try {
    const RunConfig read = read_config((directory / config_name).string());
    // Behind the settings there is nothing, or the tables of origins.
    const std::string settings = settings_text(run);
    kept.other = !(config->starts_with(settings) &&
                   (config->size() == settings.size() || config->compare(settings.size(), 2, "\n[") == 0));
    kept.changed = differences(read.origins, run.origins);
    kept.known = true;
  } catch (const InputError&) {
    return kept;  // a config.toml that cannot be read says nothing about the rest
  }
  nlohmann::json summary = verified_summary(directory, *config, series);
  kept.whole = !summary.is_null() && summary.value("status", "interrupted") != "interrupted";
  if (kept.whole) kept.summary = std::move(summary);
  return kept;
}

void refuse_to_replace(const KeptRun& kept, const fs::path& directory, const std::string& force) {
  const std::string where = "output directory '" + directory.string() + "' holds ",
                    longer = kept.longer.empty() ? "" : " that is longer, " + kept.longer;
  if (kept.other)
    throw InputError(where + "another run" + longer +
                     "; expected a new directory, an empty one, the settings of that run, or " + force +
                     " to replace it");
  if (!kept.known && !longer.empty())
    throw InputError(where + "a run" + longer +
                     ", of which no config.toml says what it is; expected a new directory, or " + force +
                     " to replace it");
  if (kept.outdated())
    throw InputError(where + "this run, but " + in_one_line(kept.changed) +
                     "; expected a new directory, or " + force + " to run it anew");
}

void check_undamaged(const fs::path& directory) {
  const std::string config = text_in(directory / config_name).value_or("");
  if (verified_summary(directory, config, read_series(directory / series_name)).is_null())
    throw InputError("'" + directory.string() +
                     "' holds files that are not as a run has left them, of which one was changed or cut; "
                     "expected the directory of a run, to be made anew");
}

}  // namespace pfaff
