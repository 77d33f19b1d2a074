// pfaff evaluate: a system at one state and time.
#include <cstdlib>
#include <iostream>
#include <sstream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/state_file.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/runner/evaluation.hpp>

namespace pfaff::app {

namespace {

struct Options {
  RunSettings settings;
  std::vector<std::string> set;
  std::string state, time, precision, centre;
};

EvaluationSettings settings_of(const Options& options) {
  RunSettings run = options.settings;
  if (run.system.empty()) throw InputError("--system is missing (see pfaff list systems)");
  run.set = parse_settings(options.set);
  if (!options.state.empty()) {
    for (const auto& [key, value] : run.set)
      if (key == "initial") throw InputError("--state and --set initial exclude each other");
    run.t0.clear();
    read_state(options.state, run);
    if (!options.time.empty() && !run.t0.empty())
      throw InputError("--time and the t of " + options.state + " exclude each other");
    if (run.t0.empty()) run.t0 = "0";
  }
  if (!options.time.empty()) run.t0 = options.time;
  EvaluationSettings settings;
  if (!options.precision.empty()) settings.precision = parse_precision(options.precision);
  settings.at = resolve_state(run);
  if (!options.centre.empty()) {
    std::vector<std::string> texts;
    std::stringstream stream(options.centre + ',');  // so that nothing after the last comma is a number too
    for (std::string text; std::getline(stream, text, ',');) texts.push_back(text);
    settings.centre = state_numbers(*settings.at.model, texts, "centre");
  }
  return settings;
}

// Six digits; every digit is in --json.
std::string text_of(const nlohmann::json& value) {
  if (value.is_null()) return "-";
  const double x =
      value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : value.get<double>();
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x + 0.0);  // -0 is 0
  return text;
}

// "r - 0.5 p": a direction in the coordinates' names.
std::string combination(const nlohmann::json& direction, const nlohmann::json& names) {
  std::string text;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    std::string factor = text_of(direction[k]);
    if (factor == "0") continue;
    const bool negative = factor.front() == '-';
    if (negative) factor.erase(0, 1);
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    text += (factor == "1" ? "" : factor + " ") + names[k].get<std::string>();
  }
  return text;
}

// K as a matrix, or, where one would be too wide, its entries above the diagonal that are not zero.
void print_structure(const nlohmann::json& k, const nlohmann::json& names) {
  std::vector<std::vector<std::string>> rows;
  if (k.size() <= 6) {
    rows.push_back({"K"});
    for (const auto& name : names) rows[0].push_back(name);
    for (std::size_t i = 0; i < k.size(); ++i) {
      rows.push_back({names[i]});
      for (const auto& x : k[i]) rows.back().push_back(text_of(x));
    }
  } else {
    rows.push_back({"i", "j", "K_ij"});
    for (std::size_t i = 0; i < k.size(); ++i)
      for (std::size_t j = i + 1; j < k.size(); ++j)
        if (text_of(k[i][j]) != "0") rows.push_back({names[i], names[j], text_of(k[i][j])});
  }
  std::cout << '\n' << table(rows);
}

void print(const nlohmann::json& j) {
  const bool structured = j.contains("K");
  const auto& names = j["coordinates"];
  std::string parameters;
  for (const auto& [key, value] : j["parameters"].items())
    parameters += (parameters.empty() ? "" : ", ") + key + "=" + value.get<std::string>();
  std::vector<std::vector<std::string>> facts{{"system", j["system"]}};
  if (!parameters.empty()) facts.push_back({"parameters", parameters});
  facts.push_back({"t", text_of(j["t"])});
  facts.push_back({"status", j["status"]});
  for (const auto& [key, label] : {std::pair{"energy", "energy"}, std::pair{"energy_rate", "energy rate"}})
    if (!j[key].is_null()) facts.push_back({label, text_of(j[key])});
  if (structured) {
    facts.push_back({"class", j["class"]});
    const bool infinite = j["condition"].is_null();
    facts.push_back({"K", j["regular"]          ? "regular, condition " + text_of(j["condition"])
                          : j["kernel"].empty() ? "not finite"
                                                : "degenerate, condition " +
                                                      (infinite ? "infinite" : text_of(j["condition"]))});
    for (const auto& direction : j["kernel"])
      facts.push_back({"degenerate along", combination(direction, names)});
    facts.push_back({"self-adjoint", "skew to " + text_of(j["self_adjoint"]["skew"]) + ", closed to " +
                                         text_of(j["self_adjoint"]["closed"]) + ", time to " +
                                         text_of(j["self_adjoint"]["time"]) + " (relative)"});
    facts.push_back({"B", text_of(j["B"])});
    if (!j["centre"].is_null()) {
      std::string centre;
      for (const auto& x : j["centre"]) centre += (centre.empty() ? "" : ", ") + text_of(x);
      facts.push_back({"F and B", "from K and D about " + centre});
    }
  }
  std::cout << table(facts) << '\n';
  std::vector<std::vector<std::string>> rows{{"coordinate", "state", "rhs"}};
  if (structured)
    for (const char* label : {"D", "F", "F_t"}) rows[0].emplace_back(label);
  for (std::size_t k = 0; k < names.size(); ++k) {
    rows.push_back({names[k], text_of(j["state"][k]), j["rhs"].is_null() ? "-" : text_of(j["rhs"][k])});
    if (structured)
      for (const char* key : {"D", "F", "F_t"}) rows.back().push_back(text_of(j[key][k]));
  }
  std::cout << table(rows);
  if (structured) print_structure(j["K"], names);
}

}  // namespace

void add_evaluate(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "evaluate", "A system at one state: its field, energy, structure");
  auto options = std::make_shared<Options>();
  sub->add_option("--system", options->settings.system, "Name of the system")->type_name("NAME");
  sub->add_option("--formulation", options->settings.formulation,
                  "Of a system with constraints: its vector field (dirac without)")
      ->type_name("NAME");
  sub->add_option("--set", options->set, "A parameter (nu=0.3) or the state, initial=a,b,...")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub->add_option("--state", options->state, "JSON file with the state: t, and z or q and p")
      ->type_name("FILE");
  sub->add_option("--time", options->time, "The time, 0 without")->type_name("t");
  sub->add_option("--precision", options->precision, "double (default) or quad")->type_name("NAME");
  sub->add_option("--centre", options->centre, "F and B from K and D about this point: a,b,...")
      ->type_name("a,b,...");
  sub->callback([options, &common, &action] {
    action = [options, &common] {
      const nlohmann::json j = evaluation(settings_of(*options));
      if (common.json) {
        std::cout << j.dump(1) << '\n';
      } else {
        print(j);
      }
      return 0;
    };
  });
}

}  // namespace pfaff::app
