// How the methods of an experiment contract the plane: a disc of states, carried along by each of them.
//
// A system of one q and one p with friction, q' = T_p, p' = -V_q - nu p, states by its damping nu how it
// contracts areas: dq ^ dp shrinks as e^{-nu t}, whatever the potential is. The outline of a disc around the
// initial state is moved point by point; its area is that of the polygon of these points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// The carried disc at one time.
struct CarriedDisc {
  double t = 0;
  double area = 0, law = 0;           // both over the area at the start; the law is e^{-nu t}
  std::vector<double> first, second;  // q and p along the outline
};

/// True where the system of a run states how it contracts areas of the plane: two coordinates and friction.
bool contracts(const ResolvedRun& run);

/// Carries the disc along with the method and the step of a run of which contracts() is true, until the law
/// has come to e^{-3} or the run ends, and looks at it about `samples` times. It ends early where a step
/// fails.
std::vector<CarriedDisc> carry_disc(const ResolvedRun& run, int samples);

/// The text of contraction.csv: of every case without seeds whose system contracts, each method with fixed
/// steps at the largest step at which its run has ended well. The outline stands, as "q p;q p;...", at six of
/// the times. Empty where there is none.
std::string contraction_csv(const std::vector<ExperimentRun>& runs,
                            const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
