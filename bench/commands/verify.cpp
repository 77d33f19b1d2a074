// The command verify: checks the claims of plug-ins and shows how many checks passed for each claim, system
// and precision.
#include <array>
#include <cmath>
#include <iostream>
#include <map>

#include <pfaff/bench/commands/commands.hpp>
#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/bench/verification/check_budget.hpp>

namespace pfaff {

namespace {

struct Count {
  int passed = 0, failed = 0, measured = 0;
  double worst = 0, outside = 0;  // the largest values in scope and outside
};

// What counts as large: of an order, how far it falls short of the claim.
void note(double& worst, const Check& c) {
  const double size = c.claim == "order" ? c.expected - c.measured : c.measured;
  worst = std::isnan(size) || std::isnan(worst) ? NAN : std::max(worst, size);
}

void print(const std::vector<Check>& checks) {
  // The table has one row for each claim, system and precision.
  std::map<std::array<std::string, 3>, Count> counts;
  std::vector<std::array<std::string, 3>> order;
  std::vector<std::vector<std::string>> controls{{"control", "system", "measured", "claimed", "result"}};
  std::vector<std::vector<std::string>> failures{{"  plug-in", "claim", "system", "precision", "found"}};
  std::vector<std::vector<std::string>> unjudged{{"  plug-in", "claim", "system", "precision", "reason"}};
  for (const Check& c : checks) {
    if (!good(c))
      failures.push_back({"  " + called(c.plugin, c.parameters), c.claim, c.system, c.precision,
                          "measured " + scientific(c.measured) + ", expected " + scientific(c.expected) +
                              " within " + scientific(c.tolerance) +
                              (c.reason.empty() ? "" : " (" + c.reason + ")")});
    if (c.control) {
      controls.push_back(
          {"  " + called(c.plugin, c.parameters) + ": " + c.claim, c.system, scientific(c.measured),
           c.claim.starts_with("order") ? scientific(c.expected) : "<= " + scientific(c.tolerance),
           std::string(to_string(c.result))});
      continue;
    }
    if (c.result == CheckResult::skipped && !c.in_scope) {
      if (ran_out(c))
        unjudged.push_back({"  " + called(c.plugin, c.parameters), c.claim, c.system, c.precision, c.reason});
      continue;
    }
    const std::array<std::string, 3> key{c.claim, c.system, c.precision};
    const auto [where, added] = counts.try_emplace(key);
    if (added) order.push_back(key);
    Count& count = where->second;
    count.passed += c.result == CheckResult::pass;
    count.failed += c.result == CheckResult::fail;
    count.measured += c.result == CheckResult::measured;
    if (c.result == CheckResult::pass || c.result == CheckResult::fail) note(count.worst, c);
    if (c.result == CheckResult::measured) note(count.outside, c);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a < b; });
  std::vector<std::vector<std::string>> rows{
      {"claim", "system", "precision", "pass", "fail", "worst", "outside", "worst"}};
  for (const auto& key : order) {
    const Count& n = counts[key];
    rows.push_back({key[0], key[1].empty() ? "-" : key[1], key[2], std::to_string(n.passed),
                    std::to_string(n.failed), n.passed + n.failed > 0 ? scientific(n.worst) : "-",
                    std::to_string(n.measured), n.measured > 0 ? scientific(n.outside) : "-"});
  }
  std::cout
      << table(rows)
      << paragraph(
             "(outside: the claim is not made there or is out of its scope, so that it is measured and not "
             "judged; worst: the largest value, failures included, and of order the claimed less the "
             "measured)");
  if (controls.size() > 1) {
    std::cout << "\ncontrols, false claims that must be rejected\n";
    // The terminal shows at most two controls of each plug-in, which is enough to read, and every control
    // that was not rejected; --json has all of them.
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
  if (unjudged.size() > 1) std::cout << "\nneither passed nor failed\n" << table(unjudged);
  if (failures.size() > 1) std::cout << "\nfailed\n" << table(failures);
}

}  // namespace

int verify_command(const VerificationSettings& settings, const Common& common) {
  std::vector<Check> checks;
  {
    const Interruption interruption;
    ProgressLine line(common.quiet);
    checks = verify(settings, [&](const std::string& what, std::size_t done, std::size_t all) {
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
  if (common.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Check& c : checks) list.push_back(to_json(c));
    std::cout << json_text({{"schema", 1}, {"ok", ok}, {"counts", totals}, {"checks", list}});
  } else if (!common.quiet || !ok) {
    print(checks);
    std::cout << '\n'
              << paragraph(
                     std::to_string(totals["pass"]) + " pass, " + std::to_string(totals["fail"]) + " fail, " +
                     std::to_string(totals["measured"]) + " measured outside their scope, " +
                     (totals["skipped"] > 0 ? std::to_string(totals["skipped"]) + " skipped, " : "") +
                     std::to_string(totals["rejected"]) + " controls rejected: " + (ok ? "ok" : "NOT OK"));
  }
  return ok ? 0 : 1;
}

}  // namespace pfaff
