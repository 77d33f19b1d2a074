// walk_exponent: the power of time with which a series wanders off, with its interval.
//
// Model: fractional Brownian motion [mandelbrot-vanness1968], whose values a time s apart differ by s^H on
// average (H = 1/2 for a walk of independent steps), with white noise beside it. Of neighbouring windows of
// the run the means are compared: their differences have the covariance
//     2 G(k) - G(k - 1) - G(k + 1),   G(k) = -1/2 sum_m A(m) |m + k w|^(2H),
// A being the autocorrelation of a window's weights and w the distance of neighbouring windows, to which the
// noise adds its share. H and the share of the noise are those of largest likelihood, the scale being free;
// the interval is where the likelihood is within 1.92 of its logarithm.
#pragma once

#include <vector>

#include <pfaff/runs/support/envelope.hpp>

namespace pfaff::windows {

/// The exponent H of a series whose means over many_windows windows (windows.hpp) these are, from .05 to 1.
Estimate walk_exponent(const std::vector<double>& means);

}  // namespace pfaff::windows
