// A generic point: numbers at which what is not zero identically is not zero.
#pragma once

#include <vector>

#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

/// `count` fractions between 1/4 and 5/4 without a pattern, the same ones every time: logarithms and roots of
/// coordinates exist there.
inline std::vector<Real> generic_numbers(std::size_t count) {
  RandomNumbers random(20);
  std::vector<Real> x;
  for (std::size_t k = 0; k < count; ++k) x.push_back(Real::fraction(1, 4) + (1 + random.next()) / 2);
  return x;
}

}  // namespace pfaff
