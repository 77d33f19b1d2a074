// The claims of methods: order, structure, symmetry, invariants, agreement of precisions, the step's
// Jacobian.
#include <algorithm>
#include <cmath>

#include <pfaff/bench/measure/constraints.hpp>
#include <pfaff/bench/measure/scope.hpp>
#include <pfaff/bench/measure/structure.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/verification/check.hpp>

namespace pfaff {

namespace {

// Steps at which claims are measured: small enough for every implicit solve, those of the longest sub-steps
// of compositions included (five times the step and more), large enough to show a false claim.
const Real check_step = Real::fraction(1, 20);
// Beyond this dimension what needs Jacobians or Taylor series in quad is left to smaller systems.
constexpr int most_differentiated = 16, most_differentiated_in_formulations = 8;

template <class T>
std::vector<T> state_of(const Model& model) {
  std::vector<T> z;
  for (const Real& x : generic_state(model)) z.push_back(T(x));
  return z;
}

// Round-off that a step may show: 1e-14 in double and 1e-31 in quad, the accuracy the reference values are
// held to; about 100 and 1000 units of round-off, for sums over stages and the conditioning of a step.
template <class T>
constexpr double tolerance() {
  return std::is_same_v<T, Quad> ? 1e-31 : 1e-14;
}
template <class T>
constexpr const char* precision_name() {
  return std::is_same_v<T, Quad> ? "quad" : "double";
}

template <class T>
T norm_of(const std::vector<T>& z) {
  T largest(0);
  for (const T& x : z) largest = std::max(largest, abs(x));
  return largest;
}

class MethodChecker {
 public:
  MethodChecker(const MethodPlugin& plugin, const Assignments& parameters, const SystemPlugin& system)
      : plugin_(plugin),
        method_(plugin.make(parameters)),
        system_(system),
        model_(motion_for(*method_, system.make({}))) {
    parameters_ = parameters;
    claims_ = claims_in_scope(*method_, *model_);
  }

  std::vector<Check> run() {
    const bool formulated = method_->needs().has(Facet::vector_field);
    const bool differentiated =
        !model_->constrained() ||
        model_->dimension() <= (formulated ? most_differentiated_in_formulations : most_differentiated);
    if (differentiated) order();
    if (plugin_.descriptor().double_coefficients) {
      exempt_from_quad();
    } else {
      precisions_agree();
      if (differentiated) {
        jacobian();
        structure<Quad>();
      }
      kept_by_a_step<Quad>();
    }
    if (differentiated) structure<double>();
    kept_by_a_step<double>();
    return std::move(checks_);
  }

 private:
  [[nodiscard]] bool claims(Claim claim) const {
    return std::find(claims_.begin(), claims_.end(), claim) != claims_.end();
  }
  Check& add(const std::string& claim, const std::string& scope, const char* precision) {
    Check check;
    check.plugin = plugin_.name();
    check.claim = claim;
    check.scope = scope;
    check.system = system_.name();
    check.precision = precision;
    check.parameters = parameters_;
    checks_.push_back(std::move(check));
    return checks_.back();
  }
  // A residual that must be at round-off where the claim is made, and is shown where it is not.
  void residual(const std::string& claim, const std::string& scope, bool in_scope, const char* precision,
                double value, double limit) {
    Check& check = add(claim, scope, precision);
    check.measured = value;
    check.tolerance = limit;
    check.in_scope = in_scope;
    const bool holds = value <= limit;
    check.result = !in_scope ? CheckResult::measured : holds ? CheckResult::pass : CheckResult::fail;
    if (std::isnan(value)) {
      check.result = in_scope ? CheckResult::fail : CheckResult::measured;
      check.reason = "the step did not converge";
    }
  }

  void order() {
    const bool doubles = plugin_.descriptor().double_coefficients;
    Check& check = add("order", "every system", doubles ? "double" : "quad");
    check.expected = method_->order(*model_);
    check.tolerance = 0.1;
    const MeasuredOrder order = measure_order(*method_, model_);
    check.measured = order.slope;
    if (!order.reason.empty()) {
      check.result = CheckResult::fail;
      check.reason = order.reason;
      return;
    }
    // Exactly the order where nothing can add to it: a structure that depends on time (nu = 0.3), and the
    // extra order of odd generating functions. Elsewhere a method may do better than it claims.
    const bool nonautonomous = model_->facets().has(Facet::darboux_chart) && !model_->chart_autonomous();
    const bool gained = plugin_.name() == "generating-function" && !nonautonomous;
    const bool both_sides = (nonautonomous || gained) && !doubles && !method_->order_is_lower_bound();
    const bool low = !(order.slope >= check.expected - check.tolerance);
    const bool high = both_sides && order.slope > check.expected + check.tolerance;
    check.result = low || high ? CheckResult::fail : CheckResult::pass;
    if (both_sides) check.reason = "both sides";
  }

  // Coefficients in double keep a method from round-off in quad: nothing is claimed of it there.
  void exempt_from_quad() {
    std::vector<std::string> exempt{"double-is-quad-rounded", "step-jacobian"};
    for (const Claim claim : claims_)
      if (claim != Claim::none) exempt.emplace_back(to_string(claim));
    for (const std::string& claim : exempt) {
      Check& check = add(claim, "coefficients in quad", precision_name<Quad>());
      check.in_scope = false;
      check.reason = "the method's coefficients are in double";
    }
  }

  void precisions_agree() {
    std::vector<double> z = state_of<double>(*model_);
    std::vector<Quad> quad(z.begin(), z.end());
    std::int64_t completed = 0;
    const double t = generic_time.value(), h = check_step.value();
    (void)method_->stepper(model_, double())->advance(t, 0, h, 1, z, completed);
    (void)method_->stepper(model_, Quad())->advance(Quad(t), 0, Quad(h), 1, quad, completed);
    Quad difference(0);
    for (std::size_t k = 0; k < z.size(); ++k) difference = std::max(difference, abs(Quad(z[k]) - quad[k]));
    residual("double-is-quad-rounded", "every system", true, "double",
             static_cast<double>(difference / std::max(Quad(1), norm_of(quad))), tolerance<double>());
  }

  // The Jacobian of the converged step against central differences of order 4 in quad: error delta^4 +
  // u/delta. Steps return to the constraint surface along directions that turn fast: smaller differences
  // there.
  void jacobian() {
    const std::vector<Quad> z = state_of<Quad>(*model_);
    const Quad t(generic_time), h(check_step), delta(model_->constrained() ? 2e-8 : 1e-7);
    const StepJacobian<Quad> step = StepDifferentiator<Quad>(*method_, model_)(t, h, z);
    const auto stepper = method_->stepper(model_, Quad());
    Quad worst(0);
    const std::size_t n = z.size();
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<Quad> slope(n);
      for (const int offset : {-2, -1, 1, 2}) {
        std::vector<Quad> moved = z;
        moved[j] += Quad(offset) * delta;
        stepper->forget();
        std::int64_t completed = 0;
        (void)stepper->advance(t, 0, h, 1, moved, completed);
        const Quad weight = Quad(offset == 2 ? -1 : offset == 1 ? 8 : offset == -1 ? -8 : 1) / Quad(12);
        for (std::size_t i = 0; i < n; ++i) slope[i] += weight * moved[i] / delta;
      }
      for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, abs(slope[i] - step.jacobian[i * n + j]));
    }
    residual("step-jacobian", "every system", true, "quad",
             static_cast<double>(worst / std::max(Quad(1), norm_of(step.jacobian))), 1e-24);
  }

  template <class T>
  void kept_by_a_step() {
    symmetry<T>();
    invariants<T>(Claim::quadratic_invariants, "quadratic invariants");
    if (!model_->constrained()) return;
    invariants<T>(Claim::momentum_maps, "quadratic invariants p^T D q");
    constraints<T>();
  }

  template <class T>
  void structure() {
    if (!StructureResidual<T>::applies(*model_)) return;
    const bool structured = model_->facets().has(Facet::structure);
    const bool charted = model_->facets().has(Facet::darboux_chart);
    const bool constrained = model_->facets().has(Facet::holonomic);
    const bool in_scope = constrained ? claims(Claim::constrained_symplectic)
                                      : claims(Claim::symplectic) || claims(Claim::k_symplectic);
    const std::string claim = constrained  ? "constrained-symplectic"
                              : structured ? "K-symplectic"
                              : charted    ? "symplectic"
                                           : "poisson";
    const std::string scope = constrained  ? "holonomic constraints"
                              : structured ? "Darboux chart or alpha"
                              : charted    ? "canonical structure"
                                           : "linear Pi";
    StructureResidual<T> residual_of(*method_, model_);
    const T value = residual_of(T(generic_time), T(check_step), state_of<T>(*model_));
    // Sub-steps of compositions round independently, their coefficients being as many: measured over 41
    // steps, residuals grow as the square root, and 25 of them stay within the tolerance.
    const double parts = static_cast<double>(method_->coefficient_count()) / 25;
    residual(claim, scope, in_scope, precision_name<T>(), static_cast<double>(value),
             tolerance<T>() * std::sqrt(std::max(1.0, parts)));
  }

  template <class T>
  void symmetry() {
    const auto stepper = method_->stepper(model_, T());
    const std::vector<T> start = state_of<T>(*model_);
    std::vector<T> z = start;
    std::int64_t completed = 0;
    const T t(generic_time), h(check_step);
    Status status = stepper->advance(t, 0, h, 1, z, completed);
    stepper->forget();
    if (status == Status::converged) status = stepper->advance(t + h, 0, -h, 1, z, completed);
    T distance(0);
    for (std::size_t k = 0; k < z.size(); ++k) distance = std::max(distance, abs(z[k] - start[k]));
    const double value = status == Status::converged
                             ? static_cast<double>(distance / std::max(T(1), norm_of(start)))
                             : std::numeric_limits<double>::quiet_NaN();
    residual("symmetric", "every system", claims(Claim::symmetric), precision_name<T>(), value,
             tolerance<T>());
  }

  // The invariants that a claim speaks of.
  template <class T>
  void invariants(Claim claim, const std::string& scope) {
    const auto& list = model_->invariants();
    std::vector<std::size_t> meant;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (claim == Claim::momentum_maps ? momentum_map(*model_, k)
                                        : list[k].quadratic && list[k].behaviour == Behaviour::conserved)
        meant.push_back(k);
    if (meant.empty()) return;
    const Problem<T> problem(model_);
    const auto stepper = method_->stepper(model_, T());
    std::vector<T> z = state_of<T>(*model_), before(list.size()), after(list.size());
    problem.invariants(T(generic_time), z, before);
    std::int64_t completed = 0;
    (void)stepper->advance(T(generic_time), 0, T(check_step), 1, z, completed);
    problem.invariants(T(generic_time) + T(check_step), z, after);
    T worst(0);
    for (const std::size_t k : meant)
      worst = std::max(worst, abs(after[k] - before[k]) / std::max(T(1), abs(before[k])));
    residual(std::string(to_string(claim)), scope, claims(claim), precision_name<T>(),
             static_cast<double>(worst), tolerance<T>());
  }

  // Both levels of constraints after a step, relative to the squares of the state.
  template <class T>
  void constraints() {
    const auto stepper = method_->stepper(model_, T());
    std::vector<T> z = state_of<T>(*model_), residuals;
    const T size = std::max(T(1), norm_of(z));
    std::int64_t completed = 0;
    const T t(generic_time), h(check_step);
    const Status status = stepper->advance(t, 0, h, 1, z, completed);
    ConstraintResiduals<T> residuals_of(*model_);
    residuals_of(t + h, z, residuals);
    T worst(0);
    for (const T& x : residuals) worst = isnan(x) ? x : std::max(worst, x);
    const double value = status == Status::converged ? static_cast<double>(worst / (size * size))
                                                     : std::numeric_limits<double>::quiet_NaN();
    residual("constraints", "holonomic constraints", claims(Claim::constraints), precision_name<T>(), value,
             tolerance<T>());
  }

  const MethodPlugin& plugin_;
  std::unique_ptr<MethodInstance> method_;
  const SystemPlugin& system_;
  std::shared_ptr<const Model> model_;
  Assignments parameters_;
  std::vector<Claim> claims_;
  std::vector<Check> checks_;
};

}  // namespace

std::vector<Check> check_method(const MethodPlugin& plugin, const Assignments& parameters,
                                const SystemPlugin& system) {
  return MethodChecker(plugin, parameters, system).run();
}

std::vector<Check> check_changed_coefficient(const MethodPlugin& plugin, const Assignments& parameters,
                                             const SystemPlugin& system) {
  const auto method = plugin.make(parameters);
  const auto model = motion_for(*method, system.make({}));
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
    check.measured = order_at_small_steps(*changed, model);
    check.result =
        check.measured < check.expected - check.tolerance ? CheckResult::rejected : CheckResult::pass;
    if (check.result == CheckResult::pass && StructureResidual<Quad>::applies(*model)) {
      // The order survives; the structure must not.
      std::vector<Quad> z;
      for (const Real& x : generic_state(*model)) z.push_back(x.quad());
      StructureResidual<Quad> residual(*changed, model);
      const Quad value = residual(generic_time.quad(), check_step.quad(), z);
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
