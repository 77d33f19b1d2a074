// What checks come to, in a sentence.
#include <algorithm>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>

namespace pfaff {

std::string place_of(const Check& check) {
  const std::string plugin = called(check.plugin, check.parameters);
  return check.system.empty() || check.system == check.plugin ? plugin : plugin + " on " + check.system;
}

Check nothing_stated(const std::string& system) {
  Check check;
  check.plugin = check.system = system;
  check.claim = "statements";
  check.in_scope = false;
  check.reason =
      "it states nothing that could be false: no quantity that is conserved, increases or decreases, no "
      "solution, no reversal, and no formula that follows from its others";
  return check;
}

bool states_nothing(const Check& check) { return check.claim == "statements"; }

namespace {
// Why nothing was checked: the reasons that there are, or that nothing fits.
std::string why_nothing(const std::vector<Check>& checks) {
  for (const Check& c : checks)
    if (!c.reason.empty()) return "because of " + c.claim + " of " + place_of(c) + ": " + c.reason;
  return "because no system that is registered fits it, and nothing is known of its coefficients";
}
}  // namespace

Verdict verdict_of(const std::vector<Check>& checks) {
  int held = 0, failed = 0, left = 0, controls = 0, rejected = 0;
  bool checked = false;
  for (const Check& c : checks) {
    checked = checked || c.result == CheckResult::pass || c.result == CheckResult::fail || c.control;
    if (c.control) {
      ++controls;
      rejected += c.result == CheckResult::rejected;
    } else if (good(c)) {
      held += c.result == CheckResult::pass;
      left += unjudged(c);
    }
    failed += !good(c);
  }
  const bool ok = checked && failed == 0;
  if (!checked && !checks.empty() && std::all_of(checks.begin(), checks.end(), states_nothing))
    return {
        true, checked,
        "ok: there is nothing to check of " + checks.front().system + ", because " + checks.front().reason};
  if (!checked && !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const Check& c) {
        return c.result == CheckResult::measured;
      }))
    return {true, checked,
            "ok: it claims nothing that could be false; " + std::to_string(checks.size()) +
                " numbers are measured, which --verbose shows"};
  if (!checked) return {ok, checked, "NOT OK: nothing could be checked, " + why_nothing(checks)};
  failed -= controls - rejected;
  std::string line =
      ok ? "ok: "
         : "NOT OK: " + std::to_string(failed) + " of " + std::to_string(held + failed) + " checks fail, ";
  line += std::to_string(held) + (ok ? " checks hold" : " hold");
  if (left > 0) line += ", " + std::to_string(left) + " could not be judged";
  if (controls > 0)
    line += ", " + std::to_string(rejected) + " of " + std::to_string(controls) + " false claims rejected";
  return {ok, checked, line};
}

}  // namespace pfaff
