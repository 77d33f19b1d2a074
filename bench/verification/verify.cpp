// Runs the checks: collects the jobs, runs them in parallel and returns their results in a fixed order.
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/check_budget.hpp>
#include <pfaff/bench/verification/formulation_checks.hpp>
#include <pfaff/bench/verification/near_parameters.hpp>
#include <pfaff/bench/verification/random_checks.hpp>
#include <pfaff/bench/verification/random_constraints.hpp>
#include <pfaff/bench/verification/skated_models.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/systems/text/text_system.hpp>

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
struct Job {
  std::string what;
  std::function<std::vector<Check>()> run;
};

// The field of a formulation is differentiated in quad up to this dimension only; beyond it a check would
// cost too much.
constexpr int most_formulated = 8;

// The system on which the controls of a method run. It has to be nonlinear and to fit: the damped pendulum
// for chart methods, the pendulum for other motions, henon-heiles for exact flows of parts, and for methods
// that need constraints the contact oscillator where these are of velocities, else the spherical pendulum.
std::string controlled_on(const MethodInstance& method) {
  for (const char* name : {"damped-pendulum", "pendulum", "henon-heiles"})
    if (method.refuses(*systems().get(name, "").make({})).empty()) return name;
  return method.needs().has(Facet::velocity_constraints) ? "contact-oscillator" : "spherical-pendulum";
}

// Checks with parameters that nobody chose: the initial state may be outside the domain of a formula with
// them.
std::vector<Check> inside_domain(std::vector<Check> checks) {
  for (Check& check : checks)
    if (check.result == CheckResult::fail && std::isnan(check.measured))
      check = not_judged(check, "a formula has no value near the initial state with these parameters");
  return checks;
}

// The checks to be run, in their order.
class Jobs {
 public:
  explicit Jobs(const VerificationSettings& settings)
      : settings_(settings), systems_(systems().all()), brackets_(brackets().all()) {
    add_texts();
    leave_out_systems_without_a_state();
    add_systems();
    add_brackets();
    add_formulations();
    add_controls();
    add_methods();
  }
  [[nodiscard]] const std::vector<Job>& all() const { return jobs_; }

 private:
  [[nodiscard]] bool wanted(const std::string& name) const {
    const auto& names = settings_.names;
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  }
  // The name that a plug-in is asked for by: of one written as text the path of its file.
  [[nodiscard]] std::string asked_as(const Plugin& plugin) const {
    const auto text = texts_.find(&plugin);
    return text == texts_.end() ? plugin.name() : text->second;
  }
  [[nodiscard]] bool named(const std::string& name) const { return !settings_.names.empty() && wanted(name); }
  // The parameters of a plug-in: those that are set where it is the one that is named.
  [[nodiscard]] std::vector<Assignments> parameters(const std::string& name,
                                                    std::vector<Assignments> instances) const {
    if (settings_.set.empty() || !named(name)) return instances;
    return {settings_.set};
  }
  // The parameters with which methods run on a system.
  [[nodiscard]] Assignments parameters_of(const SystemPlugin& system) const {
    return parameters(asked_as(system), {{}}).front();
  }

  // Systems and brackets written as text, where their files are named.
  void add_texts() {
    for (const std::string& name : settings_.names) {
      if (!text::is_text_file(name)) continue;
      if (is_text_bracket(name)) {
        brackets_.push_back(&bracket_named(name));
        texts_[brackets_.back()] = name;
      } else {
        systems_.push_back(&system_named(name));
        texts_[systems_.back()] = name;
      }
    }
  }

  // Claims are measured near the initial state. A system that has none, since whoever runs it states one, is
  // refused where it is asked for by name, and otherwise only said to be left out.
  void leave_out_systems_without_a_state() {
    std::erase_if(systems_, [&](const SystemPlugin* system) {
      if (!system->make(parameters_of(*system))->initial().empty()) return false;
      if (named(asked_as(*system)))
        throw InputError("system " + system->name() +
                         " has no initial state, near which its claims are measured");
      if (wanted("systems"))
        jobs_.push_back({system->name(), [system] {
                           Check whole;
                           whole.plugin = whole.system = system->name();
                           whole.claim = "checks";
                           return std::vector{not_judged(whole, "the system has no initial state")};
                         }});
      return true;
    });
  }

  void add_systems() {
    for (const SystemPlugin* system : systems_) {
      if (!wanted(asked_as(*system)) && !wanted("systems")) continue;
      for (const Assignments& p : parameters(asked_as(*system), system->instances(settings_.full)))
        jobs_.push_back({called(system->name(), p), [=] { return check_system(*system, p); }});
      if (settings_.set.empty())
        for (const Assignments& p : parameters_near_defaults(*system, 2))
          jobs_.push_back(
              {called(system->name(), p), [=] { return inside_domain(check_system(*system, p)); }});
    }
  }

  void add_brackets() {
    for (const BracketPlugin* bracket : brackets_) {
      if (!wanted(asked_as(*bracket)) && !wanted("brackets")) continue;
      for (const Assignments& p : parameters(asked_as(*bracket), instances_of(*bracket)))
        jobs_.push_back({called(bracket->name(), p), [=] { return check_bracket(*bracket, p); }});
    }
  }

  // On every system that they fit, on random systems of constraints, and on models with velocity constraints
  // of every kind.
  void add_formulations() {
    std::vector<std::pair<std::shared_ptr<const Model>, std::string>>
        models;  // with what they are asked for by
    for (const SystemPlugin* system : systems_)
      if (system->constrained()) models.emplace_back(system->make(parameters_of(*system)), asked_as(*system));
    const auto add = [&](const std::shared_ptr<const Model>& model) {
      models.emplace_back(model, model->name());
    };
    add(random_rods());
    for (const auto& model : random_constraints()) add(model);
    for (const auto& model : skated_models()) add(model);
    for (const FormulationPlugin* formulation : formulations().all())
      for (const auto& [made, asked] : models) {
        const std::shared_ptr<const Model>& model = made;
        if (!wanted(formulation->name()) && !wanted("formulations") && !wanted(asked)) continue;
        for (const Assignments& p : parameters(formulation->name(), formulation->instances(settings_.full)))
          if (verified_on(*formulation, p, *model))
            jobs_.push_back({called(formulation->name(), p) + " of " + model->name(),
                             [=] { return check_formulation(*formulation, p, model); }});
      }
  }

  void add_controls() {
    if (wanted("brackets") || wanted("controls")) jobs_.push_back({"false brackets", check_false_brackets});
    if (wanted("systems") || wanted("controls")) {
      jobs_.push_back({"false structures", check_false_structures});
      jobs_.push_back({"false constraints", check_false_constraints});
      jobs_.push_back({"false metriplectic systems", check_false_metriplectic});
      jobs_.push_back({"false reversals", check_false_reversals});
      jobs_.push_back({"false flows", check_false_flows});
    }
    if (wanted("integrators") || wanted("controls")) jobs_.push_back({"false methods", check_false_methods});
  }

  void add_methods() {
    std::vector<const MethodPlugin*> methods = integrators().all();
    // An alias is verified only when asked for, as what it names is verified anyway.
    for (const MethodPlugin* alias : integrators().aliases())
      if (named(alias->name())) methods.push_back(alias);
    for (const MethodPlugin* method : methods) {
      const bool all = wanted(method->name()) || wanted("integrators");
      if (all) add_random_systems(*method);
      if (all) add_coefficients(*method);
      for (const SystemPlugin* system : systems_)
        if (all || wanted(asked_as(*system))) add_method(*method, *system);
    }
  }

  void add_coefficients(const MethodPlugin& method) {
    for (const Assignments& p : parameters(method.name(), method.instances(settings_.full)))
      if (order_theory(method.name(), p))
        jobs_.push_back({"coefficients of " + called(method.name(), p),
                         [=, &method] { return check_coefficients(method, p); }});
  }

  void add_random_systems(const MethodPlugin& method) {
    std::size_t turn = 0;
    for (const Assignments& p : parameters(method.name(), method.instances(settings_.full))) {
      jobs_.push_back({called(method.name(), p) + " on random systems",
                       [=, &method] { return check_on_random_systems(method, p, turn); }});
      if (!settings_.full) ++turn;
    }
  }

  void add_method(const MethodPlugin& method, const SystemPlugin& system) {
    const auto model = system.make(parameters_of(system));
    auto instances = parameters(method.name(), method.instances(settings_.full));
    if (named(method.name()) && settings_.set.empty())
      for (const Assignments& drawn : parameters_near_defaults(method, 1)) instances.push_back(drawn);
    // With the many parameters of a full verification, runs would take most of its time.
    const auto usual = method.instances(false);
    for (const Assignments& p : instances) {
      spend(0, 0);  // there are thousands of pairs, and somebody may not want to wait for their list
      const auto instance = method.make(p);
      const auto motion = motion_for(*instance, model);
      if (!instance->refuses(*motion).empty()) continue;
      // Methods for vector fields claim nothing about constraints; in a quick check they run on one system
      // with constraints, to show what they do there.
      const bool in_passing = motion != model && !instance->needs_constraints();
      if (in_passing && !settings_.full && !named(method.name()) &&
          (system.name() != "spherical-pendulum" || p != instances.front()))
        continue;
      if (in_passing && model->dimension() > most_formulated) continue;
      const std::string on = called(system.name(), parameters_of(system));
      const bool along_runs = !settings_.full || std::find(usual.begin(), usual.end(), p) != usual.end();
      jobs_.push_back({called(method.name(), p) + " on " + on, [=, &method, &system] {
                         const auto made = method.make(p);
                         auto checks = check_method(*made, p, on, motion, along_runs);
                         if (system.name() == controlled_on(*made))
                           for (Check& check : check_changed_coefficient(method, p, system))
                             checks.push_back(std::move(check));
                         return checks;
                       }});
    }
  }

  const VerificationSettings& settings_;
  std::vector<const SystemPlugin*> systems_;
  std::vector<const BracketPlugin*> brackets_;
  std::map<const Plugin*, std::string> texts_;  // plug-ins written as text, and their files
  std::vector<Job> jobs_;
};

// Refuses names that nothing has, and parameters that are not those of one plug-in.
void validate(const VerificationSettings& settings) {
  const std::vector<std::string> kinds{"systems", "brackets", "integrators", "formulations", "controls"};
  std::vector<std::string> known = kinds;
  for (const auto& more :
       {systems().names(), integrators().names_and_aliases(), brackets().names(), formulations().names()})
    known.insert(known.end(), more.begin(), more.end());
  for (const std::string& name : settings.names)
    if (!text::is_text_file(name) && std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(unknown_name("name", name, known));
  if (settings.set.empty()) return;
  if (settings.names.size() != 1 ||
      std::find(kinds.begin(), kinds.end(), settings.names.front()) != kinds.end())
    throw InputError("--set: expected the name of one plug-in, whose parameters these are");
}

// A claim that could be judged on no system is no sound one. Added for methods that were tried on every
// system; the order counts as judged where one of its checks is.
void add_claims_judged_nowhere(std::vector<Check>& checks, const VerificationSettings& settings) {
  const auto& names = settings.names;
  const auto tried = [&](const std::string& plugin) {
    return names.empty() || std::find(names.begin(), names.end(), "integrators") != names.end() ||
           std::find(names.begin(), names.end(), plugin) != names.end();
  };
  const std::vector<std::string> methods = integrators().names_and_aliases();
  std::map<std::pair<std::string, std::string>, std::pair<int, Check>>
      claims;  // judged, and one that was not
  for (const Check& c : checks) {
    if (c.control || !tried(c.plugin) || std::find(methods.begin(), methods.end(), c.plugin) == methods.end())
      continue;
    const bool judged = c.result == CheckResult::pass || c.result == CheckResult::fail;
    if (!judged && !unjudged(c)) continue;
    const std::string claim = c.claim.starts_with("order") ? "order" : c.claim;
    auto& [count, example] = claims[{called(c.plugin, c.parameters), claim}];
    count += judged;
    if (!judged) example = c;
  }
  for (auto& [key, found] : claims) {
    auto& [judged, check] = found;
    if (judged > 0 || key.second.ends_with(" in a large step")) continue;
    check.claim = key.second;
    check.result = CheckResult::fail;
    check.in_scope = true;
    check.reason = "judged on no system; " + check.reason;
    checks.push_back(check);
  }
}
}  // namespace

std::vector<Check> verify(const VerificationSettings& given,
                          const std::function<void(const std::string&, std::size_t, std::size_t)>& progress) {
  VerificationSettings settings = given;
  for (std::string& name : settings.names)
    if (names_method_table(name)) name = integrator_named(name).name();
  validate(settings);
  const std::vector<Job> jobs = Jobs(settings).all();
  std::vector<std::vector<Check>> results(jobs.size());
  std::mutex mutex;
  std::size_t done = 0;
  const auto run = [&](std::size_t k) {
    Check whole;
    whole.plugin = jobs[k].what;
    whole.claim = "checks";
    try {
      results[k] = within_budget(whole, jobs[k].run, {});
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const BudgetSpent&) {
      throw;
    } catch (...) {
      throw RunError(jobs[k].what + ": " + words_of_current_exception());
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(jobs[k].what, done, jobs.size());
  };
  try {
    in_parallel(jobs.size(), run);
  } catch (const BudgetSpent& spent) {
    end_interrupted(spent, std::to_string(done) + " of " + std::to_string(jobs.size()) +
                               " groups of checks were made, and none is shown");
  }
  std::vector<Check> all;
  for (auto& part : results) all.insert(all.end(), part.begin(), part.end());
  add_claims_judged_nowhere(all, settings);
  return all;
}

}  // namespace pfaff
