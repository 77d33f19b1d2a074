// The Taylor coefficients of a generating function from its evolution (generating_evolution.hpp), on tapes.
// Costs grow steeply with the degree. The schemes do not use it; it is what they are compared with.
//
// phi_w = sum_k tau^k phi_w^(k)(w, t0) with (k + 1) phi_w^(k+1) = [tau^k] a (su-qin (79)-(82)). Two ways to
// [tau^k] a: the k-th derivative in tau of a along the truncated series, and the multilinear expansion that
// (77)-(78) misprint. With X = phi_w, Y = phi_ww and h, j >= 1,
//
//   [tau^k] a = sum over m, n, l of 1/(m! n! l!) times the sum over
//                 h_1 + .. + h_n + j_1 + .. + j_l = k - m
//               of d_X^n d_Y^l d_t^m a (phi_w^(h_1), .., phi_w^(h_n), phi_ww^(j_1), .., phi_ww^(j_l)).
#pragma once

#include <vector>

#include <pfaff/tests/generating/generating_evolution.hpp>

namespace pfaff {

/// How [tau^k] a is formed: by differentiation along the series, by the multilinear expansion, or by (77) or
/// (78) as printed, which differ in their third terms.
enum class ExpansionRule { total_derivative, multilinear, printed_77, printed_78 };

/// phi_w^(0), .., phi_w^(degree): each of n inputs w, n outputs, its time being t0. phi_w^(0) = 0, as for
/// every alpha that takes equal states at equal times to w^ = 0.
std::vector<Tape> expand_gradient(const Tape& evolution, int dimension, int degree, ExpansionRule rule);

/// phi^(0), .., phi^(degree) from a scalar evolution: each of n inputs, one output, its time being t0.
std::vector<Tape> expand_scalar(const Tape& scalar_evolution, int dimension, int degree);

}  // namespace pfaff
