// Steps of z' = lambda z, by which the controls of measures say what methods do on linear systems.
#pragma once

#include <complex>

namespace pfaff {

/// What a step of RK4 multiplies z by, for x = lambda h. Of the oscillator of frequency 1, where x = i h, its
/// argument is the angle of a step and its square the determinant.
inline std::complex<double> factor_of_rk4(const std::complex<double>& x) {
  return 1.0 + x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0)));
}

}  // namespace pfaff
