// Measures the orders of methods.
#include <cmath>

#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/step_scale.hpp>

namespace pfaff {

namespace {

// The error after time `elapsed`, taken in so many equal steps, relative to the norm of the exact state;
// negative when a step fails. `motion` is the vector field whose exact solution is compared with.
Quad error_after(const MethodInstance& method, const std::shared_ptr<const Model>& model, const Model& motion,
                 Quad elapsed, std::int64_t steps) {
  const auto stepper = method.stepper(model, Quad());
  std::vector<Quad> z;
  for (const Real& x : generic_state(*model)) z.push_back(x.quad());
  std::vector<Quad> exact = z;
  std::int64_t completed = 0;
  const Quad h = elapsed / Quad(static_cast<double>(steps));
  if (stepper->advance(generic_time.quad(), 0, h, steps, z, completed) != Status::converged) return Quad(-1);
  taylor_flow(motion, generic_time.quad(), elapsed, exact);
  Quad distance(0), norm(0);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const Quad d = z[k] - exact[k];
    distance += d * d;
    norm += exact[k] * exact[k];
  }
  return sqrt(distance / norm);
}

// own_time of the motion at the generic state.
Quad unit_of_time(const Model& motion, const Model& model) {
  return own_time(motion, generic_time, generic_state(model));
}

double logarithm2(Quad x) { return std::log2(static_cast<double>(x)); }

// The slope at which the errors of successive halvings settle. error_of(k) is the error after k halvings,
// negative where the step failed; errors below `floor` are round-off and not used.
template <class Error>
MeasuredOrder settle(Error&& error_of, int halvings, const Quad& floor) {
  MeasuredOrder result;
  std::vector<double> slopes;
  Quad last_error(-1);
  for (int halving = 0; halving < halvings; ++halving) {
    const Quad error = error_of(halving);
    if (error < Quad(0)) continue;  // too large a step for the implicit solve
    if (error < floor) break;
    if (last_error > Quad(0)) slopes.push_back(logarithm2(last_error / error));
    last_error = error;
    const std::size_t n = slopes.size();
    if (n >= 4 && std::abs(slopes[n - 1] - slopes[n - 2]) < 0.01 &&
        std::abs(slopes[n - 2] - slopes[n - 3]) < 0.02) {
      result.slope = slopes.back();
      result.settled = true;
      return result;
    }
  }
  if (slopes.empty()) {
    result.reason = "no two errors above round-off";
    return result;
  }
  // Errors reached round-off before the slopes settled. Slopes approach the order in proportion to h; where
  // the last differences contract as that implies, one step of extrapolation is made.
  const std::size_t n = slopes.size();
  result.slope = slopes.back();
  if (n >= 3 && std::abs(slopes[n - 1] - slopes[n - 2]) < 0.75 * std::abs(slopes[n - 2] - slopes[n - 3]))
    result.slope = 2 * slopes[n - 1] - slopes[n - 2];
  return result;
}

const Quad interval = Quad(1) / Quad(8);

// Fields of formulations are long; other series of this many coordinates are cheap.
constexpr std::size_t most_expanded = 64, most_expanded_in_formulations = 16;
// Rates between 1/ordinary_rates and ordinary_rates are taken as one; others are brought to the ordinary one.
constexpr double ordinary_rates = 32, ordinary_rate = 8;

}  // namespace

Quad own_time(const Model& motion, const Real& t, const std::vector<Real>& z) {
  const std::size_t n = z.size();
  if (n > (motion.source().formulation.empty() ? most_expanded : most_expanded_in_formulations))
    return Quad(1);
  ReferenceExpansion expansion(motion);
  const std::vector<double> scales = coordinate_scales(z, motion.coordinates());
  std::vector<Quad> at;
  for (const Real& x : z) at.push_back(x.quad());
  expansion.expand(t.quad(), at.data());
  // The size of a term of high degree tells the rate whatever the sizes of single coordinates are.
  double rate = 0;
  for (std::size_t degree = 6; degree <= 10; ++degree)
    for (std::size_t k = 0; k < n; ++k) {
      const double size = std::abs(static_cast<double>(expansion.coefficients()[degree * n + k])) / scales[k];
      rate = std::max(rate, std::pow(size, 1 / static_cast<double>(degree)));
    }
  if (!(rate > 0) || !std::isfinite(rate) || (rate <= ordinary_rates && rate >= 1 / ordinary_rates))
    return Quad(1);
  const double nearest = rate > 1 ? ordinary_rate : 1 / ordinary_rate;
  return Quad(std::exp2(-std::round(std::log2(rate / nearest))));
}

MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                            bool history) {
  // Below the floor, round-off is more than a hundredth of the error. It is that of quad, or, where the
  // coefficients are doubles, that of the coefficients.
  const Quad floor(method.descriptor().double_coefficients ? 1e-16 : 1e-32);
  const auto motion = motion_of(model);
  const Quad time = unit_of_time(*motion, *model);
  if (method.needs_constraints() || history)
    return settle(
        [&](int k) { return error_after(method, model, *motion, interval * time, std::int64_t{1} << k); }, 10,
        Quad(100) * floor);
  MeasuredOrder order = settle(
      [&](int k) { return error_after(method, model, *motion, time / Quad(std::ldexp(1.0, k + 1)), 1); }, 40,
      floor);
  order.slope -= 1;
  return order;
}

double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  const auto motion = motion_of(model);
  const Quad time = unit_of_time(*motion, *model);
  if (method.needs_constraints() &&
      method.order(*model) <= 2)  // at this h a change of 1e-6 exceeds the error h^2
    return logarithm2(error_after(method, model, *motion, interval * time, 512) /
                      error_after(method, model, *motion, interval * time, 1024));
  // The slope at the smallest steps whose errors are above round-off is the result.
  double slope = 100;
  Quad h = Quad(1e-2) * time, last(-1);
  for (int k = 0; k < 9; ++k, h = h / Quad(10)) {
    const Quad error = error_after(method, model, *motion, h, 1);
    if (error < Quad(1e-32)) break;
    if (last > Quad(0)) slope = logarithm2(last / error) / std::log2(10.0) - 1;
    last = error;
  }
  return slope;
}

}  // namespace pfaff
