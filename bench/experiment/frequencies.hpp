// Frequencies of the motion along the runs of an experiment: how fast vectors that a case names turn, and how
// much faster than those of the reference solution.
//
// A vector has two expressions of the coordinates, the parameters and the time t, written as in systems as
// text: the position of a planet, or the direction of its pericentre, whose frequency is a secular one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/core/tape/tape.hpp>
#include <pfaff/runs/support/turning.hpp>

namespace pfaff {

/// The components of a vector, recorded with the coordinates of a model as inputs. TextError where an
/// expression is none, or has names that the model does not know.
std::shared_ptr<const Tape> vector_tape(const FrequencyVector& vector, const Model& model);

/// One frequency of one run.
struct FoundFrequency {
  double of_reference = 0;  // radians per unit of time
  double error = 0;         // that of the method less it, from the angle between the two vectors
  double change = 0;        // of the error from the first half of the time to the second, see TurningRate
};

/// The times for which frequencies of a case are compared: those of a thousand of its largest steps, or the
/// whole of its runs where they are shorter.
Real time_of_frequencies(const std::vector<const ExperimentRun*>& of_case);

/// Carries the initial state of a run along with its method and step for the time, and compares each of the
/// vectors with that of the solution at four thousand times at most. Not a number where the vector of the
/// solution turns by more than a third of a turn between two of them, where the solution ends before the
/// time, and where the run fails.
std::vector<FoundFrequency> frequencies_of(const ExperimentRun& run, const ReferenceSolution& solution,
                                           const Real& time);

/// The text of frequencies.csv: of every case without seeds that names vectors, each run with a fixed step
/// that has ended well. Empty where there is none.
std::string frequencies_csv(const std::vector<ExperimentRun>& runs,
                            const std::vector<nlohmann::json>& summaries);

}  // namespace pfaff
