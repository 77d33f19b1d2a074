// Order conditions of splittings and compositions by Lie words (blanes-casas2016; hairer-lubich-wanner2006
// III.5; murua-sanz-serna1999).
//
// - A splitting exp(a1 h A) exp(b1 h B) exp(a2 h A) ... is of order p where its logarithm is h (A + B) up to
//   h^p: for every Lyndon word of p letters or less but the two of one letter, its coefficient is zero.
// - Where A is a kinetic energy quadratic in p, and B a potential (Runge-Kutta-Nystroem splittings), a
// bracket
//   of m drifts and n kicks is of degree m - n + 1 in p. Brackets with n >= m + 2 therefore vanish, such as
//   [B, [B, [B, A]]], and the logarithm need be h (A + B) only up to what lies in the ideal of all these.
//   There are 2, 1, 2, 2, 4, 5, 10, 14, 25, 39 conditions of degree 1, ..., 10 instead of 2, 1, 2, 3, 6, 9,
//   18, 30, 56, 99. The bracket of three kicks alone generates the ideal up to degree 7 only.
// - A symmetric method of order 2 is exp(h Y1 + h^3 Y3 + h^5 Y5 + ...), and a composition of its steps of
//   lengths gamma_i h is of order p where its logarithm is h Y1 up to h^p.
// - A processed method P K P^-1 is of order p where it is so as a splitting. Its kernel K is of effective
//   order p where there is such a P, whatever its form: where the logarithm of K is that of A + B,
//   transformed by the exponential of a Lie series.
#pragma once

#include <vector>

#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/order_conditions/word_series.hpp>

namespace pfaff {

/// One flow of a splitting: of part A (0, the drift) or B (1, the kick), for `length` steps.
struct PartialFlow {
  std::size_t part = 0;
  Quad length{0};
};

/// What is known of A and B.
enum class Parts {
  general,            // nothing
  quadratic_kinetic,  // A is quadratic in p and B a function of q
};

/// The largest degree for which conditions are listed.
inline constexpr int largest_degree = 12;

/// The conditions of a splitting up to `order`, at most largest_degree.
std::vector<OrderCondition> splitting_conditions(const std::vector<PartialFlow>& flows, int order,
                                                 Parts parts = Parts::general);

/// The rows of the matrix that takes the coefficients of the Lyndon words of a degree, of a logarithm's part
/// of that degree, to the conditions of that degree: to what is left of them where all that vanishes for such
/// parts is divided out.
std::vector<std::vector<Quad>> condition_rows(int degree, Parts parts);

/// The conditions of generalised order of a splitting for H = A + eps B (near_integrable_schemes.hpp): those
/// of the words with k letters B up to the degree orders[k - 1], of words with more than orders.size()
/// letters B up to the last of them, and of the word A. No entry may be larger than largest_degree or than
/// the one before.
std::vector<OrderCondition> near_integrable_conditions(const std::vector<PartialFlow>& flows,
                                                       const std::vector<int>& orders);

/// The conditions of the composition of a symmetric base of order 2 with these weights.
std::vector<OrderCondition> composition_conditions(const std::vector<Quad>& weights, int order);

/// The conditions of effective order up to `order` of a kernel: at every degree what no processor removes.
std::vector<OrderCondition> effective_conditions(const std::vector<PartialFlow>& kernel, int order,
                                                 Parts parts = Parts::general);

/// The same for a kernel that is a composition of a symmetric base of order 2, as its processor is.
std::vector<OrderCondition> effective_composition_conditions(const std::vector<Quad>& kernel, int order);

/// The weights of pre, of the kernel and of the inverse of pre: a symmetric base undoes its step of length
/// gamma h by that of length -gamma h.
std::vector<Quad> processed_weights(const std::vector<Quad>& pre, const std::vector<Quad>& kernel);

/// The flows of the inverse: the same in the opposite order, with the opposite lengths.
std::vector<PartialFlow> inverse(std::vector<PartialFlow> flows);
/// The flows of pre, of the kernel and of the inverse of pre, each as it stands: neighbours of one part are
/// not joined, because kernels in a row have no processor between them.
std::vector<PartialFlow> processed_step(const std::vector<PartialFlow>& pre,
                                        const std::vector<PartialFlow>& kernel);

}  // namespace pfaff
