// The times, steps and tolerance of a run, as they are asked for in text.
#pragma once

#include <string>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff {

// The most intervals between samples of a run that chooses its steps.
inline constexpr int most_intervals = 200;

/// A step in the direction of a duration, which its size alone says nothing of.
Real towards(const Real& duration, const Real& step);

// Fills in the step or the tolerances of a run, the number of its steps and how many of them lie between
// samples, from its settings and its times `t0` and `time`. Refuses (InputError) what does not fit the method
// or what nothing is left of in the precision of the run.
void resolve_steps(ResolvedRun& run);

/// What a run lasts whose duration is no multiple of its step, a sentence without a full stop; empty where it
/// is one, to a billionth of a step and to round-off of numbers that were given as doubles.
std::string other_duration(const ResolvedRun& run);

}  // namespace pfaff
