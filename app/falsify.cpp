// pfaff falsify: the smallest system on which a claim of a method fails, found by the library of studies.
#include <pfaff/app/command.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff::app {

void add_falsify(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "falsify", "Search for the smallest system on which a claim fails");
  add_quiet(*sub, common);
  auto options = std::make_shared<FalsificationOptions>();
  auto set = std::make_shared<std::vector<std::string>>();
  sub->add_option("method", options->method,
                  "Name of the integrator, or the file of a table of coefficients (.toml)")
      ->type_name("INTEGRATOR|FILE");
  sub->add_flag("--all", options->all, "Every claim of every integrator");
  sub->add_option("--claim", options->claim, "One claim, made or not; all that are made without")
      ->type_name("NAME");
  sub->add_option("--set", *set, "A parameter of the integrator (stages=2)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--seed", options->seed, "Of the random systems and parameters, 1 without")->type_name("N");
  sub->add_option("--budget", options->budget, "Seconds; 60 without, 300 with --all")
      ->type_name("SECONDS")
      ->check(positive_number());
  sub->add_option("--systems", options->systems, "At most so many random systems for each claim")
      ->type_name("N")
      ->check(positive_number());
  sub->add_option("--out", options->out, "Directory for the models of counterexamples, besides printing them")
      ->type_name("DIR")
      ->check(existing_directory());
  CLI::Option* system =
      sub->add_option("--system", options->system, "Judge the claim on this system, from its initial state")
          ->type_name("SYSTEM|FILE");
  sub->add_option("--step", options->step, "With --system: the step, 1/10 without")
      ->type_name("h")
      ->needs(system);
  sub->add_option("--steps", options->steps, "With --system: how many steps in a row, 1 without")
      ->type_name("N")
      ->check(positive_number())
      ->needs(system);
  sub->add_option("--at", options->at, "With --system: the time at which the step begins, 0 without")
      ->type_name("t")
      ->needs(system);
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      options->set = parse_settings(*set);
      return studies().falsify(*options, common);
    };
  });
}

}  // namespace pfaff::app
