// pfaff derive: equations of motion of a system, made by the library of studies.
#include <pfaff/app/command.hpp>
#include <pfaff/bench/studies/derivation_methods.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff::app {

namespace {

// In lines of which each fits beside the names of the options.
std::string methods_in_words() {
  std::string text;
  std::size_t length = 0;
  for (const DerivationMethod& method : derivation_methods()) {
    if (length > 0) text += length + method.name.size() > 60 ? ",\n" : ", ";
    length = length + method.name.size() > 60 ? method.name.size() : length + method.name.size() + 2;
    text += method.name;
  }
  return text;
}

std::string forms_in_words() {
  std::string text;
  for (const std::string& name : derivation_forms()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void add_derive(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "derive", "Equations of motion of a system, derived symbolically");
  auto options = std::make_shared<DerivationSettings>();
  auto set = std::make_shared<std::vector<std::string>>();
  sub->add_option("system", options->system, "Name of the system, or the file of one written as text")
      ->type_name("SYSTEM|FILE")
      ->required();
  sub->add_option("--method", options->method, "How they are derived, one of\n" + methods_in_words())
      ->type_name("NAME")
      ->required();
  sub->add_option("--emit", options->emit, "What is printed: " + forms_in_words())->type_name("NAME");
  sub->add_option("--set", *set,
                  "A parameter of the system (beads=12), friction-form=NAME,\norder=K of "
                  "generating-function, or elimination=NAME,NAME,...\nof the constraints in the recursions")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->callback([=, &common, &action] {
    action = [=, &common] {
      options->set = parse_settings(*set);
      return studies().derive(*options, common);
    };
  });
}

}  // namespace pfaff::app
