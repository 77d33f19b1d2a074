#include <pfaff/bench/runner/run_directory.hpp>

#include <optional>

#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/process/checksum.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
constexpr const char *config_name = "config.toml", *series_name = "series.csv",
                     *summary_name = "summary.json";
constexpr const char* checksum_key = "checksum";

std::string text_of(const nlohmann::json& summary) { return summary.dump(1) + "\n"; }

// The checksum of the three files, of the summary without the checksum itself.
std::string checksum(const std::string& config, const std::string& series, nlohmann::json summary) {
  summary.erase(checksum_key);
  return sha1_of(sha1_of(config) + sha1_of(series) + sha1_of(text_of(summary)));
}

// The summary of a directory whose files belong together and are undamaged; null otherwise.
nlohmann::json verified_summary(const fs::path& directory, const std::string& config) {
  const auto series = text_in(directory / series_name), text = text_in(directory / summary_name);
  if (!series || !text) return nullptr;
  nlohmann::json summary = nlohmann::json::parse(*text, nullptr, false);
  if (!summary.is_object() || summary.value("schema", 0) != schema_of_runs ||
      !summary.contains(checksum_key) || text_of(summary) != *text)
    return nullptr;
  if (summary[checksum_key] != checksum(config, *series, summary)) return nullptr;
  return summary;
}
}  // namespace

const std::vector<std::string>& run_file_names() {
  static const std::vector<std::string> names{config_name, series_name, summary_name};
  return names;
}

nlohmann::json write_run(const fs::path& directory, const ResolvedRun& run, const RunRecord& record) {
  const std::string config = config_text(run), series = series_csv(run, record);
  nlohmann::json j = summary(run, record);
  j[checksum_key] = checksum(config, series, j);
  write_file(directory / config_name, config);
  write_file(directory / series_name, series);
  write_file(directory / summary_name, text_of(j));
  return j;
}

KeptRun kept_run(const fs::path& directory, const ResolvedRun& run) {
  KeptRun kept;
  const auto config = text_in(directory / config_name);
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
  nlohmann::json summary = verified_summary(directory, *config);
  kept.whole = !summary.is_null() && summary.value("status", "interrupted") != "interrupted";
  if (kept.whole) kept.summary = std::move(summary);
  return kept;
}

}  // namespace pfaff
