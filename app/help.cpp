// pfaff help: the options of the program or of a command, and the manual page.
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/help_formatter.hpp>
#include <pfaff/app/manual_page.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff::app {

namespace {
struct HelpOptions {
  std::string command;
  bool manual = false;
};

int help(const CLI::App& app, const HelpOptions& options) {
  if (options.manual) {
    std::cout << manual_page(app);
    return 0;
  }
  if (options.command.empty()) {
    std::cout << help_of(app, app.get_name());
    return 0;
  }
  std::vector<std::string> commands;
  for (const CLI::App* sub : app.get_subcommands(nullptr)) {
    commands.push_back(sub->get_name());
    if (sub->get_name() != options.command) continue;
    std::cout << help_of(*sub, app.get_name() + " " + options.command);
    return 0;
  }
  throw InputError(unknown_name("command", options.command, commands));
}
}  // namespace

void add_help(CLI::App& app, Common& /*common*/, Action& action) {
  CLI::App* sub = app.add_subcommand("help", "What a command does and takes");
  sub->group("Commands");
  auto options = std::make_shared<HelpOptions>();
  CLI::Option* command =
      sub->add_option("command", options->command, "A command; without, all of them")->type_name("COMMAND");
  sub->add_flag("--man", options->manual, "The manual page, for man")->excludes(command);
  sub->callback([options, &app, &action] { action = [options, &app] { return help(app, *options); }; });
}

}  // namespace pfaff::app
