// Orders by measurement.
#include <cmath>

#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/verification/check.hpp>

namespace pfaff {

namespace {

// The error at `elapsed` of steps of size h, relative to the state, in every component; negative when a step
// fails. `motion` is what the model does exactly.
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

double logarithm2(Quad x) { return std::log2(static_cast<double>(x)); }

// The slope that errors of successive halvings settle at; error(k) is that of the k-th, or negative.
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
  // Round-off came first. Slopes approach the order in proportion to h: where they contract, one
  // extrapolation.
  const std::size_t n = slopes.size();
  result.slope = slopes.back();
  if (n >= 3 && std::abs(slopes[n - 1] - slopes[n - 2]) < 0.75 * std::abs(slopes[n - 2] - slopes[n - 3]))
    result.slope = 2 * slopes[n - 1] - slopes[n - 2];
  return result;
}

bool on_constraints(const MethodInstance& method) { return method.needs().has(Facet::holonomic); }
const Quad interval = Quad(1) / Quad(8);

}  // namespace

MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  // Below the floor round-off is more than a hundredth of the error: that of quad, or of coefficients in
  // double.
  const Quad floor(method.descriptor().double_coefficients ? 1e-16 : 1e-32);
  const auto motion = motion_of(model);
  if (on_constraints(method))
    return settle([&](int k) { return error_after(method, model, *motion, interval, std::int64_t{1} << k); },
                  10, Quad(100) * floor);
  MeasuredOrder order = settle(
      [&](int k) { return error_after(method, model, *motion, Quad(1) / Quad(std::ldexp(1.0, k + 1)), 1); },
      40, floor);
  order.slope -= 1;
  return order;
}

double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  const auto motion = motion_of(model);
  if (on_constraints(method) && method.order(*model) <= 2)  // 1e-6 is above h^2 by then
    return logarithm2(error_after(method, model, *motion, interval, 512) /
                      error_after(method, model, *motion, interval, 1024));
  // The smallest step whose error is still well above round-off decides.
  double slope = 100;
  Quad h(1e-2), last(-1);
  for (int k = 0; k < 9; ++k, h = h / Quad(10)) {
    const Quad error = error_after(method, model, *motion, h, 1);
    if (error < Quad(1e-32)) break;
    if (last > Quad(0)) slope = logarithm2(last / error) / std::log2(10.0) - 1;
    last = error;
  }
  return slope;
}

}  // namespace pfaff
