// The command verify: checks the claims of plug-ins and shows how many checks passed for each claim, system
// and precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/commands/commands.hpp>

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

// Every check, in tables.
void print_all(const std::vector<Check>& checks) {
  // The table has one row for each claim, system and precision.
  std::map<std::array<std::string, 3>, Count> counts;
  std::vector<std::array<std::string, 3>> order;
  std::vector<std::vector<std::string>> controls{{"control", "system", "measured", "claimed", "result"}};
  std::vector<std::vector<std::string>> failures{{"  plug-in", "claim", "system", "precision", "found"}};
  std::vector<std::vector<std::string>> not_made{{"  plug-in", "claim", "system", "precision", "reason"}};
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
      if (unjudged(c))
        not_made.push_back({"  " + called(c.plugin, c.parameters), c.claim, c.system, c.precision, c.reason});
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
  if (not_made.size() > 1) std::cout << "\nneither passed nor failed\n" << table(not_made);
  if (failures.size() > 1) std::cout << "\nfailed\n" << table(failures);
}

// What a claim came to over all systems and precisions.
struct Summary {
  int passed = 0, failed = 0, unjudged = 0;
  const Check* worst = nullptr;  // of those that were judged, in units of what is allowed
};

// How near a check is to what is allowed: above one it fails. Of an order, by how much it misses the claim.
double nearness(const Check& c) {
  const double size = c.claim == "order" ? (c.expected - c.measured) / c.tolerance
                      : c.tolerance > 0  ? c.measured / c.tolerance
                                         : c.measured;
  return std::isnan(size) ? HUGE_VAL : size;
}

// "1.2e-15 of 1e-14 allowed", "4 of 4 claimed".
std::string found_of(const Check& c) {
  if (std::isnan(c.measured)) return "not measured";
  return c.claim == "order"          ? scientific(c.measured) + " of " + scientific(c.expected) + " claimed"
         : std::isfinite(c.measured) ? scientific(c.measured) + " of " + scientific(c.tolerance) + " allowed"
                                     : "not finite, " + scientific(c.tolerance) + " allowed";
}

// A row for each claim, with its worst case; an order is allowed to be what is claimed, or more.
void print_claims(const std::vector<Check>& checks) {
  std::map<std::string, Summary> claims;
  const bool one_plugin = std::all_of(checks.begin(), checks.end(), [&](const Check& c) {
    return c.control || (c.plugin == checks.front().plugin && c.parameters == checks.front().parameters);
  });
  std::vector<std::string> order;
  for (const Check& c : checks) {
    const bool judged = c.result == CheckResult::pass || c.result == CheckResult::fail;
    if (c.control || (!judged && !unjudged(c))) continue;
    const auto [where, added] = claims.try_emplace(c.claim);
    if (added) order.push_back(c.claim);
    Summary& s = where->second;
    s.passed += c.result == CheckResult::pass;
    s.failed += c.result == CheckResult::fail;
    s.unjudged += unjudged(c);
    if (judged && (s.worst == nullptr || nearness(c) > nearness(*s.worst))) s.worst = &c;
  }
  std::vector<std::vector<std::string>> rows{
      {"claim", "holds", "fails", "not judged", "worst (allowed)", "where"}};
  const auto counted = [](int n) { return n == 0 ? std::string("-") : std::to_string(n); };
  for (const std::string& claim : order) {
    const Summary& s = claims[claim];
    const bool shown = s.worst != nullptr && (claim == "order" || s.worst->tolerance > 0);
    rows.push_back({claim, counted(s.passed), counted(s.failed), counted(s.unjudged),
                    shown ? scientific(s.worst->measured) + " (" +
                                scientific(claim == "order" ? s.worst->expected : s.worst->tolerance) + ")"
                          : "-",
                    !shown                                   ? ""
                    : one_plugin && !s.worst->system.empty() ? s.worst->system
                                                             : place_of(*s.worst)});
  }
  std::cout << table(rows);
}

// The failed checks, those of systems and brackets themselves first.
void print_causes(const std::vector<Check>& checks) {
  constexpr std::size_t most_rows = 20;
  std::vector<const Check*> shown;
  for (const Check& c : checks)
    if (!good(c)) shown.push_back(&c);
  std::stable_partition(shown.begin(), shown.end(), [](const Check* c) { return own_identity(*c); });
  std::vector<std::vector<std::string>> rows{{"  failed", "found", "where", "precision"}};
  for (std::size_t k = 0; k < std::min(most_rows, shown.size()); ++k) {
    const Check& c = *shown[k];
    rows.push_back({"  " + c.claim,
                    (c.control ? "a false claim, not rejected" : found_of(c)) +
                        (c.reason.empty() ? "" : ": " + c.reason),
                    place_of(c), c.precision});
  }
  std::cout << table(rows);
  if (shown.size() > most_rows) std::cout << "  and " << shown.size() - most_rows << " more (--verbose)\n";
  std::set<std::string> why;  // of groups of checks that were not made at all
  for (const Check& c : checks)
    if (c.claim == "checks" && unjudged(c) && why.insert(c.reason).second) std::cout << paragraph(c.reason);
  std::cout << '\n';
}

// `ended` says where the verification was interrupted: then nothing is said to be sound.
int show(const std::vector<Check>& checks, const VerificationSettings& settings, const Common& common,
         const std::string& ended) {
  std::map<std::string, int> totals{{"pass", 0},     {"fail", 0},    {"measured", 0},
                                    {"rejected", 0}, {"skipped", 0}, {"not_judged", 0}};
  for (const Check& c : checks) {
    ++totals[std::string(to_string(c.result))];
    totals["not_judged"] += unjudged(c);
  }
  auto [ok, any, line] = verdict_of(checks);
  if (!ended.empty()) ok = false, line = ended;
  if (common.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Check& c : checks) list.push_back(to_json(c));
    std::cout << json_text(
        {{"schema", 1}, {"ok", ok}, {"verdict", line}, {"counts", totals}, {"checks", list}});
  } else if (!common.quiet || !ok) {
    std::cout << paragraph(line) << '\n';
    if (!std::all_of(checks.begin(), checks.end(), good)) print_causes(checks);
    if (settings.verbose)
      print_all(checks);
    else if (any)
      print_claims(checks);
  }
  return ok ? 0 : 1;
}

}  // namespace

int verify_command(const VerificationSettings& settings, const Common& common) {
  std::vector<Check> checks;
  try {
    const Interruption interruption;
    ProgressLine line(common.quiet);
    checks = verify(settings, [&](const std::string& what, std::size_t done, std::size_t all) {
      line.show(what, static_cast<double>(done) / static_cast<double>(all));
    });
  } catch (const VerificationInterrupted& end) {
    (void)show(end.checks, settings, common, end.what());
    throw;
  }
  return show(checks, settings, common, {});
}

}  // namespace pfaff
