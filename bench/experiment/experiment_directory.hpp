// The directory of an experiment: who works in it, and what in it is made of its runs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/bench/runner/json.hpp>

namespace pfaff {

/// The file that says which experiment a directory holds.
constexpr const char* experiment_file = "experiment.json";

/// Takes the directory of an experiment, a new one or one that holds an experiment, for `work`. InputError as
/// take_output_directory gives it.
std::unique_ptr<DirectoryLock> take_experiment_directory(const std::filesystem::path& directory,
                                                         const std::string& work);

/// Takes the experiment that the directory of a run stands in; null where it stands in none. An experiment
/// makes its runs anew without a look at the locks of each, so that who works on one run holds both.
std::unique_ptr<DirectoryLock> take_experiment_of(const std::filesystem::path& run, const std::string& work);

/// Refuses the directory where the experiment that it holds, as it describes itself, is another one than
/// `mine`. One of the same name is let pass where `force` says that it may be replaced.
void refuse_another_experiment(const std::filesystem::path& directory, const nlohmann::json& theirs,
                               const nlohmann::json& mine, bool force);

/// Removes what was put together from several runs or their timings, of which some are about to change, so
/// that nothing of it is left beside what is made anew: tables, figures, and the report.
void remove_derived(const std::filesystem::path& directory);

}  // namespace pfaff
