// The claim about the growth of rounding errors.
#include <algorithm>
#include <cmath>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/round_off_growth.hpp>

namespace pfaff {

namespace {

// `time`, or where that is shorter the time in which the linearised motion turns or grows by one: 1/sqrt
// |J^2| of the Jacobian J of the field. In longer steps roundings of what a step solves for have a bias, as
// those of `gauss` on an oscillator from omega h = 1 on.
Real at_most_linear(const Real& time, const Model& model, const Real& t, const std::vector<Real>& state) {
  const std::size_t n = state.size();
  std::vector<double> z, jacobian(n * n);
  for (const Real& x : state) z.push_back(x.value());
  Replay<double>(std::make_shared<const Tape>(jacobian_tape(*model.tape(Formula::field))))(
      t.value(), z.data(), jacobian.data());
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0;
    for (std::size_t j = 0; j < n; ++j) {
      double entry = 0;
      for (std::size_t k = 0; k < n; ++k) entry += jacobian[i * n + k] * jacobian[k * n + j];
      row += std::abs(entry);
    }
    largest = std::max(largest, row);
  }
  return time.value() * std::sqrt(largest) > 1 ? Real(Quad(1 / std::sqrt(largest))) : time;
}

// The residual with starts near this state.
double residual_near(const std::vector<Real>& start, const MethodInstance& method,
                     const std::shared_ptr<const Model>& model, const Real& t) {
  RoundOffEnsemble ensemble;
  const Real time = at_most_linear(Real(own_time(*model, t, start)), *model, t, start);
  const auto chosen = round_off_step(method, model, start, t, time, ensemble.steps);
  if (!chosen) return no_step;
  const auto excess = [&] {
    const auto growth = round_off_growth(method, model, start, t, *chosen, ensemble);
    return growth ? excess_over_random_walk(*growth) : no_step;
  };
  const double first = excess();
  if (!(first > 1)) return first;
  ++ensemble.seed;
  return std::min(first, excess());
}

// Throws SolutionEnds where the motion itself ends within a long run of the shortest steps that are tried: no
// method is to blame that cannot follow it.
void follow(const Model& model, const Real& t, const std::vector<Real>& start) {
  constexpr int shortest = 80;  // of own times in such a step
  std::vector<Quad> z;
  for (const Real& x : start) z.push_back(x.quad());
  const Quad steps(static_cast<double>(RoundOffEnsemble().steps));
  taylor_flow(model, t.quad(), own_time(model, t, start) * steps / Quad(shortest), z);
}

}  // namespace

double round_off_residual(MeasuredStep<double>& step) {
  std::vector<Real> start;
  for (const double x : step.start()) start.emplace_back(Quad(x));
  const Real t{Quad(step.t())};
  const double residual = residual_near(start, step.method(), step.model(), t);
  if (!std::isnan(residual)) return residual;
  // From the generic state some motions run off to infinity before a long run ends.
  const std::vector<Real>& initial = step.model()->initial();
  const double from_initial = residual_near(initial, step.method(), step.model(), t);
  if (std::isnan(from_initial)) follow(*step.model(), t, initial);
  return from_initial;
}

}  // namespace pfaff
