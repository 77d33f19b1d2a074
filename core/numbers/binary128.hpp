// Sums and products of binary128 numbers, which are most of what is computed in quad.
//
// The compiler leaves them to its run-time library, whose functions obey every rounding mode and raise every
// exception of IEEE 754. These round to nearest, ties to even, and raise nothing; the bits of their results
// are the same in a third of the time.
#pragma once

namespace pfaff {

/// a + b.
[[nodiscard]] __float128 binary128_sum(__float128 a, __float128 b) noexcept;
/// a b.
[[nodiscard]] __float128 binary128_product(__float128 a, __float128 b) noexcept;

}  // namespace pfaff
