// What a scalar owes: FormulaScalar, with which formulas are evaluated, and StepScalar, in which methods
// step.
//
// Each thing owed is one row of the lists below. The concepts are made from these rows, and so are the
// messages in which the compiler says what a new scalar lacks (check_formula_scalar, check_step_scalar).
#pragma once

#include <concepts>
#include <type_traits>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

// A row is a name, an expression in x and y (const T&) and c (const Real&), and the type that the expression
// has to be convertible to. The braces of T{0.5} refuse a scalar that would cut the number to an int.
// clang-format off
#define PFAFF_FORMULA_SCALAR_OWES(ROW)  \
  ROW(default_state, T(), T)            \
  ROW(integers, implicitly<T>(1), T)    \
  ROW(products_with_integers, 2 * x, T) \
  ROW(constants, T(c), T)               \
  ROW(products_with_constants, c * x, T) \
  ROW(negation, -x, T)                  \
  ROW(sum, x + y, T)                    \
  ROW(difference, x - y, T)             \
  ROW(product, x * y, T)                 \
  ROW(quotient, x / y, T)               \
  ROW(square_root, sqrt(x), T)          \
  ROW(exponential, exp(x), T)           \
  ROW(logarithm, log(x), T)             \
  ROW(sine, sin(x), T)                  \
  ROW(cosine, cos(x), T)                \
  ROW(power, pow(x, c), T)              \
  ROW(branch, select(x, y, y), T)       \
  ROW(structural_zero, structurally_zero(x), bool)
#define PFAFF_STEP_SCALAR_OWES(ROW) \
  ROW(doubles, T{0.5}, T)           \
  ROW(value, value_of(x), Value<T>) \
  ROW(finiteness, isfinite(value_of(x)), bool)
// clang-format on

namespace owes {
/// What converts to T without being asked to.
template <class T>
T implicitly(std::type_identity_t<T> x);
// NOLINTBEGIN(bugprone-macro-parentheses): a name that is declared takes none
#define PFAFF_ROW(name, expression, result)                        \
  template <class T>                                               \
  concept name = requires(const T& x, const T& y, const Real& c) { \
    { expression } -> std::convertible_to<result>;                 \
  };
PFAFF_FORMULA_SCALAR_OWES(PFAFF_ROW)
PFAFF_STEP_SCALAR_OWES(PFAFF_ROW)
#undef PFAFF_ROW
// NOLINTEND(bugprone-macro-parentheses)
}  // namespace owes

/// A type with which formulas are evaluated, together with exact constants (core/numbers/real.hpp).
template <class T>
concept FormulaScalar = std::copyable<T>
#define PFAFF_ROW(name, expression, result) &&owes::name<T>
    PFAFF_FORMULA_SCALAR_OWES(PFAFF_ROW)
#undef PFAFF_ROW
    ;

/// A FormulaScalar in which methods step: the number it holds can be read and compared.
template <class T>
concept StepScalar = FormulaScalar<T>
#define PFAFF_ROW(name, expression, result) &&owes::name<T>
    PFAFF_STEP_SCALAR_OWES(PFAFF_ROW)
#undef PFAFF_ROW
    ;

/// Does not compile unless T is a FormulaScalar, with a message for everything it lacks.
template <class T>
constexpr bool check_formula_scalar() {
  static_assert(std::copyable<T>, "FormulaScalar: expected a type that can be copied");
#define PFAFF_ROW(name, expression, result)                           \
  static_assert(owes::name<T>, "FormulaScalar: expected " #expression \
                               " for T x, T y and Real c, "           \
                               "a " #result);
  PFAFF_FORMULA_SCALAR_OWES(PFAFF_ROW)
#undef PFAFF_ROW
  return true;
}
/// Does not compile unless T is a StepScalar, with a message for everything it lacks.
template <class T>
constexpr bool check_step_scalar() {
#define PFAFF_ROW(name, expression, result) \
  static_assert(owes::name<T>, "StepScalar: expected " #expression " for T x, a " #result);
  PFAFF_STEP_SCALAR_OWES(PFAFF_ROW)
#undef PFAFF_ROW
  return check_formula_scalar<T>();
}

#undef PFAFF_FORMULA_SCALAR_OWES
#undef PFAFF_STEP_SCALAR_OWES

}  // namespace pfaff
