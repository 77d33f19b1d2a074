// pfaff cite NAME: prints the references of a plug-in or an experiment.
#include <algorithm>
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/description.hpp>
#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/runner/terminal.hpp>

namespace pfaff::app {

namespace {

// The keys of references.bib that are cited: the reference of a plug-in is a text with keys in it, that of an
// experiment a list of keys. InputError where a key is not there, and where a text holds none.
std::vector<std::string> keys_of(const nlohmann::json& described) {
  const std::string who = described["kind"].get<std::string>() + " " + described["name"].get<std::string>();
  const nlohmann::json& reference = described["reference"];
  if (!reference.is_array()) {
    std::vector<std::string> keys = keys_in(reference);
    if (keys.empty())
      throw InputError(who + ": its reference '" + reference.get<std::string>() +
                       "' holds no key of references.bib");
    return keys;
  }
  for (const auto& key : reference)
    if (bibtex(key).empty())
      throw InputError(who + ": " +
                       unknown_name("key of references.bib", key.get<std::string>(), citation_keys()));
  return reference;
}

int cite(const std::vector<std::string>& names, bool json) {
  nlohmann::json j{{"schema", 1}, {"entries", nlohmann::json::array()}};
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    std::vector<std::string> found;
    if (!bibtex(name).empty()) {
      found = {name};
    } else {
      found = keys_of(describe(name, citation_keys()).front());
    }
    for (const std::string& key : found)
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  for (const std::string& key : keys) {
    j["entries"].push_back({{"key", key}, {"citation", citation(key)}, {"bibtex", bibtex(key)}});
    if (!json) std::cout << bibtex(key) << '\n';
  }
  if (json) std::cout << json_text(j);
  return 0;
}

}  // namespace

void add_cite(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "cite", "BibTeX entries behind a plug-in, an experiment or a key");
  auto names = std::make_shared<std::vector<std::string>>();
  sub->add_option("name", *names, "Names, as in pfaff list, or keys of references.bib")
      ->type_name("NAME")
      ->required();
  sub->callback(
      [names, &common, &action] { action = [names, &common] { return cite(*names, common.json); }; });
}

}  // namespace pfaff::app
