// pfaff tune: a splitting made for one system, by the library of studies.
#include <pfaff/app/command.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff::app {

void add_tune(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub =
      subcommand(app, common, "tune", "A splitting made for one system, as a table of coefficients");
  add_quiet(*sub, common);
  auto options = std::make_shared<TuningOptions>();
  auto set = std::make_shared<std::vector<std::string>>();
  sub->add_option("system", options->system, "The system: its name, or the file of one written as text")
      ->type_name("SYSTEM|FILE")
      ->required();
  sub->add_option("--step", options->step, "The step that the method is tuned for")
      ->type_name("h")
      ->required();
  sub->add_option("--order", options->tuning.order, "2, 4 or 6; 4 without")->type_name("p");
  sub->add_option("--stages", options->tuning.stages, "Forces a step, 6 without")->type_name("s");
  sub->add_option(
         "--processor", options->tuning.processor,
         "Make a processed method, with so many kicks in its processor; --stages is then of the kernel")
      ->type_name("k");
  sub->add_option("--set", *set, "A parameter of the system (omega=2)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--beside", options->beside, "Other splittings, whose shadow terms are shown too")
      ->type_name("INTEGRATOR|FILE")
      ->expected(1)
      ->take_all();
  sub->add_option("--seed", options->tuning.seed, "Of the starts of the search, 1 without")->type_name("N");
  sub->add_option("--starts", options->tuning.starts, "How many starts, 60 without")
      ->type_name("N")
      ->check(positive_number());
  sub->add_option("--name", options->name, "Of the method, tuned-splitting without")->type_name("WORD");
  sub->add_option("--out", options->out, "Write the table into this file (.toml) and verify it")
      ->type_name("FILE");
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      options->set = parse_settings(*set);
      return studies().tune(*options, common);
    };
  });
}

}  // namespace pfaff::app
