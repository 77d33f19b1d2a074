// Order conditions: equations between the coefficients of a method that hold exactly where it has its order.
//
// A family of methods has a theory of its own, rooted trees for Runge-Kutta methods (rooted_trees.hpp), words
// for compositions of flows (word_conditions.hpp), powers for multistep methods (multistep_conditions.hpp).
// Each of them gives a list of conditions with their residuals, and what is here asks of every list: which
// order does it show, and which condition is violated first?
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// One order condition, evaluated with the coefficients of a method.
struct OrderCondition {
  std::string name;  // with what stands on its two sides, such as "tree [t,t]: sum b_i ... = 1/3"
  int order = 1;     // the first order that it is needed for
  Quad residual{0};  // left side less right side
  /// The size of the terms that cancel in it, at least 1: rounding of coefficients makes residuals of that
  /// size times the unit of round-off.
  Quad scale{1};
};

/// Coefficients of 36 digits, and all that is computed in quad, fulfil their conditions to this, in units of
/// the scale of a condition: ten times the unit round-off of quad, for the sums that a condition consists of.
inline const Quad precision_of_quad_coefficients = Quad(1) / (Quad(1e15) * Quad(1e18));
/// Coefficients that were rounded to doubles fulfil them to this: ten times the unit round-off of double.
inline const Quad precision_of_double_coefficients = Quad(1) / Quad(1e15);

/// The residual of a condition in units of its scale.
inline Quad relative_residual(const OrderCondition& condition) {
  return abs(condition.residual) / condition.scale;
}

/// The violated condition of the lowest order up to `order`, and of these the one that is violated most; null
/// where all hold to `precision`.
const OrderCondition* first_violated(const std::vector<OrderCondition>& conditions, int order,
                                     const Quad& precision);

/// The largest order to which all conditions hold; of a list that holds throughout, its largest.
int order_shown(const std::vector<OrderCondition>& conditions, const Quad& precision);

/// The theory of a registered method: its coefficients, with the parameters given, and the conditions of
/// other coefficients in their place.
struct OrderTheory {
  std::string kind;  // "trees", "words", "multistep" or "second-order multistep"
  int order = 0;     // up to which it lists conditions: the method's, or the largest that the theory reaches
  std::vector<Quad> coefficients;
  std::function<std::vector<OrderCondition>(const std::vector<Quad>& coefficients)> conditions;
  Quad precision = precision_of_quad_coefficients;
  /// For each coefficient the number of the sum in a condition of order 1 that it is a term of, such as the
  /// sum of all drifts, or in_no_sum. Where the list is empty there is one sum of all.
  std::vector<int> sums{};
  int next_order = 2;  // the lowest order above 1 that has conditions
  static constexpr int in_no_sum = -1;
};

namespace detail {
class OrderTheoryRegistration {
 public:
  using Make = std::function<OrderTheory(const Assignments& parameters)>;
  OrderTheoryRegistration(std::string method, Make make);
};
}  // namespace detail

/// Says what the theory of a registered method is, which it makes of the method's parameters; a static object
/// beside the registration of the method.
using KnownOrderTheory = detail::RegisteredHere<detail::OrderTheoryRegistration>;

/// The theory of the method of that name with these parameters; nullopt where none is known.
std::optional<OrderTheory> order_theory(const std::string& method, const Assignments& parameters);

}  // namespace pfaff
