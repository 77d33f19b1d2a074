// Sums and products of binary128 numbers, which are most of what is computed in quad.
//
// The compiler leaves them to its run-time library, whose functions obey every rounding mode and raise every
// exception of IEEE 754. These round to nearest, ties to even, and raise nothing; the bits of their results
// are the same in a third of the time.
#pragma once

#include <cstddef>

namespace pfaff {

/// a + b.
[[nodiscard]] __float128 binary128_sum(__float128 a, __float128 b) noexcept;
/// a b.
[[nodiscard]] __float128 binary128_product(__float128 a, __float128 b) noexcept;

/// start + a_0 b_0 + a_1 b_1 + ... of `count` products, rounded once; a_k is a[k a_step], b_k is b[k b_step].
/// What is more than 2^240 times smaller than the largest product may be dropped. Rounded after every
/// operation where there is one product only, a number is subnormal, infinite or none, or the sum is no
/// normal number.
[[nodiscard]] __float128 binary128_sum_of_products(__float128 start, const __float128* a,
                                                   std::ptrdiff_t a_step, const __float128* b,
                                                   std::ptrdiff_t b_step, std::size_t count) noexcept;

}  // namespace pfaff
