// What a step rounds, told from what it gets wrong.
//
// A residual above its tolerance is rounding where the step multiplies roundings: a stiff motion by e^{kh}, a
// quotient of differences by u/h. Such a residual is another number as soon as an input moves by a unit in
// its last place. The residual of a claim that does not hold is a smooth function of the inputs and stays
// what it is to most of its digits.
#pragma once

#include <span>

#include <pfaff/verify/measured_step.hpp>

namespace pfaff {

/// So many steps, whose inputs are moved by a unit in the last place, show what a step rounds.
inline constexpr int moved_steps = 16;

/// A step may multiply roundings by so much more than the tolerance allows for. What is larger is no
/// rounding, even where it is another number each time, as in a step that draws random numbers.
inline constexpr double most_multiplied = 1e6;

/// By how much more than its tolerance the stopping rule of an implicit method may leave: a thousand units of
/// round-off in double. Who stops at ten thousand of them stops too early.
inline constexpr double most_left_by_stopping = 10;

/// The reason of a check that passes because its residual is such rounding.
inline constexpr const char* multiplied_rounding =
    "rounding, which this step multiplies: it is another number where an input moves by a unit";

/// True where residuals of the same step with inputs that were moved are rounding: each is at most
/// `most_multiplied` times the tolerance, and their standard deviation is more than a fiftieth of their mean.
/// Of a residual that is fifty times as large as what is rounded in it nothing else can be seen in that
/// precision; the other precision sees it.
bool is_rounding(std::span<const double> residuals, double tolerance);
/// The latter alone: their standard deviation is more than a fiftieth of their mean.
bool scatter(std::span<const double> residuals);

/// The start of a step with every coordinate moved up or down by a unit in its last place in T, drawn by
/// `seed`.
template <class T>
std::vector<Real> moved_by_a_unit(const std::vector<Real>& start, int seed);

/// measure(moved) for each of `moved_steps` starts that are moved so.
template <class T, class Measure>
std::vector<double> of_moved_starts(const std::vector<Real>& start, const Measure& measure) {
  std::vector<double> measured;
  for (int seed = 1; seed <= moved_steps; ++seed)
    measured.push_back(measure(moved_by_a_unit<T>(start, seed)));
  return measured;
}

/// True where a residual is rounding, or what a stopping rule leaves: in quad it is smaller by as much as the
/// precisions differ, which no error of a method is. What is above 1e-8 in double is neither.
bool falls_with_the_precision(double in_double, double in_quad);
/// The largest residual in quad for which that is true; below zero where there is none. Of residuals that
/// scatter when the start is moved by a rounding up to 1e-4 in double: so much a step may multiply it where a
/// system has coefficients of very different sizes.
double most_in_quad(double in_double, bool scatters = false);

}  // namespace pfaff
