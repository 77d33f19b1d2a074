// Claims about numbers that a step conserves, or changes in one direction only.
#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

// The largest change over the step among those values of a formula for which `meant` is true, each relative
// to what the rounding of the step and of the formula's own terms amounts to in it.
template <class T, class Meant>
double largest_change(MeasuredStep<T>& step, Formula formula, const Meant& meant) {
  if (!step.end()) return no_step;
  Replay<WithRounding<T>> values(step.model()->tape(formula));
  const auto before = with_rounding<T>(values, step.t(), step.start(), step.scales());
  const auto after = with_rounding<T>(values, step.t() + step.h(), *step.end(), step.scales());
  double worst = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (!meant(k)) continue;
    const double change = relative_to_rounding(after[k] - before[k]);
    worst = std::isnan(change) || std::isnan(worst) ? no_step : std::max(worst, change);
  }
  return worst;
}

constexpr int steps_of_entropy = 40;

}  // namespace

template <class T>
double quadratic_invariants_residual(MeasuredStep<T>& step) {
  return largest_change(step, Formula::invariants, [&](std::size_t k) {
    const Invariant& invariant = step.model()->invariants()[k];
    // Where the flag of an invariant is wrong, the check of the system says so, and no method is blamed for
    // it.
    return invariant.quadratic && invariant.behaviour == Behaviour::conserved &&
           is_quadratic(step.model(), k);
  });
}

template <class T>
double momentum_maps_residual(MeasuredStep<T>& step) {
  return largest_change(step, Formula::invariants,
                        [&](std::size_t k) { return momentum_map(*step.model(), k); });
}

template <class T>
double nonholonomic_momentum_residual(MeasuredStep<T>& step) {
  return largest_change(step, Formula::invariants,
                        [&](std::size_t k) { return allowed_momentum_map(*step.model(), k); });
}

namespace {
// z' + x x' + y y' = 0 and the potential z, all masses one. Nothing hinders the bead from going round, and
// nothing pushes it: its angular momentum x p_y - y p_x is conserved.
struct Bowl {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[2];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[0];
    rows[1] = q[1];
    rows[2] = T(1);
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[0] * z[4] - z[1] * z[3];
  }
};
}  // namespace

std::shared_ptr<const Model> bead_in_a_bowl() {
  return motion_of(make_model(SystemDescriptor{.name = "bead-in-a-bowl",
                                               .title = "",
                                               .reference = "",
                                               .initial = {Real(1), 0, 0, 0, Real(1), 0},
                                               .invariants = {conserved_quadratic("turn", "J s")}},
                              Bowl()));
}

template <class T>
double energy_residual(MeasuredStep<T>& step) {
  return largest_change(step, Formula::hamiltonian, [](std::size_t) { return true; });
}

template <class T>
double casimirs_residual(MeasuredStep<T>& step) {
  return largest_change(step, Formula::casimirs, [](std::size_t) { return true; });
}

// The measure takes forty steps. Far from equilibrium, where it starts, a single step produces so much
// entropy that hardly any method makes it fall; the later steps reach states where the production is small
// and the error of a method shows.
template <class T>
double entropy_residual(MeasuredStep<T>& step) {
  Replay<WithRounding<T>> entropy(step.model()->tape(Formula::entropy));
  if (!step.end()) return no_step;
  auto before = with_rounding<T>(entropy, step.t(), step.start(), step.scales()).front();
  double worst = 0;
  Integration<T>& run = step.from(step.t(), step.h(), step.start());
  for (int k = 0; k < steps_of_entropy; ++k) {
    if (!run.steps(1).reached()) return no_step;
    const auto after = with_rounding<T>(entropy, run.time(), run.state(), step.scales()).front();
    const WithRounding<T> fall = before - after;
    if (isnan(fall.value)) return no_step;
    if (fall.value > T(0)) worst = std::max(worst, relative_to_rounding(fall));
    before = after;
  }
  return worst;
}

template double quadratic_invariants_residual(MeasuredStep<double>&);
template double quadratic_invariants_residual(MeasuredStep<Quad>&);
template double momentum_maps_residual(MeasuredStep<double>&);
template double momentum_maps_residual(MeasuredStep<Quad>&);
template double nonholonomic_momentum_residual(MeasuredStep<double>&);
template double nonholonomic_momentum_residual(MeasuredStep<Quad>&);
template double energy_residual(MeasuredStep<double>&);
template double energy_residual(MeasuredStep<Quad>&);
template double casimirs_residual(MeasuredStep<double>&);
template double casimirs_residual(MeasuredStep<Quad>&);
template double entropy_residual(MeasuredStep<double>&);
template double entropy_residual(MeasuredStep<Quad>&);

}  // namespace pfaff
