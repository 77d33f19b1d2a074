// The sizes against which residuals of steps are judged: what one step rounds off in each coordinate.
#pragma once

#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// How far the coordinates of a system are from one, at a state near `centre`, as powers of two: the size of
/// each coordinate there. For coordinates that are zero it is the size of the largest one in the same unit,
/// or where that is zero too, or no units are given, of the largest of all. Sizes within a factor of 64 of
/// one are taken as one, so that offsets and steps of ordinary systems are the same for all of them.
std::vector<double> coordinate_scales(const std::vector<Real>& centre,
                                      const std::vector<Coordinate>& coordinates = {});

/// For each coordinate the size of the numbers that a step of size h from `start` at time t to `end` is made
/// of, in the unit of the coordinate: those of the two states and h times the rounding errors of the field,
/// counted in units of round-off. A correct step is off by a small multiple of the unit round-off times these
/// sizes, whatever the units and the conditioning of the field. `motion` is the model whose field it is;
/// where it has
/// more than 16 coordinates (most_replayed), the states alone are counted, and every coordinate counts as
/// much as the largest.
template <class T>
std::vector<T> step_scales(const Model& motion, const T& t, const T& h, const std::vector<T>& start,
                           const std::vector<T>& end);

}  // namespace pfaff
