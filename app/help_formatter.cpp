#include <pfaff/app/help_formatter.hpp>

#include <algorithm>
#include <sstream>

#include <pfaff/bench/runner/text_table.hpp>

namespace pfaff::app {

namespace {
// A name beside what it means; the name has a line of its own where it is too long for its column.
std::string entry(const std::string& name, const std::string& meaning) {
  const std::size_t columns = terminal_columns(), left = std::min<std::size_t>(30, columns / 3);
  std::string text = facts({{"  " + name}}, columns);
  if (meaning.empty()) return text;
  bool beside = text.size() + 1 <= left;
  if (beside) text.pop_back();
  std::istringstream lines(paragraph(meaning, columns - left));
  for (std::string line; std::getline(lines, line); beside = false)
    text += std::string(beside ? left - text.size() : left, ' ') + line + '\n';
  return text;
}
}  // namespace

HelpFormatter::HelpFormatter() { label("SUBCOMMAND", "COMMAND"); }

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* sub) const {
  return entry(sub->get_name(), sub->get_description());
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return paragraph(app->get_description());
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string text;
  std::istringstream lines(app->get_footer());
  for (std::string line; std::getline(lines, line);) text += paragraph(line);
  return text;
}

std::string help_of(const CLI::App& app, const std::string& called) {
  return app.get_formatter()->make_help(&app, called, CLI::AppFormatMode::Normal);
}

}  // namespace pfaff::app
