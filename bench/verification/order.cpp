// Orders by measurement.
#include <cmath>

#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/verification/check.hpp>

namespace pfaff {

namespace {

// The local error of one step, relative to the state, in every component; negative when the step fails.
Quad local_error(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad h) {
  const auto stepper = method.stepper(model, Quad());
  std::vector<Quad> z;
  for (const Real& x : generic_state(*model)) z.push_back(x.quad());
  std::vector<Quad> exact = z;
  std::int64_t completed = 0;
  if (stepper->advance(generic_time.quad(), 0, h, 1, z, completed) != Status::converged) return Quad(-1);
  taylor_flow(*model, generic_time.quad(), h, exact);
  Quad distance(0), norm(0);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const Quad d = z[k] - exact[k];
    distance += d * d;
    norm += exact[k] * exact[k];
  }
  return sqrt(distance / norm);
}

double logarithm2(Quad x) { return std::log2(static_cast<double>(x)); }

}  // namespace

MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  // Below the floor round-off is more than a hundredth of the error: that of quad, or of coefficients in
  // double.
  const Quad floor(method.descriptor().double_coefficients ? 1e-16 : 1e-32);
  MeasuredOrder result;
  std::vector<double> slopes;
  Quad h = Quad(1) / Quad(2), last_error(-1);
  for (int halving = 0; halving < 40; ++halving, h = h / Quad(2)) {
    const Quad error = local_error(method, model, h);
    if (error < Quad(0)) continue;  // too large a step for the implicit solve
    if (error < floor) break;
    if (last_error > Quad(0)) slopes.push_back(logarithm2(last_error / error) - 1);
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

double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  // The smallest step whose error is still well above round-off decides.
  double slope = 100;
  Quad h(1e-2), last(-1);
  for (int k = 0; k < 9; ++k, h = h / Quad(10)) {
    const Quad error = local_error(method, model, h);
    if (error < Quad(1e-32)) break;
    if (last > Quad(0)) slope = logarithm2(last / error) / std::log2(10.0) - 1;
    last = error;
  }
  return slope;
}

}  // namespace pfaff
