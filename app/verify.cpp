// pfaff verify: the claims of plug-ins, checked by the library of studies.
#include <pfaff/app/command.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff::app {

void add_verify(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "verify", "Test the claims of plug-ins, in double and quad");
  add_quiet(*sub, common);
  auto settings = std::make_shared<VerificationSettings>();
  auto set = std::make_shared<std::vector<std::string>>();
  sub->add_option("name", settings->names, "Plug-ins, kinds of them (systems ...), or controls; all without")
      ->type_name("NAME");
  sub->add_flag("--full", settings->full, "Higher orders and more variants");
  sub->add_flag("--verbose", settings->verbose,
                "A row for each claim, system and precision, and all failures");
  sub->add_option("--set", *set, "A parameter of the one plug-in that is named")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      settings->set = parse_settings(*set);
      return studies().verify(*settings, common);
    };
  });
}

}  // namespace pfaff::app
