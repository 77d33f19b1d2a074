// Runs the checks: what there is to do, in parallel, in a fixed order of results.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include <pfaff/bench/measure/constraints.hpp>
#include <pfaff/bench/measure/structure.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/formulation.hpp>

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

std::vector<Real> generic_state(const Model& model) {
  if (model.initial().size() != static_cast<std::size_t>(model.dimension()))
    throw InputError("system " + model.name() + " has " + std::to_string(model.initial().size()) +
                     " initial values, near which its claims are measured; expected " +
                     std::to_string(model.dimension()));
  std::vector<Real> z = model.initial();
  for (std::size_t k = 0; k < z.size(); ++k) {
    const auto i = static_cast<std::int64_t>(k);
    // Systems of many bodies would be torn apart by numbers that grow with the index.
    const std::int64_t amount = model.constrained() ? i % 5 : i;
    z[k] = z[k] + Real::fraction(i % 2 == 0 ? 7 + 2 * amount : -5 - 3 * amount, 101);
  }
  if (model.constrained()) {
    std::vector<Quad> moved;
    for (const Real& x : z) moved.push_back(x.quad());
    const auto projection = project_onto_constraints(model, generic_time.quad(), moved);
    if (projection.status != Status::converged)
      throw InputError("system " + model.name() +
                       ": no state on its constraints was found near its initial state (" +
                       std::string(to_string(projection.status)) + ")");
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = Real(moved[k]);
  }
  return z;
}

std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model) {
  if (!model->constrained() || model->facets().has(Facet::vector_field)) return model;
  return formulations().get("dirac", "formulation").apply(model, {});
}

std::vector<Check> check_false_methods() {
  std::vector<Check> checks;
  const auto control = [&](const std::string& plugin, const std::string& claim,
                           const std::string& system) -> Check& {
    Check check;
    check.plugin = plugin;
    check.claim = claim;
    check.scope = "control";
    check.system = system;
    check.precision = "quad";
    check.control = true;
    checks.push_back(check);
    return checks.back();
  };
  const auto decide = [](Check& check) {
    check.result = check.measured <= check.tolerance ? CheckResult::pass : CheckResult::rejected;
  };
  for (const auto& [name, claim] :
       {std::pair{"pendulum", "symplectic"}, std::pair{"damped-pendulum", "K-symplectic"}}) {
    const auto model = systems().get(name, "system").make({});
    const auto method = integrators().get("rk4", "integrator").make({});
    std::vector<Quad> z;
    for (const Real& x : generic_state(*model)) z.push_back(x.quad());
    Check& check = control("rk4", claim, name);
    check.measured =
        static_cast<double>(StructureResidual<Quad>(*method, model)(generic_time.quad(), Quad(0.1), z));
    check.tolerance = 1e-31;
    decide(check);
  }
  {  // RK4 in Dirac's formulation leaves the surface, and is not symplectic on it.
    const auto method = integrators().get("rk4", "integrator").make({});
    const auto model = motion_of(systems().get("spherical-pendulum", "system").make({}));
    std::vector<Quad> z;
    for (const Real& x : generic_state(*model)) z.push_back(x.quad());
    Check& symplectic = control("rk4", "constrained-symplectic", model->name());
    symplectic.measured =
        static_cast<double>(StructureResidual<Quad>(*method, model)(generic_time.quad(), Quad(0.1), z));
    symplectic.tolerance = 1e-31;
    decide(symplectic);
    std::int64_t completed = 0;
    (void)method->stepper(model, Quad())->advance(generic_time.quad(), 0, Quad(0.1), 1, z, completed);
    std::vector<Quad> residuals;
    ConstraintResiduals<Quad> residuals_of(*model);
    residuals_of(generic_time.quad() + Quad(0.1), z, residuals);
    Check& constraints = control("rk4", "constraints", model->name());
    constraints.measured = static_cast<double>(*std::max_element(residuals.begin(), residuals.end()));
    constraints.tolerance = 1e-31;
    decide(constraints);
  }
  // su-qin (105) as printed, -8 a e^{-nu tau} instead of -8 b e^{-nu tau}: its determinant is not e^{-nu
  // tau}, and it leaves an error of order tau^2 against the exact transition matrix, whose lower left entry
  // is -e^{-nu tau/2} sin(w tau)/w with w^2 = 1 - nu^2/4.
  const Quad nu(Real::fraction(3, 10));
  const auto lower_left = [&](Quad tau) {
    const Quad a = Quad(2) * tau - nu * tau * tau, b = Quad(2) * tau + nu * tau * tau;
    return -Quad(8) * a * exp(-(nu * tau)) / (Quad(16) + a * b);
  };
  const Quad tau(0.1);
  const Quad a = Quad(2) * tau - nu * tau * tau, b = Quad(2) * tau + nu * tau * tau, d = Quad(16) + a * b;
  const Quad decay = exp(-(nu * tau));
  const Quad determinant =
      (Quad(16) - a * b) / d * ((Quad(16) - a * b) / d) * decay - Quad(8) * a / d * lower_left(tau);
  Check& structure = control("su-qin (105) as printed", "K-symplectic", "damped-oscillator");
  structure.measured = static_cast<double>(abs(determinant - decay));
  structure.tolerance = 1e-31;
  decide(structure);
  const Quad w = sqrt(Quad(1) - nu * nu / Quad(4));
  const auto error = [&](Quad h) { return abs(lower_left(h) + exp(-(nu * h) / Quad(2)) * sin(w * h) / w); };
  Check& order = control("su-qin (105) as printed", "order", "damped-oscillator");
  order.expected = 2;
  order.tolerance = 0.1;
  order.measured = static_cast<double>(log(error(Quad(1e-4)) / error(Quad(1e-5))) / log(Quad(10))) - 1;
  order.result =
      order.measured < order.expected - order.tolerance ? CheckResult::rejected : CheckResult::pass;
  return checks;
}

namespace {
struct Job {
  std::string what;
  std::function<std::vector<Check>()> run;
};

// Beyond this dimension the derivatives of formulated fields in quad are more than a check should cost.
constexpr int most_formulated = 8;

// Controls need a nonlinear system that fits: the damped pendulum for chart methods, the spherical pendulum
// for those that need constraints, the pendulum for the rest.
std::string controlled_on(const MethodPlugin& method) {
  const auto instance = method.make({});
  for (const char* name : {"damped-pendulum", "pendulum"})
    if (instance->refuses(*systems().get(name, "").make({})).empty()) return name;
  return "spherical-pendulum";
}

std::vector<Job> jobs_of(const std::vector<std::string>& names, bool full) {
  const auto wanted = [&](const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<Job> jobs;
  for (const SystemPlugin* system : systems().all())
    if (wanted(system->name()) || wanted("systems"))
      jobs.push_back({system->name(), [system] { return check_system(*system); }});
  for (const BracketPlugin* bracket : brackets().all())
    if (wanted(bracket->name()) || wanted("brackets"))
      jobs.push_back({bracket->name(), [bracket] { return check_bracket(bracket->name()); }});
  if (wanted("brackets") || wanted("controls")) jobs.push_back({"false brackets", check_false_brackets});
  if (wanted("systems") || wanted("controls")) {
    jobs.push_back({"false structures", check_false_structures});
    jobs.push_back({"false constraints", check_false_constraints});
    jobs.push_back({"false metriplectic systems", check_false_metriplectic});
  }
  if (wanted("rk4") || wanted("integrators") || wanted("controls"))
    jobs.push_back({"false methods", check_false_methods});
  for (const MethodPlugin* method : integrators().all()) {
    const std::string nonlinear = controlled_on(*method);
    for (const SystemPlugin* system : systems().all()) {
      const bool named = wanted(method->name()) && !names.empty();
      if (!wanted(method->name()) && !wanted(system->name()) && !wanted("integrators")) continue;
      const auto model = system->make({});
      for (const Assignments& parameters : method->instances(full)) {
        const auto instance = method->make(parameters);
        const auto motion = motion_for(*instance, model);
        if (!instance->refuses(*motion).empty()) continue;
        // Methods for vector fields claim nothing of constraints: in a quick check one system with
        // constraints shows what they do there.
        const bool in_passing = motion != model && !instance->needs().has(Facet::holonomic);
        if (in_passing && !full && !named &&
            (system->name() != "spherical-pendulum" || parameters != method->instances(full).front()))
          continue;
        if (in_passing && model->dimension() > most_formulated) continue;
        std::string what = method->name();
        for (const auto& [key, value] : parameters) what += " " + key + "=" + value;
        what += " on " + system->name();
        jobs.push_back({what, [=] {
                          auto checks = check_method(*method, parameters, *system);
                          if (system->name() == nonlinear)
                            for (Check& check : check_changed_coefficient(*method, parameters, *system))
                              checks.push_back(std::move(check));
                          return checks;
                        }});
      }
    }
  }
  return jobs;
}
}  // namespace

std::vector<Check> verify(const std::vector<std::string>& names, bool full,
                          const std::function<void(const std::string&, std::size_t, std::size_t)>& progress) {
  std::vector<std::string> known{"systems", "brackets", "integrators", "controls"};
  for (const auto& more : {systems().names(), integrators().names(), brackets().names()})
    known.insert(known.end(), more.begin(), more.end());
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(unknown_name("name", name, known));
  const std::vector<Job> jobs = jobs_of(names, full);
  std::vector<std::vector<Check>> results(jobs.size());
  std::mutex mutex;
  std::size_t done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t k) {
    results[k] = jobs[k].run();
    const std::lock_guard lock(mutex);
    if (progress) progress(jobs[k].what, ++done, jobs.size());
  });
  std::vector<Check> all;
  for (auto& part : results) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace pfaff
