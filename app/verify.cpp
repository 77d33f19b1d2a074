// pfaff verify: every claim of every plug-in, counted per claim, system and precision.
#include <array>
#include <iostream>
#include <map>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/verification/check.hpp>

namespace pfaff::app {

namespace {

std::string scientific(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", x);
  return text.data();
}

std::string parameters_of(const Check& c) {
  std::string text;
  for (const auto& [key, value] : c.parameters) text += " " + key + "=" + value;
  return text;
}

struct Count {
  int passed = 0, failed = 0, measured = 0, rejected = 0;
  double worst = 0;
};

void print(const std::vector<Check>& checks) {
  // One row for a claim, a system and a precision.
  std::map<std::array<std::string, 3>, Count> counts;
  std::vector<std::array<std::string, 3>> order;
  std::vector<std::vector<std::string>> controls{{"control", "system", "measured", "claimed", "result"}};
  std::vector<std::vector<std::string>> failures;
  for (const Check& c : checks) {
    if (!good(c))
      failures.push_back({"  " + c.plugin + parameters_of(c), c.claim, c.system, c.precision,
                          "measured " + scientific(c.measured) + ", expected " + scientific(c.expected) +
                              " within " + scientific(c.tolerance) +
                              (c.reason.empty() ? "" : " (" + c.reason + ")")});
    if (c.control) {
      controls.push_back(
          {"  " + c.plugin + parameters_of(c) + ": " + c.claim, c.system, scientific(c.measured),
           c.claim.starts_with("order") ? scientific(c.expected) : "<= " + scientific(c.tolerance),
           std::string(to_string(c.result))});
      continue;
    }
    if (c.result == CheckResult::skipped && !c.in_scope) continue;
    const std::array<std::string, 3> key{c.claim, c.system, c.precision};
    const auto [where, added] = counts.try_emplace(key);
    if (added) order.push_back(key);
    Count& count = where->second;
    count.passed += c.result == CheckResult::pass;
    count.failed += c.result == CheckResult::fail;
    count.measured += c.result == CheckResult::measured;
    if (c.result == CheckResult::pass)
      count.worst = std::max(count.worst, c.claim == "order" ? c.expected - c.measured : c.measured);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a < b; });
  std::vector<std::vector<std::string>> rows{
      {"claim", "system", "precision", "pass", "fail", "outside", "worst in scope"}};
  for (const auto& key : order) {
    const Count& n = counts[key];
    rows.push_back({key[0], key[1].empty() ? "-" : key[1], key[2], std::to_string(n.passed),
                    std::to_string(n.failed), std::to_string(n.measured),
                    n.passed > 0 ? scientific(n.worst) : "-"});
  }
  std::cout << table(rows)
            << "(outside: out of the claim's scope, measured but not judged; worst of order: claimed less "
               "measured)\n";
  if (controls.size() > 1) {
    std::cout << "\ncontrols, false claims that must be rejected\n";
    // One line a plug-in and system is enough to read; every control is in --json.
    std::map<std::string, int> shown;
    std::vector<std::vector<std::string>> some{controls.front()};
    int rejected = 0;
    for (std::size_t k = 1; k < controls.size(); ++k) {
      rejected += controls[k][4] == "rejected";
      const std::string plugin = controls[k][0].substr(0, controls[k][0].find_first_of(" :", 2));
      if (shown[plugin]++ < 2 || controls[k][4] != "rejected") some.push_back(controls[k]);
    }
    std::cout << table(some) << rejected << " of " << controls.size() - 1 << " controls rejected\n";
  }
  if (!failures.empty()) std::cout << "\nfailed\n" << table(failures);
}

int run(const std::vector<std::string>& names, bool full, bool json) {
  std::vector<Check> checks;
  {
    ProgressLine line;
    checks = verify(names, full, [&](const std::string& what, std::size_t done, std::size_t all) {
      line.show(what, static_cast<double>(done) / static_cast<double>(all));
    });
  }
  std::map<std::string, int> totals{
      {"pass", 0}, {"fail", 0}, {"measured", 0}, {"rejected", 0}, {"skipped", 0}};
  bool ok = true;
  for (const Check& c : checks) {
    ++totals[std::string(to_string(c.result))];
    ok = ok && good(c);
  }
  if (json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Check& c : checks) list.push_back(to_json(c));
    std::cout << nlohmann::json{{"schema", 1}, {"ok", ok}, {"counts", totals}, {"checks", list}}.dump(1)
              << '\n';
  } else {
    print(checks);
    std::cout << '\n'
              << totals["pass"] << " pass, " << totals["fail"] << " fail, " << totals["measured"]
              << " measured outside their scope, "
              << (totals["skipped"] > 0 ? std::to_string(totals["skipped"]) + " skipped, " : "")
              << totals["rejected"] << " controls rejected: " << (ok ? "ok" : "NOT OK") << '\n';
  }
  return ok ? 0 : 1;
}

}  // namespace

void add_verify(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "verify", "Test every claim of every plug-in, in double and quad");
  auto names = std::make_shared<std::vector<std::string>>();
  auto full = std::make_shared<bool>(false);
  sub->add_option("name", *names, "Plug-ins, systems, brackets, integrators or controls; all without")
      ->type_name("NAME");
  sub->add_flag("--full", *full, "Higher orders and more variants");
  sub->callback([=, &common, &action] { action = [=, &common] { return run(*names, *full, common.json); }; });
}

}  // namespace pfaff::app
