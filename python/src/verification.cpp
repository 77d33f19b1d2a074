// Verification and falsification: the checks of `pfaff verify` and the search of `pfaff falsify`, of names
// and of objects.
#include <pybind11/stl.h>

#include <optional>

#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/json_value.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/falsification/falsify.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {

using Methods = std::vector<std::pair<PyMethod, Assignments>>;

// Every check as a dictionary, and what they come to.
py::tuple verified(const std::vector<Check>& checks) {
  py::list list;
  for (const Check& check : checks) {
    py::object one = python_value(to_json(check));
    one["good"] = good(check);
    one["not_judged"] = unjudged(check);
    list.append(one);
  }
  const Verdict verdict = verdict_of(checks);
  return py::make_tuple(list, verdict.ok, verdict.line);
}

// What check() gives. Where it is interrupted, `made` gets what was checked by then.
template <class Checking>
py::tuple verified_with(const Checking& check, py::list made) {
  std::optional<std::vector<Check>> by_then;
  try {
    return verified(without_lock([&] {
      try {
        return check();
      } catch (const VerificationInterrupted& end) {
        by_then = end.checks;
        throw;
      }
    }));
  } catch (...) {
    if (by_then) made.append(verified(*by_then));
    throw;
  }
}

py::tuple verify_names(std::vector<std::string> names, Assignments parameters, bool full, py::list made) {
  VerificationSettings settings;
  settings.names = std::move(names);
  settings.set = std::move(parameters);
  settings.full = full;
  return verified_with([&] { return verify(settings); }, std::move(made));
}

std::vector<std::shared_ptr<const Model>> models_of(const std::vector<PySystem>& systems) {
  std::vector<std::shared_ptr<const Model>> models;
  for (const PySystem& system : systems) models.push_back(system.model);
  return models;
}

py::tuple verify_objects(const Methods& methods, const std::vector<PySystem>& systems,
                         const std::vector<PySystem>& on, py::list made) {
  std::vector<MethodToVerify> under_test;
  for (const auto& [method, parameters] : methods) under_test.push_back({method.method, parameters});
  return verified_with([&] { return verify(under_test, models_of(systems), models_of(on)); },
                       std::move(made));
}

py::dict in_python(const FalsificationResult& result) {
  py::dict one;
  one["method"] = result.test.method->descriptor().name;
  one["claim"] = std::string(to_string(result.test.claim));
  one["claimed"] = result.test.made;
  one["tried"] = result.tried;
  one["parameters"] = result.test.parameters;
  one["counterexample"] = py::none();
  if (!result.counterexample) return one;
  const Counterexample& found = *result.counterexample;
  py::dict example;
  example["name"] = named_system(result.test, found).name;
  example["dimension"] = found.recipe.dimension;
  example["step"] = to_string(found.at.step);
  example["steps"] = found.at.count;
  example["time"] = to_string(found.at.time);
  example["residuals"] = found.judgement.residuals;
  example["residual_in_double"] = found.judgement.in_double;
  example["exponent"] = found.judgement.exponent;
  example["model"] =
      model_text_of(result.test, found, "pfaff falsify " + showing_arguments(result.test, found));
  one["counterexample"] = example;
  return one;
}

// A method by its name has the parameters of verification and some drawn near them, an object its own.
py::list falsify_method(const std::optional<PyMethod>& method, const std::string& name,
                        const Assignments& parameters, const std::string& claim, double budget,
                        std::optional<std::uint64_t> systems, std::uint64_t seed) {
  FalsificationSettings settings;
  settings.seed = seed;
  settings.budget = budget;
  if (systems) settings.systems = *systems;
  std::optional<Claim> chosen;
  if (!claim.empty()) chosen = claim_named(claim);
  const auto results = without_lock([&] {
    std::vector<ClaimUnderTest> tests =
        method ? claims_under_test(method->method, parameters, chosen)
               : claims_under_test(integrator_asked_for(name), parameters, chosen, seed);
    return falsify(std::move(tests), settings, [](const std::string&, double) {});
  });
  py::list list;
  for (const FalsificationResult& result : results) list.append(in_python(result));
  return list;
}

}  // namespace

void bind_verification(py::module_& module) {
  module.def("verify_names", &verify_names);
  module.def("verify_objects", &verify_objects);
  module.def("falsify", &falsify_method);
}

}  // namespace pfaff::python
