// Numbers as decimal digits, for tables that are long: the texts of printf, made of integers.
#pragma once

#include <cstddef>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// The most characters that a number takes.
inline constexpr std::size_t longest_decimal = 48;

/// Writes x as "%.17g" does, or "%.36Qg" in quad, from `to` on, and returns the end of what was written.
char* put_decimal(char* to, double x);
char* put_decimal(char* to, const Quad& x);

}  // namespace pfaff
