// pfaff reproduce: what is printed in a paper beside what is computed here, by the library of studies.
#include <pfaff/app/command.hpp>
#include <pfaff/bench/studies/papers.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff::app {

void add_reproduce(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "reproduce",
                             "Published values beside ours: reproduced, erratum or qualitative");
  add_quiet(*sub, common);
  auto options = std::make_shared<ReproductionOptions>();
  std::string known;
  for (const std::string& name : papers()) known += (known.empty() ? "" : ", ") + name;
  sub->add_option("paper", options->paper, known + "; all of them without")->type_name("PAPER");
  sub->add_option("--section", options->section, "One section only")->type_name("SECTION");
  sub->add_flag("--list", options->list, "What can be reproduced, without doing it");
  sub->add_flag("--coverage", options->coverage,
                "Which items of a paper have rows, and why others have none");
  sub->callback(
      [=, &common, &action] { action = [=, &common] { return studies().reproduce(*options, common); }; });
}

}  // namespace pfaff::app
