// Scalars that the compiler must refuse. Each comment `refused:` is the beginning of a message it must give.
#include <pfaff/core/numbers/formula_scalar.hpp>

#include "../lacking_scalar.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Lacking;
using pfaff::testing::lacks;

// refused: FormulaScalar: expected implicitly<T>(1) for
static_assert(check_formula_scalar<Lacking<lacks::integers>>());
// refused: FormulaScalar: expected T(c) for
static_assert(check_formula_scalar<Lacking<lacks::constants>>());
// refused: FormulaScalar: expected -x for
static_assert(check_formula_scalar<Lacking<lacks::negation>>());
// refused: FormulaScalar: expected x + y for
static_assert(check_formula_scalar<Lacking<lacks::sum>>());
// refused: FormulaScalar: expected x - y for
static_assert(check_formula_scalar<Lacking<lacks::difference>>());
// refused: FormulaScalar: expected x * y for
static_assert(check_formula_scalar<Lacking<lacks::product>>());
// refused: FormulaScalar: expected x / y for
static_assert(check_formula_scalar<Lacking<lacks::quotient>>());
// refused: FormulaScalar: expected sqrt(x) for
static_assert(check_formula_scalar<Lacking<lacks::square_root>>());
// refused: FormulaScalar: expected exp(x) for
static_assert(check_formula_scalar<Lacking<lacks::exponential>>());
// refused: FormulaScalar: expected log(x) for
static_assert(check_formula_scalar<Lacking<lacks::logarithm>>());
// refused: FormulaScalar: expected sin(x) for
static_assert(check_formula_scalar<Lacking<lacks::sine>>());
// refused: FormulaScalar: expected cos(x) for
static_assert(check_formula_scalar<Lacking<lacks::cosine>>());
// refused: FormulaScalar: expected pow(x, c) for
static_assert(check_formula_scalar<Lacking<lacks::power>>());
// refused: FormulaScalar: expected select(x, y, y) for
static_assert(check_formula_scalar<Lacking<lacks::branch>>());
// refused: StepScalar: expected T{0.5} for
static_assert(check_step_scalar<Lacking<lacks::doubles>>());
// refused: StepScalar: expected value_of(x) for
static_assert(check_step_scalar<Lacking<lacks::value>>());
}  // namespace
