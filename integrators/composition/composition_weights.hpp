// Weights of symmetric compositions S(gamma_s h) ... S(gamma_1 h) of a symmetric method S of order 2, to quad
// accuracy, and the order conditions they fulfil (hairer-lubich-wanner2006 V.3).
#pragma once

#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// Words of odd letters: the monomials A_{i1} A_{i2} ... of the expansions below.
using Word = std::vector<int>;

/// The words that make independent order conditions of a symmetric composition up to `order`: Lyndon words
/// whose letters are odd and add up to an odd number below `order`.
std::vector<Word> order_condition_words(int order);

/// The coefficient of a word in exp(gamma_1 A_1 + gamma_1^3 A_3 + ...) exp(gamma_2 A_1 + ...) ...: a
/// symmetric method is the flow of h A_1 + h^3 A_3 + h^5 A_5 + ..., the exact solution that of h A_1. The
/// composition is of order p where every word of p letters' weight or less has the coefficient it has in
/// exp(A_1).
Quad word_coefficient(const std::vector<Quad>& weights, const Word& word);

/// The triple jump, again and again (yoshida1990): 3^(p/2 - 1) weights for even order p.
std::vector<Quad> yoshida_weights(int order);
/// The fivefold jump, again and again (suzuki1990): 5^(p/2 - 1) weights for even order p.
std::vector<Quad> suzuki_weights(int order);
/// The compositions of kahan-li1997: order 6 with 9 weights, order 8 with 17. The published digits, moved by
/// least squares to where the order conditions hold to round-off. Other orders: std::invalid_argument.
std::vector<Quad> kahan_li_weights(int order);

}  // namespace pfaff
