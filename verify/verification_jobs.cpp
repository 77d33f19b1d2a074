#include <pfaff/verify/verification_jobs.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <new>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/formulation_checks.hpp>
#include <pfaff/verify/near_parameters.hpp>
#include <pfaff/verify/random_checks.hpp>
#include <pfaff/verify/random_constraints.hpp>
#include <pfaff/verify/skated_models.hpp>

namespace pfaff {

namespace {
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

}  // namespace

std::vector<Check> with_control(std::vector<Check> checks, const MethodInstance& method,
                                const Assignments& parameters, const SystemPlugin& system) {
  if (system.name() == controlled_on(method))
    for (Check& check : check_changed_coefficient(method, parameters, system))
      checks.push_back(std::move(check));
  return checks;
}

namespace {
// Checks with parameters that nobody chose: with them the initial state may be outside the domain of a
// formula, or off the constraints.
std::vector<Check> inside_domain(std::vector<Check> checks) {
  for (Check& check : checks)
    if (check.result == CheckResult::fail && (std::isnan(check.measured) || check.scope == "initial state"))
      check = not_judged(check, "the initial state does not belong to these parameters");
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
    add_measures();
    add_controls();
    add_methods();
  }
  [[nodiscard]] std::vector<VerificationJob> take() && { return std::move(jobs_); }

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

  // Whether work() came to its end, which asks a plug-in what there is to verify. What the plug-in throws is
  // a failed check of it, to be told where it was asked for, and says nothing of what else is verified. Of
  // parameters and of texts, which whoever asks has written, errors pass.
  bool guarded(const Plugin& plugin, bool asked_for, const std::function<void()>& work) {
    try {
      work();
      return true;
    } catch (const BudgetSpent&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const InputError& error) {
      const bool of_plugin = dynamic_cast<const PluginError*>(&error) != nullptr;
      if (!of_plugin && (!settings_.set.empty() || texts_.contains(&plugin))) throw;
      if (asked_for) add_failure(plugin, error.what());
    } catch (...) {
      if (asked_for) add_failure(plugin, words_of_current_exception());
    }
    return false;
  }
  void add_failure(const Plugin& plugin, std::string reason) {
    Check thrown;
    thrown.plugin = plugin.name();
    thrown.claim = "checks";
    thrown.result = CheckResult::fail;
    thrown.measured = std::numeric_limits<double>::quiet_NaN();
    thrown.reason = std::move(reason);
    add_result(thrown);
  }
  void add_result(const Check& check) {
    jobs_.push_back({check.plugin, [check] { return std::vector{check}; }});
  }

  // Claims are measured near the initial state. A system that has none, since whoever runs it states one, is
  // refused where it is asked for by name, and otherwise only said to be left out.
  void leave_out_systems_without_a_state() {
    std::erase_if(systems_, [&](const SystemPlugin* system) {
      const bool asked_for = named(asked_as(*system)), shown = asked_for || wanted("systems");
      bool has_state = false;
      if (!guarded(*system, shown,
                   [&] { has_state = !system->make(parameters_of(*system))->initial().empty(); }))
        return true;
      if (has_state) return false;
      if (asked_for)
        throw InputError("system " + system->name() +
                         " has no initial state, near which its claims are measured");
      Check whole;
      whole.plugin = whole.system = system->name();
      whole.claim = "checks";
      if (shown) add_result(not_judged(whole, "the system has no initial state"));
      return true;
    });
  }

  void add_systems() {
    for (const SystemPlugin* system : systems_)
      if (wanted(asked_as(*system)) || wanted("systems"))
        guarded(*system, true,
                [&] { add_identities(*system, system->instances(settings_.full), check_system); });
  }

  void add_brackets() {
    for (const BracketPlugin* bracket : brackets_)
      if (wanted(asked_as(*bracket)) || wanted("brackets"))
        guarded(*bracket, true, [&] { add_identities(*bracket, instances_of(*bracket), check_bracket); });
  }

  // What a plug-in states of itself, with the parameters of its instances and with two sets drawn near the
  // defaults, for which nobody promised that the initial state is in the domain of every formula.
  template <class P>
  void add_identities(const P& plugin, std::vector<Assignments> instances,
                      std::vector<Check> (*check)(const P&, const Assignments&)) {
    for (const Assignments& p : parameters(asked_as(plugin), std::move(instances)))
      jobs_.push_back(
          {called(plugin.name(), p), [=, &plugin] { return check(plugin, p); }, asked_as(plugin)});
    if (!settings_.set.empty()) return;
    for (const Assignments& p : parameters_near_defaults(plugin, 2))
      jobs_.push_back({called(plugin.name(), p), [=, &plugin] { return inside_domain(check(plugin, p)); },
                       asked_as(plugin)});
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
      guarded(*formulation, true, [&] {
        for (const auto& [made, asked] : models) {
          const std::shared_ptr<const Model>& model = made;
          if (!wanted(formulation->name()) && !wanted("formulations") && !wanted(asked)) continue;
          for (const Assignments& p : parameters(formulation->name(), formulation->instances(settings_.full)))
            if (verified_on(*formulation, p, *model))
              jobs_.push_back({called(formulation->name(), p) + " of " + model->name(),
                               [=] { return check_formulation(*formulation, p, model); }});
        }
      });
  }

  void add_measures() {
    for (const MeasurePlugin* measure : measures().all())
      if (wanted(measure->name()) || wanted("measures"))
        jobs_.push_back({"measure " + measure->name(), [measure] { return check_measure(*measure); }});
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
    for (const MethodPlugin* method : methods)
      guarded(*method, true, [&] {
        const bool all = wanted(method->name()) || wanted("integrators");
        if (all) add_random_systems(*method);
        if (all) add_coefficients(*method);
        for (const SystemPlugin* system : systems_)
          if (all || wanted(asked_as(*system))) add_method(*method, *system);
      });
  }

  void add_coefficients(const MethodPlugin& method) {
    for (const Assignments& p : parameters(method.name(), method.instances(settings_.full)))
      if (order_theory(method.name(), p))
        jobs_.push_back({"coefficients of " + called(method.name(), p),
                         [=, &method] { return check_coefficients(method, p); }});
  }

  // On random systems of three kinds for each claim with the first parameters, of every kind where the method
  // is named, and of one kind with the other parameters.
  void add_random_systems(const MethodPlugin& method) {
    std::size_t turn = 0;
    bool every_kind = named(method.name());
    for (const Assignments& p : parameters(method.name(), method.instances(settings_.full))) {
      jobs_.push_back({called(method.name(), p) + " on random systems", [=, &method] {
                         return check_on_random_systems(*method.make(p), p, turn, every_kind);
                       }});
      every_kind = false;
      if (!settings_.full) ++turn;
    }
  }

  void add_method(const MethodPlugin& method, const SystemPlugin& system) {
    const auto model = system.make(parameters_of(system));
    auto instances = parameters(method.name(), method.instances(settings_.full));
    // Runs with all parameters would take most of the time of verification.
    auto of_runs = settings_.full ? method.instances(false) : std::vector<Assignments>{instances.front()};
    if (named(method.name()) && settings_.set.empty()) {
      for (const Assignments& other : other_values(method, instances)) instances.push_back(other);
      for (const Assignments& drawn : parameters_near_defaults(method, 1)) {
        instances.push_back(drawn);
        of_runs.push_back(drawn);
      }
    }
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
      const bool along_runs = std::find(of_runs.begin(), of_runs.end(), p) != of_runs.end();
      jobs_.push_back({called(method.name(), p) + " on " + on,
                       [=, &method, &system] {
                         const auto made = method.make(p);
                         return with_control(check_method(*made, p, on, motion, along_runs), *made, p,
                                             system);
                       },
                       {},
                       asked_as(system)});
    }
  }

  const VerificationSettings& settings_;
  std::vector<const SystemPlugin*> systems_;
  std::vector<const BracketPlugin*> brackets_;
  std::map<const Plugin*, std::string> texts_;  // plug-ins written as text, and their files
  std::vector<VerificationJob> jobs_;
};

}  // namespace

std::vector<VerificationJob> verification_jobs(const VerificationSettings& settings) {
  return Jobs(settings).take();
}

}  // namespace pfaff
