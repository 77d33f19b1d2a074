// How fast a vector in a plane turns, and how much faster than another one: frequencies of a motion and their
// errors.
//
// The angle of a vector that a motion carries along, such as a position or the direction of a pericentre,
// grows at the rate of a frequency and oscillates about that. A method whose frequency is wrong loses the
// phase in proportion to time, however well it keeps the energy.
//
// A rate is the slope of the angles by least squares, with the weights sin^4(pi (t - begin)/(end - begin)),
// which come to rest at both ends, so that oscillations about the slope add next to nothing to it after a few
// of their periods, whatever their phase. So does the parabola that tells whether the rate is steady.
#pragma once

#include <vector>

namespace pfaff {

/// A vector in a plane at one time.
struct TurningVector {
  double x = 0, y = 0;
};

/// The angles by which vectors have turned since the first, in radians, each within half a turn of the one
/// before. Not a number from the first vector on that has no angle because it is zero or not finite.
std::vector<double> angles_of(const std::vector<TurningVector>& vectors);

/// The angles by which `vectors` are ahead of `others`, likewise: the direction of the product of each with
/// the conjugate of the other, so that small angles have all their digits.
std::vector<double> angles_ahead(const std::vector<TurningVector>& vectors,
                                 const std::vector<TurningVector>& others);

/// The rate at which angles grow, in radians per unit of time.
struct TurningRate {
  double rate = 0;    // of the whole time
  double change = 0;  // from the first half of the time to the second, by the parabola of least squares
};

/// Needs sixteen times at least, in rising order; not a number where an angle is none.
TurningRate turning_rate(const std::vector<double>& times, const std::vector<double>& angles);

}  // namespace pfaff
