// The config.toml of a run: everything that is needed to run it again, and what it was made from.
#pragma once

#include <string>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff {

/// The settings of a run as the text of a config.toml, with every value resolved and model files by their
/// absolute paths. It is the same for two runs exactly where their settings are.
std::string settings_text(const ResolvedRun& run);

/// The whole text of config.toml: the settings, then the files and builds that the run was made from.
std::string config_text(const ResolvedRun& run);

/// What a config.toml says.
struct RunConfig {
  RunSettings settings;
  Origins origins;  // each list is empty where the file has no such table, as when it is written by hand
};

/// Reads a config.toml. InputError for unknown keys and wrong types.
RunConfig read_config(const std::string& path);

}  // namespace pfaff
