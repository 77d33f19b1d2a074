// Sums over errors at equally spaced times, of many at once.
#pragma once

#include <cstddef>
#include <span>

#include <pfaff/runs/support/windows.hpp>

namespace pfaff::sums {

/// Of n errors e_0 … e_{n-1}, about the first of them: d_k = e_k - e_0.
struct Sums {
  double shift = 0;                             // e_0
  double sum = 0, square = 0, ramp = 0;         // of d_k, d_k^2 and k d_k
  double low = 0, high = 0;                     // the least and the largest error,
  std::size_t first_low = 0, first_high = 0;    // and where they stand first
  std::size_t count = 0, rises = 0, falls = 0;  // steps up and down, the one from `before` to e_0 included
};

/// Not empty. A number that is not finite makes `sum` not finite.
Sums of(std::span<const double> errors, double before);

/// The statistics of the same errors, at the times t + k dt.
windows::Block block_of(const Sums& sums, double t, double dt);

}  // namespace pfaff::sums
