// The claims of order: measured as claimed, and lost when a coefficient is changed.
#include <cmath>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/verification/check_budget.hpp>
#include <pfaff/bench/verification/claim_checks.hpp>
#include <pfaff/bench/verification/method_on_model.hpp>

namespace pfaff {

namespace {
// A method of odd order that happens to be symmetric on a system has an even order there, one higher. It
// happens to symplectic Euler on heisenberg-geodesic, where H_p.H_q = 0.
bool symmetric_by_chance(MethodOnModel& on, double order) {
  return std::fmod(order, 2) == 1 && !on.claims(Claim::symmetric) &&
         symmetry_residual(on.step<Quad>()) <= tolerance<Quad>();
}
}  // namespace

Check check_order(MethodOnModel& on, bool conditions_judge) {
  const MethodInstance& method = on.method();
  const Model& model = *on.model();
  const bool doubles = on.double_coefficients();
  Check check = on.check("order", "every system", doubles ? "double" : "quad");
  check.expected = method.order(model);
  check.tolerance = 0.1;
  if (check.expected <= 0) {
    check.result = CheckResult::fail;
    check.reason = "the order claimed is not positive: the descriptor's, or that of order(model)";
    return check;
  }
  const MeasuredOrder order = measure_order(method, on.model(), on.history());
  check.measured = order.slope;
  const bool low = !(order.slope >= check.expected - check.tolerance);
  if (low && order.exact) {
    check.in_scope = false;
    check.reason = "exact on this motion: no error is above round-off";
    return check;
  }
  if (!order.reason.empty()) {
    check.result = CheckResult::fail;
    check.reason = order.reason;
    return check;
  }
  // A slope above the claimed order fails only where the true slope cannot exceed the order: on a structure
  // that depends on time (nu = 0.3), and, for a method that claims its order to be exact, everywhere. On
  // other systems symmetries can remove the leading error, and a method may do better than it claims. A slope
  // that has not settled before round-off comes is an extrapolation, which may be too high by some tenths.
  const bool nonautonomous = model.facets().has(Facet::darboux_chart) && !model.chart_autonomous();
  const bool both_sides = (nonautonomous || method.order_is_exact()) && order.settled && !doubles &&
                          !method.order_is_lower_bound();
  // On fast motions, the errors of high orders are at round-off before their slopes have settled. The order
  // conditions judge there, which are measured with short series and not with short steps.
  if (low && !order.settled && conditions_judge) {
    check.in_scope = false;
    check.reason = "the slope has not settled when round-off comes; the order conditions judge";
    return check;
  }
  bool high = both_sides && order.slope > check.expected + check.tolerance;
  if (high && symmetric_by_chance(on, check.expected)) {
    high = order.slope > check.expected + 1 + check.tolerance;
    check.result = low || high ? CheckResult::fail : CheckResult::pass;
    check.reason = "symmetric on this system, and so of the next even order";
    return check;
  }
  check.result = low || high ? CheckResult::fail : CheckResult::pass;
  if (both_sides) check.reason = "both sides";
  return check;
}

std::vector<Check> check_changed_coefficient(const MethodPlugin& plugin, const Assignments& parameters,
                                             const SystemPlugin& system) {
  const auto method = plugin.make(parameters);
  const auto model = motion_for(*method, system.make({}));
  const bool history = MethodOnModel(*method, parameters, system.name(), model).history();
  std::vector<Check> checks;
  for (std::size_t k = 0; k < method->coefficient_count(); ++k) {
    const auto changed = method->with_changed_coefficient(k, Quad(1e-6));
    Check check;
    check.plugin = plugin.name();
    check.claim = "order with coefficient " + std::to_string(k) + " changed by 1e-6";
    check.scope = "control";
    check.system = system.name();
    check.precision = "quad";
    check.parameters = parameters;
    check.control = true;
    check.expected = method->order(*model);
    check.tolerance = 0.1;
    check = within_budget(check, [&] {
      check.measured = order_at_small_steps(*changed, model, history);
      return check;
    });
    if (ran_out(check)) {
      checks.push_back(std::move(check));
      continue;
    }
    check.result =
        check.measured < check.expected - check.tolerance ? CheckResult::rejected : CheckResult::pass;
    if (check.result == CheckResult::pass && StructureResidual<Quad>::applies(*model)) {
      // The method keeps its order with this coefficient changed; then it must lose its structure.
      std::vector<Quad> z;
      for (const Real& x : generic_state(*model)) z.push_back(x.quad());
      StructureResidual<Quad> residual(*changed, model);
      const Quad value = residual(generic_time_of(*model).quad(), check_step.quad(), z);
      check.claim = "structure with coefficient " + std::to_string(k) + " changed by 1e-6";
      check.measured = static_cast<double>(value);
      check.expected = 0;
      check.tolerance = tolerance<Quad>();
      if (!(value <= Quad(check.tolerance))) check.result = CheckResult::rejected;
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace pfaff
