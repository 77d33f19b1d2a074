// What a step of a generating function starts from: the expected change, and the matrix of its corrections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/correction_matrix.hpp>
#include <pfaff/integrators/generating/expected_change.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>

#include "../formula_values.hpp"

namespace pfaff {
namespace {

using QuadProblem = Problem<Quad>;
using testing::model_named;

QuadProblem::State chart_start(const QuadProblem& p, const Quad& t) {
  QuadProblem::State z, y(p.size());
  for (const Real& x : p.model()->initial()) z.push_back(x.quad());
  p.chart(t, z, y);
  return y;
}

// By how much the correction of (I - P psi') e differs from e, the largest over unit vectors e. psi' is that
// of the step itself, by central differences of psi at the w that solves it.
double mismatch(const std::string& system, bool high_order, GeneratingForm form, const Quad& h) {
  const QuadProblem p(model_named(system));
  const std::size_t n = p.size();
  const Quad t = Quad(1) / Quad(4), half = Quad(1) / Quad(2), least(1e-12);
  const bool symmetric = form == GeneratingForm::midpoint;
  const ShareMatrix<Quad> share(form, n);
  GeneratingGradient<Quad> gradient(p.chart_field_tape(), 8, symmetric, form, gauss_coefficients(4));
  gradient.set_step(t, h);
  const QuadProblem::State y = chart_start(p, t);
  QuadProblem::State w = y, change(n), above(n), below(n), residual(n), correction(n);
  for (int iteration = 0; iteration < 60; ++iteration) {
    gradient(w.data(), change.data());
    for (std::size_t k = 0; k < n; ++k) w[k] = y[k] + share.row(k, change.data());
  }
  CorrectionMatrix<QuadProblem> matrix(n, high_order);
  EXPECT_EQ(matrix.factor(p, t, h, share, y, w, change), Status::converged);
  double worst = 0;
  for (std::size_t e = 0; e < n; ++e) {
    QuadProblem::State moved = w;
    moved[e] = w[e] + least;
    gradient(moved.data(), above.data());
    moved[e] = w[e] - least;
    gradient(moved.data(), below.data());
    for (std::size_t k = 0; k < n; ++k) above[k] = (above[k] - below[k]) / least * half;
    for (std::size_t k = 0; k < n; ++k) residual[k] = Quad(k == e ? 1 : 0) - share.row(k, above.data());
    matrix.solve(share, residual, correction);
    for (std::size_t k = 0; k < n; ++k)
      worst = std::max(worst, static_cast<double>(abs(correction[k] - Quad(k == e ? 1 : 0))));
  }
  return worst;
}

// Halving the step divides what is left by 2^4 at least, by 2^5 where symmetry helps; the matrix of the
// midpoint, the control, gains 2^3.
TEST(CorrectionMatrix, IsThatOfTheStepUpToTheFourthOrder) {
  for (const char* system : {"damped-pendulum", "lotka-volterra", "kepler"})
    for (const GeneratingForm form : {GeneratingForm::midpoint, GeneratingForm::new_q_old_p}) {
      const Quad h = Quad(1) / Quad(64);
      const auto gain = [&](bool high) {
        return std::log2(mismatch(system, high, form, h) / mismatch(system, high, form, h / Quad(2)));
      };
      EXPECT_GE(gain(true), 3.75) << system;
      if (form == GeneratingForm::midpoint) {
        EXPECT_NEAR(gain(false), 3, 0.25) << system;
      }
      EXPECT_LT(mismatch(system, true, form, h), mismatch(system, false, form, h) / 10) << system;
    }
}

constexpr int order = 8, degree = 7;
constexpr std::size_t evaluations = 14;
Quad unit(std::size_t /*k*/) { return Quad(1); }

// Against a series of many more degrees; the first one left out is degree 8.
TEST(ExpectedChange, OfAFirstStepIsThatOfATaylorSeries) {
  const QuadProblem p(model_named("damped-pendulum"));
  const Quad t = Quad(1) / Quad(4);
  const QuadProblem::State y = chart_start(p, t);
  TaylorExpansion<Quad> exact(p.chart_field_tape(), 30);
  exact.expand(t, y.data());
  std::vector<double> error;
  for (const Quad& h : {Quad(1) / Quad(16), Quad(1) / Quad(32)}) {
    ExpectedChange<QuadProblem> expected(p, order, evaluations);
    QuadProblem::State change(p.size());
    expected.expect(p, t, h, y, unit, change);
    error.push_back(0);
    for (std::size_t k = 0; k < change.size(); ++k)
      error.back() = std::max(error.back(), static_cast<double>(abs(change[k] - exact.increment(h, k))));
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), degree + 1, 0.25);
}
TEST(ExpectedChange, StopsWhereTermsGrow) {
  const QuadProblem p(model_named("damped-pendulum"));
  const QuadProblem::State y = chart_start(p, Quad(0));
  TaylorExpansion<Quad> whole(p.chart_field_tape(), degree);
  whole.expand(Quad(0), y.data());
  ExpectedChange<QuadProblem> expected(p, order, evaluations);
  QuadProblem::State change(p.size());
  const Quad h(40);
  expected.expect(p, Quad(0), h, y, unit, change);
  const auto term = [&](std::size_t l, std::size_t k) {
    Quad size = abs(whole.coefficients()[l * change.size() + k]);
    for (std::size_t power = 0; power < l; ++power) size = size * h;
    return size;
  };
  for (std::size_t k = 0; k < change.size(); ++k) {
    EXPECT_LE(abs(change[k]), Quad(3) * std::max({term(1, k), term(2, k), term(3, k)})) << k;
    EXPECT_GT(abs(whole.increment(h, k)), Quad(1000) * abs(change[k])) << k << ": the control";
  }
}
TEST(ExpectedChange, TakesDifferencesWhereTheyAreGoodAndTheSeriesWhereTheyAreNot) {
  const QuadProblem p(model_named("damped-pendulum"));
  const QuadProblem::State y = chart_start(p, Quad(0));
  const Quad h = Quad(1) / Quad(8);
  // Fields that the forecast after ten changes takes.
  const auto taken = [&](auto changed, std::size_t psi) {
    ExpectedChange<QuadProblem> expected(p, order, psi);
    QuadProblem::State change(p.size());
    for (int n = 0; n < 10; ++n) {
      for (std::size_t k = 0; k < change.size(); ++k) change[k] = changed(n);
      expected.remember(change, unit);
    }
    const std::int64_t before = p.counters().fields;
    expected.expect(p, Quad(0), h, y, unit, change);
    return p.counters().fields - before;
  };
  const auto even = [](int n) { return Quad(n + 1) / Quad(100); };
  const auto jumping = [](int n) { return Quad(n % 3 == 0 ? 1 : -1) / Quad(100); };
  EXPECT_EQ(taken(even, evaluations), 0);
  EXPECT_EQ(taken(jumping, evaluations), degree);
  EXPECT_EQ(taken(jumping, 3), 0) << "the series costs more than a psi or two";
}

}  // namespace
}  // namespace pfaff
