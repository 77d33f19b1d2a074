// The commands of the program `pfaff`. Each adds its options to the command line and sets what is to be done
// when it is chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/studies/options.hpp>

namespace pfaff::app {

/// The work of a command. It returns the exit status: 0, or 1 where a check failed or a run ended early.
using Action = std::function<int()>;

/// Each adds one command with its options to `app`; when the command is chosen it sets `action` to its work.
void add_list(CLI::App& app, Common& common, Action& action);
void add_describe(CLI::App& app, Common& common, Action& action);
void add_cite(CLI::App& app, Common& common, Action& action);
void add_run(CLI::App& app, Common& common, Action& action);
void add_evaluate(CLI::App& app, Common& common, Action& action);
void add_compare(CLI::App& app, Common& common, Action& action);
void add_plot(CLI::App& app, Common& common, Action& action);
void add_reproduce(CLI::App& app, Common& common, Action& action);
void add_verify(CLI::App& app, Common& common, Action& action);
void add_falsify(CLI::App& app, Common& common, Action& action);
void add_derive(CLI::App& app, Common& common, Action& action);
void add_tune(CLI::App& app, Common& common, Action& action);
void add_help(CLI::App& app, Common& common, Action& action);
void add_completion(CLI::App& app, Common& common, Action& action);

/// A subcommand with the common options. What an option takes is declared by its type_name, which help, the
/// manual page and completion read: words in small letters between '|' are values as they stand, SYSTEM,
/// INTEGRATOR, FORMULATION, EXPERIMENT and NAME are names that `pfaff list` knows, FILE and DIR paths.
CLI::App* subcommand(CLI::App& app, Common& common, const std::string& name, const std::string& what);

/// The option --quiet, for commands that show progress and summaries.
void add_quiet(CLI::App& sub, Common& common);

/// Refuses what is no number above zero.
CLI::Validator positive_number();
/// Refuses what is no directory.
CLI::Validator existing_directory();

/// Ends a command whose output cannot be written: without a word where the reader of a pipe has what it
/// wanted
/// (`| head`), with a RunError otherwise.
void require_written_output();

/// Says on the standard error output, in a line, that systems and methods are not listed because their
/// library is missing; nothing where it is there.
void say_what_is_left_out();

/// The settings in texts "key=value". InputError for a text without '='.
Assignments parse_settings(const std::vector<std::string>& texts);

}  // namespace pfaff::app
