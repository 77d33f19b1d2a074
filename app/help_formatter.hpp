// How `--help` and `pfaff help` are laid out: CLI11's texts in two columns that fit the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pfaff::app {

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();
  [[nodiscard]] std::string make_option(const CLI::Option* option, bool is_positional) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* sub) const override;
  [[nodiscard]] std::string make_description(const CLI::App* app) const override;
  [[nodiscard]] std::string make_footer(const CLI::App* app) const override;
};

/// The help of the program or of one of its commands, which `called` names as in "pfaff run".
std::string help_of(const CLI::App& app, const std::string& called);

}  // namespace pfaff::app
