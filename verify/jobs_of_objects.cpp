// The checks of methods and systems that are objects, which nobody has registered.
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/verify/random_checks.hpp>
#include <pfaff/verify/verification_jobs.hpp>

namespace pfaff {

namespace {
// What a system that is an object is asked for by, which no registered one is.
std::string as_object(const Model& model) { return "object " + model.name(); }
}  // namespace

std::vector<VerificationJob> verification_jobs(const std::vector<MethodToVerify>& methods,
                                               const std::vector<std::shared_ptr<const Model>>& systems,
                                               const std::vector<std::shared_ptr<const Model>>& on) {
  std::vector<VerificationJob> jobs;
  for (const auto& model : systems) {
    if (model->initial().empty())
      throw InputError("system " + model->name() +
                       " has no initial state, near which its claims are measured");
    jobs.push_back(
        {model->name(), [=] { return check_system(model->name(), model, {}); }, as_object(*model)});
  }
  for (const auto& [made, parameters] : methods) {
    const auto& method = made;
    const auto& p = parameters;
    const std::string name = called(method->descriptor().name, p);
    const auto add = [&](const std::shared_ptr<const Model>& motion, const std::string& asked_as,
                         const SystemPlugin* system) {
      jobs.push_back({name + " on " + motion->name(),
                      [=] {
                        auto checks = check_method(*method, p, motion->name(), motion);
                        if (system == nullptr) return checks;
                        return with_control(std::move(checks), *method, p, *system);
                      },
                      {},
                      asked_as});
    };
    for (const auto& model : on) {
      const auto motion = motion_for(*method, model);
      if (const std::string reason = method->refuses(*motion); !reason.empty())
        throw InputError(reason + what_to_do(*method, *motion));
      add(motion, as_object(*model), nullptr);
    }
    if (!on.empty()) continue;
    jobs.push_back(
        {name + " on random systems", [=] { return check_on_random_systems(*method, p, 0, true); }});
    for (const SystemPlugin* system : pfaff::systems().all()) {
      const auto model = system->make({});
      const auto motion = motion_for(*method, model);
      if (model->initial().empty() || !method->refuses(*motion).empty()) continue;
      // What methods for vector fields do on constraints they claim nothing of.
      if (motion != model && !method->needs_constraints()) continue;
      add(motion, system->name(), system);
    }
  }
  return jobs;
}

}  // namespace pfaff
