// The command falsify: searches for the smallest system on which a claim of a method fails, or judges a claim
// on a system by name.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/state_checks.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/commands/commands.hpp>
#include <pfaff/verify/falsification/falsify.hpp>
#include <pfaff/verify/random_checks.hpp>

namespace pfaff {

namespace {

namespace fs = std::filesystem;

constexpr double budget_of_all = 300;  // of one integrator that of FalsificationSettings

Real number_of(const std::string& text, const char* option) {
  const auto number = Real::parse(text);
  if (!number)
    throw InputError(std::string(option) + ": expected a number such as 0.1 or 1/3, got '" + text + "'");
  return *number;
}

std::vector<ClaimUnderTest> tests_of(const FalsificationOptions& options) {
  if (options.all == !options.method.empty())
    throw InputError("falsify: expected the name of an integrator or --all (see pfaff list integrators)");
  if (options.all && !options.set.empty())
    throw InputError("--set: with --all every integrator has its own parameters; expected one integrator");
  std::optional<Claim> claim;
  if (!options.claim.empty()) claim = claim_named(options.claim);
  if (!options.all)
    return claims_under_test(integrator_asked_for(options.method), options.set, claim, options.seed);
  std::vector<ClaimUnderTest> tests;
  for (const MethodPlugin* plugin : integrators().all())
    for (ClaimUnderTest& test : claims_under_test(*plugin, {}, claim, options.seed))
      if (test.made) tests.push_back(std::move(test));
  return tests;
}

// The command that judges the claim on a counterexample.
std::string command_of(const FalsificationResult& result, const Common& common) {
  std::string command = "pfaff falsify " + showing_arguments(result.test, *result.counterexample);
  for (const std::string& plugin : common.plugins) command += " --plugin " + shell_word(plugin);
  return command;
}

std::string model_of(const FalsificationResult& result, const Common& common) {
  return model_text_of(result.test, *result.counterexample, command_of(result, common));
}

std::string file_of(const ClaimUnderTest& test) { return counterexample_name(test) + ".toml"; }

nlohmann::json to_json(const FalsificationResult& result, const Common& common) {
  nlohmann::json parameters = nlohmann::json::object();
  for (const auto& [key, value] : result.test.parameters) parameters[key] = value;
  nlohmann::json j{{"method", result.test.method->descriptor().name},
                   {"parameters", parameters},
                   {"claim", to_string(result.test.claim)},
                   {"claimed", result.test.made},
                   {"tried", result.tried},
                   {"result", result.counterexample ? "falsified"
                              : result.tried > 0    ? "held"
                                                    : "untested"},
                   {"counterexample", nullptr}};
  if (!result.counterexample) return j;
  const Counterexample& found = *result.counterexample;
  j["counterexample"] = {{"system", named_system(result.test, found).name},
                         {"kind", to_string(found.recipe.kind)},
                         {"dimension", found.recipe.dimension},
                         {"step", to_string(found.at.step)},
                         {"steps", found.at.count},
                         {"time", to_string(found.at.time)},
                         {"residuals", found.judgement.residuals},
                         {"residual_in_double", found.judgement.in_double},
                         {"exponent", found.judgement.exponent},
                         {"model", model_of(result, common)},
                         {"command", command_of(result, common)}};
  return j;
}

void print(const std::vector<FalsificationResult>& results, const Common& common) {
  std::string last;
  for (const FalsificationResult& result : results) {
    if (const std::string name = called(result.test.method->descriptor().name, result.test.parameters);
        name != last) {
      std::cout << name << '\n';
      last = name;
    }
    const char* verdict = result.counterexample ? "FALSIFIED"
                          : result.tried > 0    ? "held"
                                                : "untested: nothing in its scope";
    std::cout << formatted("  %-24s%6d systems  %s", std::string(to_string(result.test.claim)).c_str(),
                           result.tried, verdict)
              << (result.test.made ? "" : " (not claimed)") << '\n';
    if (!result.counterexample) continue;
    const Counterexample& found = *result.counterexample;
    std::cout << "    " << found.recipe.dimension
              << (found.recipe.dimension == 1 ? " variable" : " variables") << ", residual "
              << scientific(found.judgement.residuals.front()) << " at h = " << to_string(found.at.step)
              << ": " << named_system(result.test, found).name << '\n';
  }
  for (const FalsificationResult& result : results)
    if (result.counterexample)
      std::cout << '\n' << file_of(result.test) << ":\n\n" << model_of(result, common);
}

int search(const FalsificationOptions& options, const Common& common) {
  const Interruption interruption;
  std::vector<ClaimUnderTest> tests = tests_of(options);
  if (!options.out.empty())
    for (const ClaimUnderTest& test : tests) check_new_file(fs::path(options.out) / file_of(test), "--out");
  FalsificationSettings settings;
  settings.seed = options.seed;
  settings.systems = options.systems;
  settings.budget = options.budget.value_or(options.all ? budget_of_all : settings.budget);
  std::vector<FalsificationResult> results;
  {
    ProgressLine line(common.quiet);
    results = falsify(std::move(tests), settings,
                      [&](const std::string& what, double fraction) { line.show(what, fraction); });
  }
  std::size_t falsified = 0, systems = 0;
  std::string not_written;  // why; what was found is printed nevertheless
  nlohmann::json list = nlohmann::json::array();
  for (const FalsificationResult& result : results) {
    falsified += result.counterexample ? 1 : 0;
    systems += static_cast<std::size_t>(result.tried);
    if (common.json) list.push_back(to_json(result, common));
    if (result.counterexample && !options.out.empty()) try {
        write_new_file(fs::path(options.out) / file_of(result.test), model_of(result, common));
      } catch (const RunError& error) {
        not_written = error.what();
      }
  }
  const bool ok = falsified == 0 && (systems > 0 || results.empty());
  if (common.json) {
    std::cout << json_text({{"schema", 1}, {"ok", ok}, {"seed", settings.seed}, {"results", list}});
  } else if (!common.quiet) {
    print(results, common);
    std::cout << (results.empty() ? "" : "\n") << results.size() << " claims on " << systems
              << " random systems, seed " << settings.seed << ": " << falsified << " falsified\n";
    if (results.empty())
      std::cout << "nothing is claimed that could be falsified; --claim names what to try\n";
    else if (systems == 0)
      std::cout << "NOT OK: no claim could be tried on any system\n";
  }
  if (!not_written.empty()) throw RunError(not_written);
  return ok ? 0 : 1;
}

// Judges one claim on a system by name, at its initial state.
int show(const FalsificationOptions& options, const Common& common) {
  if (options.all || options.method.empty() || options.claim.empty())
    throw InputError("--system: expected an integrator and its --claim beside it");
  const Claim claim = claim_named(options.claim);
  const auto method = integrator_asked_for(options.method).make(options.set);
  const auto system = system_asked_for(options.system).make({});
  JudgedStep at{model_in_scope(*method, claim, system), system->initial(), number_of(options.at, "--at"),
                number_of(options.step, "--step"), options.steps};
  if (!(at.step > Real(0))) throw InputError("--step: expected a number above 0, got " + options.step);
  if (at.model == nullptr) {
    if (const std::string why = method->refuses(*system); !why.empty() && in_scope(claim, *system))
      throw InputError("--system: " + why);
    throw InputError("--system: " + options.system + " is not in the scope of " + options.claim +
                     ", which is: " + std::string(claim_row(claim).scope));
  }
  if (system->restricted()) {
    std::vector<Quad> z;
    for (const Real& x : system->initial()) z.push_back(x.quad());
    if (const Consistency found = consistency_of(*system, at.time.quad(), z); !found.on_constraints())
      throw InputError("--system: " + found.where + "; expected a state on the constraints");
  }
  const Interruption interruption;
  // What a method does on a system that is not what it states says nothing of the method. That a quantity is
  // a constant number, as an energy of zero is, is no fault here.
  for (const Check& check : check_system(system->name(), system, {}))
    if (own_identity(check) && !good(check) && !check.claim.ends_with(" varies"))
      throw InputError("--system: " + options.system + " is itself not what it states: " + check.claim +
                       " does not hold (see pfaff verify " + options.system + ")");
  const Budget budget(judged_by_long_runs(claim) ? limits_of_long_runs : limits_of_check);
  const Judgement judgement = judge(*method, claim, at);
  const bool judged = !std::isnan(judgement.residuals.front()), ok = judged && !judgement.falsified;
  if (common.json) {
    std::cout << json_text({{"schema", 1},
                            {"ok", ok},
                            {"residuals", judgement.residuals},
                            {"residual_in_double", judgement.in_double},
                            {"exponent", judgement.exponent},
                            {"reason", judgement.reason}});
    return ok ? 0 : 1;
  }
  if (common.quiet) return ok ? 0 : 1;
  std::cout << paragraph(std::string(claim_row(claim).meaning));
  for (std::size_t k = 0; k < judgement.residuals.size() && !judged_by_long_runs(claim); ++k)
    std::cout << "residual of " << options.steps << (options.steps == 1 ? " step, h" : " steps, h")
              << (k == 0 ? "" : "/" + std::to_string(1U << k)) << ": " << scientific(judgement.residuals[k])
              << '\n';
  if (!std::isnan(judgement.in_double))
    std::cout << "residual in double: " << scientific(judgement.in_double) << '\n';
  std::cout << (judgement.falsified
                    ? "FALSIFIED: above " + scientific(falsifying_residual(*method, claim))
                    : (judged ? "not falsified: " : "NOT OK: not judged: ") + judgement.reason)
            << '\n';
  return ok ? 0 : 1;
}

}  // namespace

int falsify_command(const FalsificationOptions& options, const Common& common) {
  return options.system.empty() ? search(options, common) : show(options, common);
}

}  // namespace pfaff
