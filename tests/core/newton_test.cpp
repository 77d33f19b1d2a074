// The simplified Newton iteration: accuracy to round-off, its statuses, and derivatives of functions defined
// implicitly.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <pfaff/core/solve/newton.hpp>

namespace {
using namespace pfaff;

template <class T>
struct Solution {
  Status status;
  int iterations;
  std::vector<T> x;
};

// Newton's iteration with the Jacobian `matrix` (row-major) from `start`.
template <class T, class Residual>
Solution<T> solve(const std::vector<Value<T>>& matrix, const std::vector<T>& start, const Residual& residual,
                  int limit = 50) {
  const std::size_t n = start.size();
  LU<Value<T>> lu(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) lu(i, j) = matrix[i * n + j];
  Solution<T> s{Status::singular, 0, start};
  if (!lu.factor()) return s;
  std::vector<T> reference = start, r(n), correction(n);
  s.status = newton<T>(lu, residual, s.x, reference, r, correction, limit, s.iterations,
                       [] { return std::span<const T>(); });
  return s;
}

// (x^2 + y^2 - 4, x y - 1), whose root near (2, 0.5) is ((sqrt 6 + sqrt 2)/2, (sqrt 6 - sqrt 2)/2).
const auto circle = [](const auto& x, const auto& r) {
  r[0] = x[0] * x[0] + x[1] * x[1] - 4;
  r[1] = x[0] * x[1] - 1;
};

TEST(Newton, ConvergesToRoundOffInDoubleAndQuad) {
  // The Jacobian at the start is kept, so that the iteration contracts by about 0.1 and not quadratically.
  const auto fine = solve<Quad>({Quad(4), Quad(1), Quad(0.5), Quad(2)}, {Quad(2), Quad(0.5)}, circle);
  EXPECT_EQ(fine.status, Status::converged);
  const Quad a = sqrt(Quad(6)) / Quad(2), b = sqrt(Quad(2)) / Quad(2);
  EXPECT_LE(abs(fine.x[0] - (a + b)), Quad(4e-34));
  EXPECT_LE(abs(fine.x[1] - (a - b)), Quad(4e-34));
  const auto coarse = solve<double>({4, 1, 0.5, 2}, {2, 0.5}, circle);
  EXPECT_EQ(coarse.status, Status::converged);
  EXPECT_NEAR(coarse.x[0], static_cast<double>(a + b), 4.5e-16);
  EXPECT_NEAR(coarse.x[1], static_cast<double>(a - b), 4.5e-16);
  EXPECT_LT(coarse.iterations, fine.iterations);
  // Control: with half the iterations it says so, and has not the digits.
  const auto early =
      solve<Quad>({Quad(4), Quad(1), Quad(0.5), Quad(2)}, {Quad(2), Quad(0.5)}, circle, fine.iterations / 2);
  EXPECT_EQ(early.status, Status::not_converged);
  EXPECT_GT(abs(early.x[0] - (a + b)), Quad(1e-30));
}

TEST(Newton, SolvesComponentsOfEverySize) {
  // The same with y in units 1e-20 and equations scaled at random: relative accuracy for both.
  const auto residual = [](const auto& x, const auto& r) {
    const double unit = 1e20;
    r[0] = 1e-15 * (x[0] * x[0] + unit * x[1] * (unit * x[1]) - 4);
    r[1] = 1e15 * (x[0] * (unit * x[1]) - 1);
  };
  const auto s = solve<double>({4e-15, 1e5, 0.5e15, 2e35}, {2, 0.5e-20}, residual);
  EXPECT_EQ(s.status, Status::converged);
  EXPECT_NEAR(s.x[0], (std::sqrt(6) + std::sqrt(2)) / 2, 1e-15);
  EXPECT_NEAR(s.x[1] * 1e20, (std::sqrt(6) - std::sqrt(2)) / 2, 1e-15);
}

TEST(Newton, SaysHowItFailed) {
  const auto status = [](double slope, double start, const std::function<double(double)>& f) {
    return solve<double>({slope}, {start}, [&](const auto& x, const auto& r) { r[0] = f(x[0]); }).status;
  };
  // No root: wanders.
  EXPECT_EQ(status(1, 1, [](double x) { return std::sin(x) + 2; }), Status::not_converged);
  // Diverges: overflows to infinity, whose difference is NaN.
  EXPECT_EQ(status(1, 3, [](double x) { return x * x * x; }), Status::non_finite);
  // A slope with the wrong sign grows for ever, but stays finite within the limit.
  EXPECT_EQ(status(-1, 1, [](double x) { return x - 0.5; }), Status::not_converged);
  // Leaves the domain.
  EXPECT_EQ(status(1, 0.1, [](double x) { return std::log(x) + 10; }), Status::non_finite);
  EXPECT_EQ(status(1, 1, [](double) { return NAN; }), Status::non_finite);
  EXPECT_EQ(status(0, 1, [](double x) { return x; }), Status::singular);
  // Control: the same set-up converges where there is a root.
  EXPECT_EQ(status(3, 1, [](double x) { return x * x - 2; }), Status::converged);
}

TEST(Newton, FindsARootAtOnceAndAtZero) {
  const auto linear = solve<double>({2}, {5.0}, [](const auto& x, const auto& r) { r[0] = 2 * x[0] - 6; });
  EXPECT_EQ(linear.status, Status::converged);
  EXPECT_LE(linear.iterations, 2);
  EXPECT_EQ(linear.x[0], 3);
  // Started at the root, nothing moves.
  const auto there = solve<double>({1}, {0.0}, [](const auto& x, const auto& r) { r[0] = std::sin(x[0]); });
  EXPECT_EQ(there.status, Status::converged);
  EXPECT_EQ(there.iterations, 1);
  EXPECT_EQ(there.x[0], 0);
}

// x(p) of x^3 + p x = 1 has x' = -x/(3 x^2 + p); in two directions, dp = 1 and dp = -2.
template <class T>
void expect_derivatives(double bound) {
  using D = Dual<T, 2>;
  D p(T(0.5));
  p.derivative = {T(1), T(-2)};
  // An approximate slope: derivatives converge at the rate of the values, not with them.
  const auto s = solve<D>(
      {T(2)}, {D(T(0.8))}, [&](const auto& x, const auto& r) { r[0] = x[0] * x[0] * x[0] + p * x[0] - D(1); },
      100);
  EXPECT_EQ(s.status, Status::converged);
  const T x = s.x[0].value, slope = -x / (T(3) * x * x + T(0.5));
  EXPECT_LE(static_cast<double>(abs(x * x * x + T(0.5) * x - T(1))), bound);
  EXPECT_LE(static_cast<double>(abs(s.x[0].derivative[0] - slope)), bound);
  EXPECT_LE(static_cast<double>(abs(s.x[0].derivative[1] + T(2) * slope)), bound);
  // Control: one iteration less than the values alone would need leaves derivatives wrong.
  const auto values = solve<T>(
      {T(2)}, {T(0.8)},
      [&](const auto& y, const auto& r) { r[0] = y[0] * y[0] * y[0] + T(0.5) * y[0] - T(1); }, 100);
  EXPECT_GT(s.iterations, values.iterations);
}

TEST(Newton, DerivativesConvergeToThoseOfTheImplicitFunction) {
  expect_derivatives<double>(4e-16);
  expect_derivatives<Quad>(4e-34);
}

}  // namespace
