// The commands of the program `pfaff`: each adds itself to the command line and does its work when chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff::app {

/// Options that every command takes.
struct Common {
  bool json = false;
  std::vector<std::string> plugins;
};

/// Sets the exit status of a command that did its work: 0, or 1 where a check failed or a run ended early.
using Action = std::function<int()>;

/// Adds a command's options; `action` is what runs when it is chosen.
void add_list(CLI::App& app, Common& common, Action& action);
void add_describe(CLI::App& app, Common& common, Action& action);
void add_cite(CLI::App& app, Common& common, Action& action);
void add_run(CLI::App& app, Common& common, Action& action);
void add_evaluate(CLI::App& app, Common& common, Action& action);
void add_compare(CLI::App& app, Common& common, Action& action);
void add_reproduce(CLI::App& app, Common& common, Action& action);
void add_verify(CLI::App& app, Common& common, Action& action);

/// A subcommand with the common options.
CLI::App* subcommand(CLI::App& app, Common& common, const std::string& name, const std::string& what);

/// "key=value" settings. InputError for text without '='.
Assignments parse_settings(const std::vector<std::string>& texts);

}  // namespace pfaff::app
