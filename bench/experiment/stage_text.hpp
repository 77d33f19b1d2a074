// What the terminal shows of an experiment that is under way.
#pragma once

#include <cstddef>
#include <string>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// Stages as text, with their phase and an estimate of the time that is left in it: "1/3, about 2 min left:
/// case a, method b, step 0.1". The estimate takes what is left at the pace of what the phase has done so
/// far, and begins anew where other things than before are counted.
class StageText {
 public:
  /// The text at a time in seconds since any fixed instant.
  std::string at(const ExperimentStage& stage, double seconds);

 private:
  int phase_ = 0;
  std::size_t all_ = 0;         // of how much
  std::size_t begun_with_ = 0;  // what was done when counting began
  double begin_ = 0;
};

}  // namespace pfaff
