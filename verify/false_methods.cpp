// Controls of methods: for every claim a method that makes it falsely, and a scheme with a misprint as it was
// printed.
#include <cmath>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/method_on_model.hpp>

namespace pfaff {

namespace {

// Twice the step that claims are measured with, so that a false claim shows more clearly.
const Real control_step(Quad(0.1));

Check false_claim(const std::string& plugin, std::string_view claim, const std::string& system,
                  const char* precision = precision_name<Quad>(), double limit = tolerance<Quad>()) {
  Check check;
  check.plugin = plugin;
  check.claim = claim;
  check.scope = "control";
  check.system = system;
  check.precision = precision;
  check.control = true;
  check.tolerance = limit;
  return check;
}

// Decides a control by its measured value. A step that failed gives not-a-number and so does not count as
// rejected, since it has shown nothing about the claim.
void decide(Check& check) {
  check.result = check.measured > check.tolerance ? CheckResult::rejected : CheckResult::pass;
}

template <class T>
Check check_false_claim(const ClaimCheck& row) {
  const FalseClaim& control = row.control;
  Assignments settings, parameters;
  if (!control.method_key.empty()) settings.emplace_back(control.method_key, control.method_value);
  if (!control.key.empty()) parameters.emplace_back(control.key, control.value);
  const auto method = integrators().get(control.method, "integrator").make(settings);
  const auto model = control.model != nullptr
                         ? control.model()
                         : motion_for(*method, systems().get(control.system, "system").make(parameters));
  std::string system(control.system);
  for (const auto& [key, value] : parameters) system += " " + key + "=" + value;
  Check check = false_claim(std::string(control.method), to_string(row.claim), system, precision_name<T>(),
                            largest_allowed<T>(row));
  check.parameters = settings;
  if (!in_scope(row.claim, *model)) {
    check.reason = "the system is not in the scope of the claim";
    check.result = CheckResult::pass;
    return check;
  }
  MeasuredStep<T> step(*method, model, generic_state(*model), generic_time_of(*model), control_step);
  check.measured = residual_of(row, step);
  decide(check);
  return check;
}

// su-qin (105) as printed, -8 a e^{-nu tau} instead of -8 b e^{-nu tau}: its determinant is not e^{-nu tau},
// and it leaves an error of order tau^2 against the exact transition matrix, whose lower left entry is
// -e^{-nu tau/2} sin(w tau)/w with w^2 = 1 - nu^2/4.
std::vector<Check> check_printed_scheme() {
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
  Check structure = false_claim("su-qin (105) as printed", "K-symplectic", "damped-oscillator");
  structure.measured = static_cast<double>(abs(determinant - decay));
  decide(structure);
  const Quad w = sqrt(Quad(1) - nu * nu / Quad(4));
  const auto error = [&](Quad h) { return abs(lower_left(h) + exp(-(nu * h) / Quad(2)) * sin(w * h) / w); };
  Check order = false_claim("su-qin (105) as printed", "order", "damped-oscillator");
  order.expected = 2;
  order.tolerance = 0.1;
  order.measured = static_cast<double>(log(error(Quad(1e-4)) / error(Quad(1e-5))) / log(Quad(10))) - 1;
  order.result =
      order.measured < order.expected - order.tolerance ? CheckResult::rejected : CheckResult::pass;
  return {structure, order};
}

}  // namespace

std::vector<Check> check_false_methods() {
  std::vector<Check> checks;
  for (const ClaimCheck& row : claim_checks())
    checks.push_back(row.of_rounding ? check_false_claim<double>(row) : check_false_claim<Quad>(row));
  for (auto controls : {check_false_processors(), check_printed_scheme()})
    for (Check& check : controls) checks.push_back(std::move(check));
  return checks;
}

}  // namespace pfaff
