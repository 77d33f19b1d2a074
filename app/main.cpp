// The program `pfaff`.
//
// Exit status: 0 fine, 1 a check failed or a run ended early, 2 wrong usage or input. Nothing but the result
// goes to stdout; errors are one line on stderr.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

#include <pfaff/app/command.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/version.hpp>

namespace pfaff::app {

CLI::App* subcommand(CLI::App& app, Common& common, const std::string& name, const std::string& what) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->group("Commands");
  sub->add_flag("--json", common.json, "Print JSON instead of text");
  sub->add_option("--plugin", common.plugins, "Load a plug-in's shared object; may be repeated")
      ->type_name("FILE");
  return sub;
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

// --plugin files, then every shared object in the directories of PFAFF_PLUGIN_PATH.
void load_plugins(const Common& common) {
  for (const std::string& file : common.plugins) load_plugin(file);
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
  for (const auto* names : {&systems().duplicates(), &integrators().duplicates(), &brackets().duplicates()})
    if (!names->empty()) throw InputError("registered twice: " + names->front());
}

// CLI11's complaint in our form: the nearest command or option named.
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
  // An option that is not known explains whatever else is missing. Values of options do not count, nor does
  // what follows `--`.
  const CLI::App& sub = *app.get_subcommand(command);
  std::vector<std::string> options;
  for (const CLI::Option* option : sub.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (int k = 2; k < argc && argv[k] != std::string("--"); ++k) {
    const std::string argument = argv[k];
    const std::string name = argument.substr(0, argument.find('='));
    if (!name.starts_with("--")) continue;
    const CLI::Option* option = sub.get_option_no_throw(name);
    if (option == nullptr) return unknown_name("option", name, options) + " (of pfaff " + command + ")";
    if (option->get_items_expected_min() > 0 && name == argument) ++k;
  }
  std::string text = error.what();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text + " (see pfaff " + command + " --help)";
}

int run(int argc, char** argv) {
  // A reader that closes its end early is an error to report, not a reason to die of.
  std::signal(SIGPIPE, SIG_IGN);
  CLI::App app{"Pfaff: structure-preserving integration, what drifts and what it costs", "pfaff"};
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
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
  add_reproduce(app, common, action);
  add_verify(app, common, action);
  app.footer(
      "pfaff COMMAND --help shows the options of a command.\n"
      "Exit status: 0 fine, 1 a check failed or a run ended early, 2 wrong usage or input.\n");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::cerr << "pfaff: " << usage_error(app, error, argc, argv) << '\n';
    return 2;
  }
  try {
    load_plugins(common);
    const int status = action();
    std::cout.flush();
    if (!std::cout) throw RunError("cannot write to standard output");
    return status;
  } catch (const InputError& error) {
    std::cerr << "pfaff: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "pfaff: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace
}  // namespace pfaff::app

int main(int argc, char** argv) { return pfaff::app::run(argc, argv); }
