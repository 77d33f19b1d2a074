// Nguyen & Turski, figure 2: errors of energy and of constraints of the 4-pendulum, by the Hamilton-Dirac
// equations (4.2), by (4.7) and by (A.5), over 32 seeds of its velocities. The paper prints no numbers: its
// claim, that the errors of (4.7) and (A.5) always grow faster, is counted, with dopri5 at a tolerance of
// 1e-8 and T = 20. Without friction (4.7) and (A.5) are one field and their runs are the same, so that
// "simplified-dirac" stands for both; that the fields are one is a row of its own.
#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>

namespace pfaff::nguyen_turski {

namespace {
constexpr int seeds = 32;
constexpr int nearly_all = 30;

struct Errors {
  double constraint = std::numeric_limits<double>::quiet_NaN(), energy = constraint;
};
Errors largest_errors(const std::string& formulation, int seed) {
  RunSettings settings;
  settings.system = "n-pendulum";
  settings.integrator = "odeint-dopri5";
  settings.formulation = formulation;
  settings.set = {{"system.bobs", "4"}, {"system.seed", std::to_string(seed)}};
  settings.tolerance = "1e-8";
  settings.time = "20";
  const ResolvedRun run = resolve(settings);
  const RunRecord record = execute(run, nullptr);
  if (record.status != Status::converged) return {};
  Errors errors;
  errors.constraint = record.constraints().drift.front().maximum;
  const std::vector<Drift>& drift = record.invariants().drift;
  for (std::size_t k = 0; k < drift.size(); ++k)
    if (run.model->invariants()[k].name == "energy") errors.energy = drift[k].maximum;
  return errors;
}

void counted(Rows& rows, const std::string& what, std::vector<double> ratios) {
  const auto exceeds = std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio > 1; });
  std::nth_element(ratios.begin(), ratios.begin() + seeds / 2, ratios.end());
  rows.qualitative("figure 2", what, {"always larger", "for " + std::to_string(exceeds) + " of 32 seeds"},
                   {at_least(static_cast<double>(exceeds), nearly_all), at_least(ratios[seeds / 2], 1)},
                   "those of (4.7), (A.5) exceed those of (4.2) for " + std::to_string(exceeds) +
                       " of 32 seeds; median ratio " + shown(ratios[seeds / 2]));
}
}  // namespace

void figure_2_rows(Rows& rows) {
  std::vector<double> constraints, energies;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Errors other = largest_errors("simplified-dirac", seed), dirac = largest_errors("dirac", seed);
    constraints.push_back(other.constraint / dirac.constraint);
    energies.push_back(other.energy / dirac.energy);
  }
  counted(rows, "errors of constraints", constraints);
  counted(rows, "errors of energy", energies);
}

}  // namespace pfaff::nguyen_turski
