// The directory of a run: config.toml, series.csv and summary.json, which are kept only where they belong
// together and to the run that is asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff {

/// The names of the files of a run.
const std::vector<std::string>& run_file_names();

/// Makes a run and leaves its files in an existing directory: config.toml and the rows of series.csv while it
/// goes, and summary.json when it has ended. That gets a key `checksum` of the contents of all three files,
/// so that a mixture of old and new files, or a damaged one, is noticed. Returns the summary as it is
/// written. RunError when the disk is full or not writable; the rows that were written by then stay.
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

}  // namespace pfaff
