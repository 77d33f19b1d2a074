// The program `pfaff`.
//
// Exit status: 0 when all went well, 1 when a check failed or a run ended early, 2 for wrong usage or input.
// Only results go to stdout; an error is one line on stderr.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/heap.hpp>
#include <pfaff/app/help_formatter.hpp>
#include <pfaff/bench/runner/row_file.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/registry/version.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/text/source.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace pfaff::app {

CLI::App* subcommand(CLI::App& app, Common& common, const std::string& name, const std::string& what) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->group("Commands");
  sub->add_flag("--json", common.json, "Print JSON instead of text");
  sub->add_option("--plugin", common.plugins,
                  "Load a plug-in's shared object or a table (.toml); may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  return sub;
}

void add_quiet(CLI::App& sub, Common& common) {
  sub.add_flag("--quiet", common.quiet, "No progress and no summary: errors and the exit status say it")
      ->excludes("--json");
}

CLI::Validator positive_number() {
  return {[](const std::string& text) {
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool whole = error == std::errc() && end == text.data() + text.size();
            return whole && value > 0 ? std::string() : "expected a number > 0, got '" + text + "'";
          },
          ""};
}

CLI::Validator existing_directory() {
  return {[](const std::string& text) {
            return std::filesystem::is_directory(text)
                       ? std::string()
                       : "expected a directory that exists, got '" + text + "'";
          },
          ""};
}

void say_what_is_left_out() {
  if (const std::string& left_out = plugins_left_out(); !left_out.empty())
    std::cerr << printable("pfaff: not all systems and methods are shown: " + left_out) << '\n';
}

void require_written_output() {
  std::cout.flush();
  if (std::cout) return;
  pollfd out{STDOUT_FILENO, 0, 0};
  if (poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0) throw ReaderIsGone();
  throw RunError("cannot write to standard output");
}

Assignments parse_settings(const std::vector<std::string>& texts) {
  Assignments result;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError("--set: expected KEY=VALUE, got '" + text + "'");
    result.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return result;
}

namespace {

// Loads the shared objects given by --plugin, then every one in the directories of PFAFF_PLUGIN_PATH, and
// last the tables of coefficients given by --plugin, because a table may be based on a method of any of them.
void load_plugins(const Common& common) {
  for (const std::string& file : common.plugins)
    if (!file.ends_with(".toml")) load_plugin(file);
  const char* path = std::getenv("PFAFF_PLUGIN_PATH");
  std::stringstream directories(path != nullptr ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');) {
    if (directory.empty()) continue;
    std::error_code error;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(directory, error))
      if (entry.path().extension() == ".so") files.push_back(entry.path().string());
    if (error) throw InputError("PFAFF_PLUGIN_PATH: cannot read directory '" + directory + "'");
    std::sort(files.begin(), files.end());
    for (const std::string& file : files) load_plugin(file);
  }
  if (const auto twice = registered_twice(); !twice.empty())
    throw InputError("registered twice: " + twice.front());
  for (const std::string& file : common.plugins)
    if (file.ends_with(".toml")) (void)integrator_named(file);
}

// Says what is wrong in one line on stderr.
// A line is one write, which other processes that write there do not break.
void complain(std::string_view text) { std::cerr << "pfaff: " + printable(on_one_line(text)) + "\n"; }

// CLI11 takes what follows an option for its value even where that is an option itself: `--out -h` would
// write to a directory of this name. Says so; empty where no option stands in the place of a value.
std::string missing_value(const CLI::App& app, int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  const auto named = app.get_subcommands([&](const CLI::App* one) { return one->get_name() == command; });
  if (named.empty()) return {};
  const CLI::App* sub = named.front();
  for (int k = 2; k + 1 < argc && argv[k] != std::string("--"); ++k) {
    const std::string name = argv[k], next = argv[k + 1];
    const CLI::Option* option = name.starts_with("--") ? sub->get_option_no_throw(name) : nullptr;
    if (option == nullptr || option->get_items_expected_min() == 0) continue;
    if (next == "--" || (next.size() > 1 && next[0] == '-' && sub->get_option_no_throw(next) != nullptr))
      return name + ": expected a value, " + option->get_type_name() + ", got the option '" + next + "' (" +
             name + "=" + next + " takes it as the value)";
    ++k;
  }
  return {};
}

// True of options that other programs have for what Pfaff does not do yet. The build takes them, between
// blanks, from the table of docs/not-yet.md.
bool wanted_elsewhere(const std::string& option) {
  return std::string_view(PFAFF_NOT_YET).find(" " + option + " ") != std::string_view::npos;
}

// CLI11's error in the form of our messages, with the nearest command or option named.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  std::vector<std::string> commands;
  for (const CLI::App* sub : app.get_subcommands(nullptr)) commands.push_back(sub->get_name());
  const std::string command = argc > 1 ? argv[1] : "";
  if (command.empty() || command[0] == '-') {
    std::string text = command.empty() ? "a command is missing; expected one of: "
                                       : "expected a command before '" + command + "', one of: ";
    for (std::size_t k = 0; k < commands.size(); ++k) text += (k == 0 ? "" : ", ") + commands[k];
    return text + " (see pfaff --help)";
  }
  if (std::find(commands.begin(), commands.end(), command) == commands.end())
    return unknown_name("command", command, commands);
  // Where an option is unknown, the message is about that one, because it also explains why others are
  // missing. Values of options are not looked at, nor is anything after `--`.
  const CLI::App& sub = *app.get_subcommand(command);
  std::vector<std::string> options;
  for (const CLI::Option* option : sub.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (int k = 2; k < argc && argv[k] != std::string("--"); ++k) {
    const std::string argument = argv[k];
    const std::string name = argument.substr(0, argument.find('='));
    if (!name.starts_with("--")) continue;
    const CLI::Option* option = sub.get_option_no_throw(name);
    if (option == nullptr && wanted_elsewhere(name))
      return name + ": Pfaff does not do this yet; docs/not-yet.md says what to do instead";
    if (option == nullptr) return unknown_name("option", name, options) + " (of pfaff " + command + ")";
    if (option->get_items_expected_min() > 0 && name == argument) ++k;
  }
  // CLI11 names the first that is missing alone.
  std::string missing;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    for (const CLI::Option* option : sub.get_options())
      if (option->get_required() && option->count() == 0)
        missing += (missing.empty() ? "" : ", ") + option->get_name();
  return (missing.empty() ? std::string(error.what()) : "missing: " + missing) + " (see pfaff " + command +
         " --help)";
}

// Does the work and sees to it that all of its output was written; the exit status. Whatever is thrown ends
// here, in one line.
int run(const Action& work) {
  try {
    const int status = work();
    require_written_output();
    return status;
  } catch (const ReaderIsGone&) {
    return 0;
  } catch (const text::TextError& error) {
    complain(error.what());
    if (!error.excerpt().empty()) std::cerr << error.excerpt() << '\n';
    return 2;
  } catch (const InputError& error) {
    complain(error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
    return 1;
  } catch (const BudgetSpent& spent) {
    complain(spent.stopped() ? "interrupted before anything was made" : spent.what());
    return 1;
  } catch (...) {
    complain(words_of_current_exception());
    return 1;
  }
}

int run(int argc, char** argv) {
  // When the reader of stdout closes its end early, the write fails and the work ends
  // (require_written_output); without this the signal would end the program in the middle of it.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // likewise where a file becomes longer than it may be
  CLI::App app{"Pfaff: structure-preserving integration, what drifts and what it costs", "pfaff"};
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", std::string("pfaff ") + PFAFF_VERSION_TEXT);
  app.require_subcommand(1);
  Common common;
  Action action;
  add_list(app, common, action);
  add_describe(app, common, action);
  add_cite(app, common, action);
  add_run(app, common, action);
  add_evaluate(app, common, action);
  add_compare(app, common, action);
  add_plot(app, common, action);
  add_reproduce(app, common, action);
  add_verify(app, common, action);
  add_falsify(app, common, action);
  add_derive(app, common, action);
  add_tune(app, common, action);
  add_help(app, common, action);
  add_completion(app, common, action);
  app.footer(
      "pfaff help COMMAND shows the options of a command.\n"
      "Exit status: 0 fine, 1 a check failed or a run ended early, 2 wrong usage or input.");
  if (const std::string missing = missing_value(app, argc, argv); !missing.empty()) {
    complain(missing);
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    if (const std::string missing = missing_value(app, argc, argv); !missing.empty()) {
      complain(missing);
      return 2;
    }
    action = [&] { return app.exit(success); };
    return run(action);
  } catch (const CLI::ParseError& error) {
    complain(usage_error(app, error, argc, argv));
    return 2;
  }
  return run([&] {
    load_plugins(common);
    return action();
  });
}

}  // namespace
}  // namespace pfaff::app

int main(int argc, char** argv) {
  pfaff::app::use_large_pages();
  return pfaff::app::run(argc, argv);
}
