// The order conditions of a method, measured: the error of one step expands in powers of h, and the
// coefficients up to that of h^p vanish. A slope of errors finds the order of the largest part of the error;
// this finds any part of lower order, however small its coefficient is.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/method_on_model.hpp>

namespace pfaff {

namespace {

// The error of a step is an analytic function of h. It is interpolated at Chebyshev points of [-r, r]. The
// largest r is a sixteenth of the system's own time; it is quartered until the terms of the highest degrees
// are so small that nothing of the function is left out, since the long sub-steps of compositions have
// shorter series.
constexpr int interpolation_points = 28, points_left_out = 3, most_radii = 5;
const Quad largest_radius = Quad(1) / Quad(16);
constexpr double nothing_left_out = 1e-23;
// Coefficients in units of r^-k times the solution. Interpolation multiplies round-off, 1e-34, by the
// coefficients of Chebyshev polynomials, up to 1e9 for the orders here. A coefficient of a method that is
// wrong by 1e-9 leaves 1e-9 (1/16)^k, 2e-19 at k = 8.
constexpr double tolerance_of_conditions = 1e-22;
// Coefficients of the method that are doubles leave as much in the conditions as in a step. So large a
// tolerance could pass a method of lower order on a slow motion; the conditions are therefore judged only
// where the first error that the order allows, of degree p + 1, is so many times larger. One of degree p,
// which falls with the step by one power less, would then be seen.
constexpr double seen_above_tolerance = 1e2;
constexpr int most_conditions = 8;
// Coefficients that are printed with 15 digits or more leave conditions so far off, and a wrong digit leaves
// more.
constexpr double of_printed_digits = 2e-15;
constexpr std::size_t most_coordinates = 16;

// Solves the Vandermonde system sum_k c_k x_j^k = f_j by divided differences, which is accurate for ordered
// points (Bjorck & Pereyra's algorithm). The values become the coefficients.
void interpolate(const std::vector<Quad>& x, std::vector<Quad>& f) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k + 1 < n; ++k)
    for (std::size_t j = n - 1; j > k; --j) f[j] = (f[j] - f[j - 1]) / (x[j] - x[j - k - 1]);
  for (std::size_t k = n - 1; k-- > 0;)
    for (std::size_t j = k; j + 1 < n; ++j) f[j] -= f[j + 1] * x[k];
}

// The coefficients of the error in powers of h/r, relative to the scales of the step:
// errors[component][degree]. Empty where a step did not converge.
std::vector<std::vector<Quad>> error_series(MethodOnModel& on, const ReferenceExpansion& solution,
                                            const std::vector<Quad>& start, const Quad& radius) {
  MeasuredStep<Quad>& step = on.step<Quad>();
  std::vector<Quad> x, exact(start.size());
  for (int j = 0; j < interpolation_points; ++j)
    x.emplace_back(std::cos(std::numbers::pi * (j + 0.5) / interpolation_points));
  std::vector<std::vector<Quad>> errors(start.size(), std::vector<Quad>(x.size()));
  for (std::size_t j = 0; j < x.size(); ++j) {
    const Quad h = x[j] * radius;
    const auto end = step.after(on.time().quad(), h, start);
    if (!end) return {};
    solution.evaluate(h, exact.data());
    for (std::size_t k = 0; k < start.size(); ++k) errors[k][j] = ((*end)[k] - exact[k]) / step.scales()[k];
  }
  for (auto& component : errors) interpolate(x, component);
  return errors;
}

// The largest coefficient of the degrees first, ..., last, and its degree.
std::pair<Quad, int> largest_coefficient(const std::vector<std::vector<Quad>>& errors, int first, int last) {
  std::pair<Quad, int> largest{Quad(0), first};
  for (const auto& component : errors)
    for (int degree = first; degree <= last; ++degree)
      if (const Quad size = abs(component[static_cast<std::size_t>(degree)]); !(size <= largest.first))
        largest = {size, degree};
  return largest;
}

// The largest coefficient of the error up to a degree, each in units of that of the solution, to which
// coefficients of the method add up: as much as the coefficients of the method are off by.
double largest_part(const std::vector<std::vector<Quad>>& errors, const ReferenceExpansion& solution,
                    const std::vector<Quad>& scales, const Quad& radius, int last) {
  double worst = 0;
  Quad power(1);
  const std::size_t n = scales.size();
  for (int degree = 1; degree <= last; ++degree) {
    power = power * radius;
    Quad error(0), size(0);
    for (std::size_t k = 0; k < n; ++k) {
      error = std::max(error, abs(errors[k][static_cast<std::size_t>(degree)]));
      size = std::max(
          size, abs(solution.coefficients()[static_cast<std::size_t>(degree) * n + k]) * power / scales[k]);
    }
    if (error > Quad(tolerance_of_conditions)) worst = std::max(worst, static_cast<double>(error / size));
  }
  return worst;
}

}  // namespace

std::optional<Check> check_order_conditions(MethodOnModel& on) {
  const MethodInstance& method = on.method();
  const int order = method.order(*on.model());
  std::vector<Quad> start;
  for (const Real& x : generic_state(*on.model())) start.push_back(x.quad());
  if (method.needs_constraints() || on.history() || start.size() > most_coordinates ||
      on.model()->restricted() || order <= 0)
    return std::nullopt;
  const bool doubles = on.double_coefficients();
  ReferenceExpansion solution(*motion_of(on.model()));
  solution.expand(on.time().quad(), start.data());
  Check check = on.check("order conditions", "every system", doubles ? "double" : "quad");
  check.tolerance = doubles ? tolerance<double>() : tolerance_of_conditions;
  Quad radius = largest_radius * (on.step_size() / check_step).quad();
  for (int k = 0; k < most_radii; ++k, radius = radius / Quad(4)) {
    const auto errors = error_series(on, solution, start, radius);
    if (errors.empty() ||
        !(largest_coefficient(errors, interpolation_points - points_left_out, interpolation_points - 1)
              .first <= Quad(nothing_left_out)))
      continue;
    const int next = std::min(order + 1, interpolation_points - 1);
    if (doubles &&
        !(largest_coefficient(errors, next, next).first >= Quad(seen_above_tolerance * check.tolerance))) {
      check.in_scope = false;
      check.reason = "the error of a step is too near the round-off of the coefficients";
      return check;
    }
    const auto [size, degree] = largest_coefficient(errors, 0, std::min(order, most_conditions));
    check.measured = static_cast<double>(size);
    check.result = check.measured <= check.tolerance ? CheckResult::pass : CheckResult::fail;
    if (check.result == CheckResult::pass) return check;
    check.reason = "the error of a step has a part of degree " + std::to_string(degree) + " in h";
    const double missed =
        largest_part(errors, solution, on.step<Quad>().scales(), radius, std::min(order, most_conditions));
    if (missed > of_printed_digits) return check;
    check.measured = missed, check.tolerance = of_printed_digits;
    check.result = CheckResult::pass;
    check.reason = "holds to the " + std::to_string(std::lround(std::floor(-std::log10(missed)))) +
                   " digits that its coefficients are given to; more digits, or double_coefficients, say so";
    return check;
  }
  check.in_scope = false;
  check.reason = "the error of a step has no series that 28 terms resolve";
  return check;
}

}  // namespace pfaff
