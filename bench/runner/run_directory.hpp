// The directory of a run: config.toml, series.csv and summary.json, which are kept only where they belong
// together and to the run that is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/bench/runner/row_file.hpp>

namespace pfaff {

/// The names of the files of a run.
const std::vector<std::string>& run_file_names();

/// A file that stands beside the series of a run, by its name; one without a text is removed.
struct FileOfRun {
  std::string name, text;
};

/// The files that a run leaves in an existing directory. What they replace stays until there are rows in its
/// place; then the summary goes first, which would speak of another series. RunError when the disk is full or
/// not writable.
class RunFiles {
 public:
  /// `beside`: config.toml, which may have no text where no file can name system and method, and others.
  RunFiles(std::filesystem::path directory, const ResolvedRun& run, std::vector<FileOfRun> beside);
  [[nodiscard]] SampleTaker& series() { return series_; }
  /// Writes the summary with a key `checksum` of the contents of config.toml, series.csv and itself, so that
  /// a mixture of old and new files, or a damaged one, is noticed. Returns it as it is written.
  nlohmann::json finish(nlohmann::json summary);

 private:
  void take(std::string_view rows);

  std::filesystem::path directory_;
  std::vector<FileOfRun> beside_;
  std::optional<RowFile> rows_;
  SeriesWriter series_;  // the last, since its end passes on rows that are left
};

/// Makes a run and leaves its files in an existing directory: config.toml and the rows of series.csv while it
/// goes, and summary.json when it has ended, which it returns as it is written. RunError when the disk is
/// full or not writable; the rows that were written by then stay.
nlohmann::json write_run(const std::filesystem::path& directory, const ResolvedRun& run,
                         const ReferenceSolution* reference, const Progress& progress = {},
                         const std::atomic<bool>* stop = nullptr);

/// What a directory holds of a run.
struct KeptRun {
  bool known = false;  // there is a config.toml that can be read
  bool whole = false;  // all files are as they were written, and the run was not interrupted
  bool other = false;  // its settings are other ones than those asked for
  std::string longer;  // where its series has more rows or reaches farther than the run will: how far
  std::vector<std::string> changed;  // what has changed of the files and builds it was made from
  nlohmann::json summary;            // of a whole run
  /// True where it is a run of the same settings, files and builds, whole or not.
  [[nodiscard]] bool same() const { return known && !other && changed.empty(); }
  /// True where the files are what the run would leave if it were made now.
  [[nodiscard]] bool current() const { return whole && same(); }
  /// True of a whole run of which a file or a build has changed since; with it settings may have, as the
  /// initial state that a model file states.
  [[nodiscard]] bool outdated() const { return whole && !changed.empty(); }
};

/// Refuses a directory that holds files of the names `ours`, but neither the settings nor the summary of a
/// run, nor the beginning of these settings: they are somebody else's. InputError, with what is expected,
/// such as "a new directory".
void refuse_files_of_others(const std::filesystem::path& directory, const ResolvedRun& run,
                            const std::vector<std::string>& ours, const std::string& expected);

/// Looks at what `directory` holds of the run. Nothing that is found in it is an error: what cannot be read
/// is not whole.
KeptRun kept_run(const std::filesystem::path& directory, const ResolvedRun& run);

/// Refuses to replace another run, a longer one, or one that has been made from files that have changed
/// since. InputError, which says by what that is done nevertheless, such as "--force".
void refuse_to_replace(const KeptRun& kept, const std::filesystem::path& directory, const std::string& force);

/// Refuses a directory whose files are not as a run has left them (InputError). A run that was interrupted
/// has left no summary, or one of the rows that there are.
void check_undamaged(const std::filesystem::path& directory);

}  // namespace pfaff
