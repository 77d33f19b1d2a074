// Reversibility along the methods of an experiment: how far a method misses its start when it turns round.
//
// A method goes n steps forward, turns round, and goes n steps back. Where the system states a reversal rho,
// an involution with rho o flow_h = flow_-h o rho (of momenta the signs, as a rule), and does not depend on
// time, turning round is rho: rho, n steps of h, and rho again lead the motion back to its start, and so they
// do a method exactly where it is reversible. Otherwise it goes back by n steps of -h, which undo n steps of
// h exactly where it is symmetric. In either case all other methods miss the start by the size of their
// error.
//
// Rounding errors grow on the way with the motion, exponentially where that is chaotic. For comparison one
// rounding of the state is made where the method turns round: what is left of it at the start is the
// `rounding` of that look.
//
// A method that remembers earlier steps is a map of more than the state, which has to be turned round as a
// whole. Methods that claim to be reversible, or symmetric, can do that: they go back the way that they
// claim, with what they remember. Others would begin anew at the turn, as linear multistep methods do with
// steps of another method, and miss the start whatever they are: they are left out.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// What leads a method back.
enum class WayBack { reversal, negative_steps };

/// One return to the start. States are compared in double by |z - z(0)| / |z(0)|, as the errors of a run are,
/// and without regard to constraints, which leave both states on their surface.
struct Return {
  double t = 0;         // since the start, at which the method turned round
  double distance = 0;  // from the start; NaN where a step on the way back fails
  double rounding = 0;  // what the distance changes by, to first order, where every coordinate is changed by
                        // 2^-53 of itself at the turn; NaN where a step fails and for methods that remember
};

struct Returns {
  WayBack by = WayBack::negative_steps;
  std::vector<Return> looks;
};

/// Turns the method of a run with fixed steps round after up to thirteen numbers of steps, evenly spaced in
/// their logarithm from 1 to the end of the run, to at most a thousand, and fewer of more than 64
/// coordinates. There are no looks where the method is left out, and no more of them once a step forward
/// fails.
Returns returns_to_start(const ResolvedRun& run);

/// The text of reversibility.csv: of every case without seeds, each method of fixed steps at the largest step
/// at which its run has ended well. Empty where there is none.
std::string reversibility_csv(const std::vector<ExperimentRun>& runs,
                              const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
