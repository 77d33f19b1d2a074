// Poincare's integral invariant along the methods of an experiment: a closed loop of states, carried by each
// of them.
//
// The integral of the one-form F(z, t) around a loop, p dq for canonical systems, is the same at all times
// while the motion carries the loop along, and so it is for a method exactly where its steps keep the
// structure K = dF. Unlike the residual of a step it adds up over the run, and it needs no Jacobian: the
// tangent of the loop is found by spectral differentiation along it, so that a loop that is still resolved is
// measured to round-off.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// The carried loop at one time.
struct CarriedLoop {
  double t = 0;
  double integral = 0;     // of F around the loop, over that at the start
  double uncertainty = 0;  // of the same: what it changes by where every other point is left out
};

/// True where the loop of a run has an invariant: fixed steps, at most 64 coordinates, no constraints, and a
/// canonical energy or a one-form.
bool has_loop_invariant(const ResolvedRun& run);

/// Carries a loop around the initial state along with the method and the step of a run, for a thousand steps
/// or until the run ends, and looks at it about `looks` times. It ends early where a step fails.
std::vector<CarriedLoop> carry_loop(const ResolvedRun& run, int looks);

/// The text of loops.csv: of every case without seeds that has such an invariant, each method at the largest
/// step at which its run has ended well. Empty where there is none.
std::string loops_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
