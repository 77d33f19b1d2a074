// Stretches of consecutive steps, which show what a motion looks like early and late.
#pragma once

#include <cstdint>
#include <vector>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/plane.hpp>

namespace pfaff {

/// The number of steps in which the track of a run in a plane has turned once, either way, at least twelve
/// and at most `longest`: that of the solution, so that it is the same for all methods, or of the run itself
/// where that is null.
template <class T>
std::int64_t steps_of_a_turn(const Measured<T>& run, const Plane& plane, const ReferenceSolution* solution,
                             std::int64_t longest);

/// The steps of `most` stretches of so many steps each, the first at the start of a run and the last at its
/// end, which lie at least as far apart as they are long; fewer where the run has no room for them, and
/// where it has none for two the first `alone` steps.
std::vector<std::int64_t> stretches(std::int64_t steps, std::int64_t length, int most, std::int64_t alone);

}  // namespace pfaff
