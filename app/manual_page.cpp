#include <pfaff/app/manual_page.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/registry/version.hpp>
#include <pfaff/runs/kinds.hpp>

namespace pfaff::app {

namespace {
// Text as it is: backslashes, hyphens that are to be copied, and marks that begin a request at a line's
// begin.
std::string plain(const std::string& text) {
  std::string shown;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    shown += shown.empty() ? "" : " ";
    for (const char c : word) {
      if (c == '\\') {
        shown += "\\e";
      } else if (c == '-') {
        shown += "\\-";
      } else if ((c == '.' || c == '\'') && shown.empty()) {
        shown += std::string("\\&") + c;
      } else {
        shown += c;
      }
    }
  }
  return shown;
}
std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

bool is_common(const CLI::App& app, const CLI::Option& option) {
  const std::string name = option.get_name();
  const auto commands = app.get_subcommands(nullptr);
  return option.nonpositional() && name != "--help" &&
         std::count_if(commands.begin(), commands.end(), [&](const CLI::App* sub) {
           return sub->get_option_no_throw(name) != nullptr;
         }) > static_cast<std::ptrdiff_t>(commands.size()) / 2;
}

void add_option(std::ostream& page, const CLI::Option& option) {
  const bool takes_value = option.get_items_expected_max() > 0;
  page << ".TP\n";
  if (option.nonpositional()) {
    std::string names;
    for (const std::string& name : option.get_snames())
      names += (names.empty() ? "" : ", ") + bold("-" + name);
    for (const std::string& name : option.get_lnames())
      names += (names.empty() ? "" : ", ") + bold("--" + name);
    page << names << (takes_value ? " " + italic(option.get_type_name()) : "") << '\n';
  } else {
    page << italic(option.get_name(true)) << " (" << plain(option.get_type_name()) << ")\n";
  }
  page << plain(option.get_description()) << ".\n";
}

void add_command(std::ostream& page, const CLI::App& app, const CLI::App& command) {
  page << ".SS " << bold("pfaff " + command.get_name());
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional())
      page << ' ' << (option->get_required() ? "" : "[") << italic(option->get_name(true))
           << (option->get_required() ? "" : "]") << (option->get_items_expected_max() > 1 ? " ..." : "");
  page << " [" << italic("OPTIONS") << "]\n" << plain(command.get_description()) << ".\n";
  for (const CLI::Option* option : command.get_options())
    if (option != command.get_help_ptr() && !is_common(app, *option)) add_option(page, *option);
}
}  // namespace

std::string manual_page(const CLI::App& app) {
  TextStream page;
  page << ".TH PFAFF 1 \"\" \"pfaff " << PFAFF_VERSION_TEXT << "\" \"User Commands\"\n"
       << ".SH NAME\npfaff \\- " << plain(app.get_description().substr(app.get_description().find(' ') + 1))
       << "\n.SH SYNOPSIS\n"
       << bold("pfaff") << ' ' << italic("COMMAND") << " [" << italic("OPTIONS") << "]\n"
       << ".SH DESCRIPTION\n"
          "Pfaff integrates mechanical systems with methods that keep their structure, and measures what "
          "drifts\n"
          "and what it costs.\nPlug\\-ins are "
       << kinds_in_words() << ", which\n"
       << bold("pfaff list") << " names and\n"
       << bold("pfaff describe") << " explains.\n.SH COMMANDS\n";
  const auto commands = app.get_subcommands(nullptr);
  for (const CLI::App* command : commands) add_command(page, app, *command);
  page << ".SH OPTIONS OF MOST COMMANDS\n.TP\n"
       << bold("-h") << ", " << bold("--help") << "\nWhat a command does and takes.\n";
  std::vector<std::string> seen;
  for (const CLI::App* command : commands)
    for (const CLI::Option* option : command->get_options())
      if (is_common(app, *option) && std::find(seen.begin(), seen.end(), option->get_name()) == seen.end()) {
        seen.push_back(option->get_name());
        add_option(page, *option);
      }
  page << ".SH EXIT STATUS\n.TP\n0\nAll went well.\n.TP\n1\nA check failed, or a run ended early.\n"
          ".TP\n2\nWrong usage or input; one line on standard error says what was expected.\n"
       << ".SH ENVIRONMENT\n.TP\n"
       << bold("PFAFF_PLUGIN_PATH")
       << "\nDirectories, separated by colons, whose shared objects are loaded as plug\\-ins.\n.TP\n"
       << bold("COLUMNS") << "\nThe columns that tables take, instead of the terminal's.\n"
       << ".SH EXAMPLES\n.nf\n"
       << plain("pfaff describe kepler") << '\n'
       << plain("pfaff run kepler gauss --step 0.05 --time 100 --out orbit") << '\n'
       << plain("pfaff compare damped-oscillator") << "\n.fi\n";
  return page.str();
}

}  // namespace pfaff::app
