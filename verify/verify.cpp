// Runs the checks that are asked for in parallel and returns their results in a fixed order.
#include <algorithm>
#include <limits>
#include <map>
#include <mutex>

#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/kinds.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/verification_jobs.hpp>

namespace pfaff {

std::string_view to_string(CheckResult result) {
  constexpr std::array<std::string_view, 5> names{"pass", "fail", "measured", "rejected", "skipped"};
  return names[static_cast<std::size_t>(result)];
}

bool good(const Check& check) {
  if (check.control) return check.result == CheckResult::rejected;
  if (check.in_scope) return check.result == CheckResult::pass;
  return check.result == CheckResult::measured ||
         (check.result == CheckResult::skipped && !check.reason.empty());
}

bool own_identity(const Check& check) {
  return !check.control && (check.system.empty() || check.plugin == check.system);
}

nlohmann::json to_json(const Check& c) {
  nlohmann::json parameters = nlohmann::json::object();
  for (const auto& [key, value] : c.parameters) parameters[key] = value;
  return {{"plugin", c.plugin},     {"claim", c.claim},         {"scope", c.scope},
          {"system", c.system},     {"precision", c.precision}, {"parameters", parameters},
          {"measured", c.measured}, {"expected", c.expected},   {"tolerance", c.tolerance},
          {"in_scope", c.in_scope}, {"control", c.control},     {"result", to_string(c.result)},
          {"reason", c.reason}};
}

namespace {
// Refuses names that nothing has, and parameters that are not those of one plug-in.
void validate(const VerificationSettings& settings) {
  std::vector<std::string> kinds = names_of_kinds(), known = names_of_plugins();
  kinds.emplace_back("controls");
  known.insert(known.end(), kinds.begin(), kinds.end());
  for (const std::string& name : settings.names)
    if (!text::is_text_file(name) && std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(unknown_name("name", name, known));
  if (settings.set.empty()) return;
  if (settings.names.size() != 1 ||
      std::find(kinds.begin(), kinds.end(), settings.names.front()) != kinds.end())
    throw InputError("--set: expected the name of one plug-in, whose parameters these are");
}

// A claim that could be judged on no system is no sound one. Added for methods that were tried on every
// system, whose descriptors `tried` gives, or null; the order counts as judged where one of its checks is. A
// claim without any check is one in whose scope none of the systems is that the method takes. Where methods
// were tried on the systems `on` alone, such claims are said not to be judged.
void add_claims_judged_nowhere(std::vector<Check>& checks,
                               const std::function<const MethodDescriptor*(const std::string& method)>& tried,
                               const std::vector<std::shared_ptr<const Model>>& on = {}) {
  std::map<std::pair<std::string, std::string>, std::pair<int, Check>>
      claims;  // judged, and one that was not
  std::map<std::string, Check> methods;
  for (const Check& c : checks) {
    if (c.control || tried(c.plugin) == nullptr) continue;
    methods.try_emplace(called(c.plugin, c.parameters), c);
    const bool judged = c.result == CheckResult::pass || c.result == CheckResult::fail;
    if (!judged && !unjudged(c)) continue;
    const std::string claim = c.claim.starts_with("order") ? "order" : c.claim;
    auto& [count, example] = claims[{called(c.plugin, c.parameters), claim}];
    count += judged;
    if (!judged) example = c;
  }
  for (auto& [key, found] : claims) {
    auto& [judged, check] = found;
    if (!on.empty() || judged > 0 || key.second.ends_with(" in a large step")) continue;
    check.claim = key.second;
    check.result = CheckResult::fail;
    check.in_scope = true;
    check.reason = "judged on no system; " + check.reason;
    checks.push_back(check);
  }
  for (const auto& method : methods) {
    const Check& check = method.second;
    for (const Claim claim : tried(check.plugin)->preserves) {
      const auto checked = [&](Claim one) {
        return claims.contains({method.first, std::string(to_string(one))});
      };
      const bool as_symplectic = claim == Claim::k_symplectic && checked(Claim::symplectic);
      if (claim == Claim::none || as_symplectic || checked(claim)) continue;
      // On constraints it may speak of the motion alone, which has been looked at.
      if (std::any_of(on.begin(), on.end(),
                      [&](const auto& model) { return model->restricted() || in_scope(claim, *model); }))
        continue;
      Check missing = check;
      missing.claim = to_string(claim);
      missing.scope = claim_row(claim).scope;
      missing.system.clear(), missing.precision.clear();
      missing.measured = missing.expected = missing.tolerance = 0;
      missing.result = CheckResult::fail;
      missing.in_scope = true;
      missing.reason = "judged on no system; none that the method takes is in its scope";
      checks.push_back(on.empty() ? missing
                                  : not_judged(missing, "out of its scope, which is: " + missing.scope));
    }
  }
}

using Progress = std::function<void(const std::string&, std::size_t, std::size_t)>;

// What methods do on a system that is wrong says nothing of the methods, and may take them very long: they
// are not judged there.
std::vector<Check> results_of(const std::function<std::vector<VerificationJob>()>& make_jobs,
                              const Progress& progress) {
  std::vector<VerificationJob> jobs;
  try {
    jobs = make_jobs();
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped()) throw;
    throw VerificationInterrupted("interrupted: no group of checks was made", {});
  }
  std::vector<std::vector<Check>> results(jobs.size());
  std::vector<std::size_t> first, of_methods;
  for (std::size_t k = 0; k < jobs.size(); ++k) (jobs[k].on.empty() ? first : of_methods).push_back(k);
  std::map<std::string, std::string> wrong;  // systems, as they were asked for, and their names
  std::mutex mutex;
  std::size_t done = 0;
  const auto run = [&](std::size_t k) {
    Check whole;
    whole.plugin = jobs[k].what;
    whole.claim = "checks";
    if (const auto system = wrong.find(jobs[k].on); system != wrong.end()) {
      results[k] = {not_judged_on_wrong(whole, system->second)};
      return;
    }
    try {
      results[k] = within_budget(whole, jobs[k].run, {});
    } catch (const InputError& error) {
      results[k] = {not_judged(whole, error.what())};
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const BudgetSpent&) {
      throw;
    } catch (...) {  // what a plug-in throws is a fault of its own, and the others are judged
      whole.result = CheckResult::fail;
      whole.measured = std::numeric_limits<double>::quiet_NaN();
      whole.reason = words_of_current_exception();
      results[k] = {whole};
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(jobs[k].what, done, jobs.size());
  };
  const auto all_checks = [&] {
    std::vector<Check> all;
    for (auto& part : results) all.insert(all.end(), part.begin(), part.end());
    return all;
  };
  try {
    in_parallel(first.size(), [&](std::size_t k) { run(first[k]); });
    for (const std::size_t k : first)
      for (const Check& c : results[k])
        if (!jobs[k].of.empty() && own_identity(c) && !good(c)) wrong[jobs[k].of] = c.system;
    in_parallel(of_methods.size(), [&](std::size_t k) { run(of_methods[k]); });
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped()) throw;
    throw VerificationInterrupted("interrupted: " + std::to_string(done) + " of " +
                                      std::to_string(jobs.size()) + " groups of checks were made",
                                  all_checks());
  }
  return all_checks();
}

// Where a method fails on a system that was not itself to be verified, the system is looked at too: if it is
// not what it states, the method is not judged there.
void look_for_fault_of_system(std::vector<Check>& checks, const std::shared_ptr<const Model>& model) {
  const auto of_method = [&](const Check& c) { return c.system == model->name() && c.plugin != c.system; };
  if (std::none_of(checks.begin(), checks.end(), [&](const Check& c) { return of_method(c) && !good(c); }))
    return;
  std::vector<Check> own = check_system(model->name(), model, {});
  std::erase_if(own, [](const Check& c) { return good(c) || !own_identity(c); });
  if (own.empty()) return;
  for (Check& c : checks)
    if (of_method(c) && !good(c)) c = not_judged_on_wrong(c, model->name());
  checks.insert(checks.begin(), own.begin(), own.end());
}
}  // namespace

std::vector<Check> verify(const VerificationSettings& given, const Progress& progress) {
  VerificationSettings settings = given;
  for (std::string& name : settings.names)
    name = names_method_table(name) ? integrator_named(name).name() : spelled(name);
  validate(settings);
  std::vector<Check> checks = results_of([&] { return verification_jobs(settings); }, progress);
  const auto& names = settings.names;
  const std::vector<std::string> methods = integrators().names_and_aliases();
  add_claims_judged_nowhere(checks, [&](const std::string& plugin) -> const MethodDescriptor* {
    const bool tried =
        std::find(methods.begin(), methods.end(), plugin) != methods.end() &&
        (names.empty() || std::find(names.begin(), names.end(), "integrators") != names.end() ||
         std::find(names.begin(), names.end(), plugin) != names.end());
    return tried ? &integrators().get(plugin, "integrator").descriptor() : nullptr;
  });
  return checks;
}

std::vector<Check> verify(const std::vector<MethodToVerify>& methods,
                          const std::vector<std::shared_ptr<const Model>>& systems,
                          const std::vector<std::shared_ptr<const Model>>& on) {
  std::vector<Check> checks = results_of([&] { return verification_jobs(methods, systems, on); }, {});
  for (const auto& model : on)
    if (std::find(systems.begin(), systems.end(), model) == systems.end())
      look_for_fault_of_system(checks, model);
  add_claims_judged_nowhere(
      checks,
      [&](const std::string& plugin) -> const MethodDescriptor* {
        for (const MethodToVerify& one : methods)
          if (one.method->descriptor().name == plugin) return &one.method->descriptor();
        return nullptr;
      },
      on);
  return checks;
}

}  // namespace pfaff
