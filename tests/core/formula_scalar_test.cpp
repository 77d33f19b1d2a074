// What a scalar type must provide for formulas: the library's scalars provide it, and for types that each
// lack one thing the message names that thing.
#include <gtest/gtest.h>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/numbers/formula_scalar.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/online_series.hpp>
#include <pfaff/core/tape/recorder.hpp>

#include "lacking_scalar.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Lacking;
using pfaff::testing::lacks;

template <class... T>
constexpr bool all_step(Scalars<T...> /*list*/) {
  return (check_step_scalar<T>() && ...);
}
template <class... T>
constexpr bool all_formulas(Scalars<T...> /*list*/) {
  return (check_formula_scalar<T>() && ...);
}

TEST(FormulaScalar, TheLibrarysScalarsOweNothing) {
  EXPECT_TRUE(all_step(StepScalars()));
  EXPECT_TRUE(all_formulas(FormulaScalars()));
  EXPECT_TRUE(FormulaScalar<Pack<4>> && FormulaScalar<OnlineSeries<2>> && FormulaScalar<WithRounding<Quad>>);
  EXPECT_TRUE((FormulaScalar<Dual<Dual<double, 3>, 3>>));
  // A recorded number has no value yet, and fractions have no roots.
  EXPECT_FALSE(StepScalar<Recorded>);
  EXPECT_FALSE(FormulaScalar<Rational>);
  EXPECT_FALSE(FormulaScalar<int> || FormulaScalar<std::string>);
}

TEST(FormulaScalar, EachThingOwedIsMissed) {
  EXPECT_TRUE(StepScalar<Lacking<lacks::nothing>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::integers>> || FormulaScalar<Lacking<lacks::constants>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::negation>> || FormulaScalar<Lacking<lacks::sum>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::difference>> || FormulaScalar<Lacking<lacks::product>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::quotient>> || FormulaScalar<Lacking<lacks::square_root>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::exponential>> || FormulaScalar<Lacking<lacks::logarithm>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::sine>> || FormulaScalar<Lacking<lacks::cosine>>);
  EXPECT_FALSE(FormulaScalar<Lacking<lacks::power>> || FormulaScalar<Lacking<lacks::branch>>);
  EXPECT_TRUE(FormulaScalar<Lacking<lacks::doubles>> && FormulaScalar<Lacking<lacks::value>>);
  EXPECT_FALSE(StepScalar<Lacking<lacks::doubles>> || StepScalar<Lacking<lacks::value>>);
}

}  // namespace
