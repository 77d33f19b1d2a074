// Nguyen & Turski, figure 2: the 4-pendulum in three formulations, over 32 seeds of its velocities. The paper
// prints no numbers: its claim is counted, with dopri5 at a tolerance of 1e-8 and T = 20.
#include <algorithm>

#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>
#include <pfaff/bench/runner/record.hpp>

namespace pfaff::nguyen_turski {

namespace {
constexpr int seeds = 32;

double largest_constraint(const std::string& formulation, int seed) {
  RunSettings settings;
  settings.system = "n-pendulum";
  settings.integrator = "odeint-dopri5";
  settings.formulation = formulation;
  settings.set = {{"system.bobs", "4"}, {"system.seed", std::to_string(seed)}};
  settings.tolerance = "1e-8";
  settings.time = "20";
  const RunRecord record = execute(resolve(settings), nullptr);
  return record.status == Status::converged ? record.constraints.front().maximum
                                            : std::numeric_limits<double>::quiet_NaN();
}
}  // namespace

void figure_2_rows(Rows& rows) {
  for (const std::string formulation : {"lmm", "simplified-dirac"}) {
    int exceeds = 0;
    std::vector<double> ratios;
    for (int seed = 1; seed <= seeds; ++seed) {
      const double other = largest_constraint(formulation, seed), dirac = largest_constraint("dirac", seed);
      exceeds += other > dirac;
      ratios.push_back(other / dirac);
    }
    std::nth_element(ratios.begin(), ratios.begin() + seeds / 2, ratios.end());
    const std::string counted = std::to_string(exceeds) + " of 32 seeds";
    rows.qualitative(
        "figure 2", formulation, "no numbers", "exceeds Dirac's for " + counted, ratios[seeds / 2], 0,
        exceeds >= 30,
        "exceeds dirac's |phi| for " + counted + "; ratio " + to_string(Quad(ratios[seeds / 2]), 3));
  }
}

}  // namespace pfaff::nguyen_turski
