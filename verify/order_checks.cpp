// The claims of order: measured as claimed, and lost when a coefficient is changed.
#include <cmath>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

Check check_order(MethodOnModel& on) {
  const MethodInstance& method = on.method();
  const Model& model = *on.model();
  Check check = on.check("order", "every system", on.double_coefficients() ? "double" : "quad");
  check.expected = method.order(model);
  check.tolerance = 0.1;
  if (check.expected <= 0) {
    check.result = CheckResult::fail;
    check.reason = "the order claimed is not positive: the descriptor's, or that of order(model)";
    return check;
  }
  const MeasuredOrder order = measure_order(method, on.model(), on.history());
  check.measured = order.slope;
  // A claimed order is a bound from below. Symmetries of a system remove leading errors: symplectic Euler is
  // of order 2 on heisenberg-geodesic, where H_p.H_q = 0.
  if (order.settled) {
    const bool low = !(order.slope >= check.expected - check.tolerance);
    check.result = low ? CheckResult::fail : CheckResult::pass;
    if (order.backwards)
      check.reason = "backwards in time, h < 0";
    else if (order.forwards_alone)
      check.reason = "of steps forwards alone: errors of steps back settle at no order";
    else if (order.slope > check.expected + 0.5)
      check.reason = "more than claimed on this system";
    return check;
  }
  // Slopes that were still moving show an order where they are far enough from what is claimed.
  const double claimed = check.expected - check.tolerance;
  if (!order.exact && order.moving > 0 &&
      (order.slope + 3 * order.moving < claimed || order.slope - 3 * order.moving >= claimed)) {
    check.result = order.slope < claimed ? CheckResult::fail : CheckResult::pass;
    check.reason = "the slope was still moving when round-off came";
    return check;
  }
  return not_judged(std::move(check),
                    order.exact ? "exact on this motion: no error is above round-off" : order.reason);
}

std::vector<Check> check_changed_coefficient(const MethodInstance& method, const Assignments& parameters,
                                             const SystemPlugin& system) {
  const auto model = motion_for(method, system.make({}));
  const bool history = MethodOnModel(method, parameters, system.name(), model).history();
  std::vector<Check> checks;
  for (std::size_t k = 0; k < method.coefficient_count(); ++k) {
    const auto changed = method.with_changed_coefficient(k, Quad(1e-6));
    Check check;
    check.plugin = method.descriptor().name;
    check.claim = "order with coefficient " + std::to_string(k) + " changed by 1e-6";
    check.scope = "control";
    check.system = system.name();
    check.precision = "quad";
    check.parameters = parameters;
    check.control = true;
    check.expected = method.order(*model);
    check.tolerance = 0.1;
    check = within_budget(check, [&] {
      check.measured = order_at_small_steps(*changed, model, history);
      return check;
    });
    if (unjudged(check)) {
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
