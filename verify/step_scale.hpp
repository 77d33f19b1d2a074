// The units that a system has by nature: the sizes of its coordinates, the time in which it changes, and the
// sizes against which residuals of steps are judged, what one step rounds off in each coordinate.
//
// Whoever writes a system chooses its units. States near which claims are measured, steps and tolerances are
// made from these sizes, so that the same system in other units is judged in the same way.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The size of the largest coordinate.
template <class State>
auto largest_of(const State& z) {
  using T = std::remove_cvref_t<decltype(z[0])>;
  T largest(0);
  for (const T& x : z) largest = std::max(largest, T(abs(x)));
  return largest;
}

/// The largest difference of two states over the largest coordinate of the first.
template <class T>
double relative_difference(std::span<const T> z, std::span<const T> other) {
  T difference(0);
  for (std::size_t k = 0; k < z.size(); ++k) difference = std::max(difference, T(abs(z[k] - other[k])));
  return static_cast<double>(difference / largest_of(z));
}

/// How far the coordinates of a system are from one, at a state near `centre`, as powers of two: the size of
/// each coordinate there, or that of the largest one for coordinates that are zero.
std::vector<double> coordinate_scales(const std::vector<Real>& centre);
/// The same at a state z at time t, with better sizes for coordinates that are zero: what the motion from
/// there makes of each in its own time, by the Taylor series, and at least a 64th of what it would make of it
/// if the terms of its rate did not cancel. A coordinate that stays zero, and every one where the motion has
/// no series that is_short, has the size that it has above.
std::vector<double> coordinate_scales(const Model& motion, const Real& t, const std::vector<Real>& z);

/// Those at the initial state of a model, by its motion where it has one.
std::vector<double> coordinate_scales(const Model& model);

/// "sizes of coordinates differ by 2^k" where they do by more than 2^4 along the motion from the initial
/// state of a model, else nothing. Methods that add positions to momenta, which are of different units,
/// cannot be judged there: what they add swamps the smaller ones at every step size.
std::string differing_sizes(const Model& model);

/// True where the field of a motion is a formula so short that series and bounds of rounding errors of it are
/// computed at each step: up to 16 coordinates, or at most 8192 operations.
bool is_short(const Model& motion);

/// The time in which the motion from z at t changes by about its own size, as a power of two and from the
/// Taylor series of the motion; rates between 1/8 and 8 are taken as one, so that steps are the same for
/// all ordinary systems. One where the motion is not is_short.
Quad own_time(const Model& motion, const Real& t, const std::vector<Real>& z);

/// For each coordinate the size of the numbers that a step of size h from `start` at time t to `end` is made
/// of, in the unit of the coordinate: those of the two states and h times the rounding errors of the field,
/// counted in units of round-off. A correct step is off by a small multiple of the unit round-off times these
/// sizes, whatever the units and the conditioning of the field. `motion` is the model whose field it is;
/// where it is not is_short, the states alone are counted, and every coordinate counts as much as the
/// largest.
template <class T>
std::vector<T> step_scales(const Model& motion, const T& t, const T& h, const std::vector<T>& start,
                           const std::vector<T>& end);

}  // namespace pfaff
