#include <pfaff/verify/method_on_model.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/runs/history.hpp>
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

namespace {
// Checks that need Jacobians or Taylor series in quad are made only up to these dimensions, because their
// cost grows fast; smaller systems show the same.
constexpr int most_differentiated = 32, most_differentiated_in_formulations = 8;
constexpr int most_halvings = 12;

std::vector<Claim> claims_of(const MethodInstance& method, const Model& model) {
  std::vector<Claim> claims;
  for (Claim claim : claims_in_scope(method.preserves(model), model)) {
    if (claim == Claim::k_symplectic && in_scope(Claim::symplectic, model)) claim = Claim::symplectic;
    if (claim != Claim::none && std::find(claims.begin(), claims.end(), claim) == claims.end())
      claims.push_back(claim);
  }
  return claims;
}
}  // namespace

MethodOnModel::MethodOnModel(const MethodInstance& method, const Assignments& parameters,
                             const std::string& system, const std::shared_ptr<const Model>& model)
    : method_(method),
      parameters_(parameters),
      system_(system),
      model_(model),
      claims_(claims_of(method, *model)),
      start_(generic_state(*model)),
      time_(generic_time_of(*model)) {
  Real h = check_step * Real(own_time(*motion_of(model), time_, start_));
  std::vector<Quad> z;
  for (const Real& x : start_) z.push_back(x.quad());
  for (int halving = 0; halving <= most_halvings; ++halving, h = h * Real::fraction(1, 2)) {
    step_size_ = h;
    history_ = keeps_history(method, model, time_.quad(), h.quad(), z);
    const int warm_up = history_ ? steps_of_warm_up : 0;
    in_double_ = std::make_unique<MeasuredStep<double>>(method, model, start_, time_, h, warm_up);
    in_quad_ = std::make_unique<MeasuredStep<Quad>>(method, model, start_, time_, h, warm_up);
    failure_ = in_double_->status();
    if (failure_ == Status::converged) failure_ = in_quad_->status();
    // The derivative of a step takes more iterations than the step, and is judged as well.
    if (failure_ == Status::converged && !history_ && differentiable()) {
      failure_ = in_double_->jacobian().status;
      if (failure_ == Status::converged) failure_ = in_quad_->jacobian().status;
    }
    if (failure_ == Status::converged && ways_back_converge()) return;
  }
}

bool MethodOnModel::ways_back_converge() {
  const auto converge = [this](Claim claim, const auto& residual) {
    return !claims(claim) || !(std::isnan(residual(*in_double_)) || std::isnan(residual(*in_quad_)));
  };
  return converge(Claim::symmetric, [](auto& step) { return symmetry_residual(step); }) &&
         converge(Claim::reversible, [](auto& step) { return reversibility_residual(step); });
}

bool MethodOnModel::claims(Claim claim) const {
  return std::find(claims_.begin(), claims_.end(), claim) != claims_.end();
}

double MethodOnModel::growth_of_round_off() const {
  return std::sqrt(std::max(1.0, static_cast<double>(method_.coefficient_count()) / 25));
}

bool MethodOnModel::differentiable() const {
  const bool formulated = method_.needs().has(Facet::vector_field);
  return model_->dimension() <=
         (model_->restricted() && formulated ? most_differentiated_in_formulations : most_differentiated);
}

template <class T>
MeasuredStep<T> MethodOnModel::step_from(const std::vector<Real>& start, const Real& h) const {
  return {method_, model_, start, time_, h, history_ ? steps_of_warm_up : 0};
}
template MeasuredStep<double> MethodOnModel::step_from<double>(const std::vector<Real>&, const Real&) const;
template MeasuredStep<Quad> MethodOnModel::step_from<Quad>(const std::vector<Real>&, const Real&) const;

Check check_named(const MethodInstance& method, const Assignments& parameters, const std::string& system,
                  const std::string& claim, const std::string& scope, const char* precision) {
  Check check;
  check.plugin = method.descriptor().name;
  check.claim = claim;
  check.scope = scope;
  check.system = system;
  check.precision = precision;
  check.parameters = parameters;
  return check;
}

Check MethodOnModel::check(const std::string& claim, const std::string& scope, const char* precision) const {
  return check_named(method_, parameters_, system_, claim, scope, precision);
}

Check MethodOnModel::residual(const std::string& claim, const std::string& scope, bool claimed,
                              const char* precision, double value, double limit) const {
  Check check = this->check(claim, scope, precision);
  check.measured = value;
  check.tolerance = limit;
  check.in_scope = claimed;
  const bool holds = value <= limit;  // not-a-number does not
  check.result = !claimed ? CheckResult::measured : holds ? CheckResult::pass : CheckResult::fail;
  if (std::isnan(value)) check.reason = "the step did not converge";
  return check;
}

}  // namespace pfaff
