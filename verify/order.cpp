// Measures the orders of methods.
#include <algorithm>
#include <cmath>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/history.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {

// The errors of a method from the generic state of a model, in units of the scales of its coordinates.
class Errors {
 public:
  Errors(const MethodInstance& method, const std::shared_ptr<const Model>& model)
      : method_(method), model_(model), motion_(motion_of(model)) {
    const std::vector<Real> start = generic_state(*model);
    for (const Real& x : start) start_.push_back(x.quad());
    // A coordinate may be small by chance at one of two states.
    const std::vector<double> here = coordinate_scales(start), initially = coordinate_scales(*model);
    for (std::size_t k = 0; k < here.size(); ++k) scales_.emplace_back(std::max(here[k], initially[k]));
    begin_ = generic_time_of(*model);
    time_ = own_time(*motion_, begin_, start);
  }

  /// own_time of the motion.
  [[nodiscard]] Quad time() const { return time_; }

  /// The error after time `elapsed`, taken in so many equal steps, relative to the norm of the start, which
  /// does not depend on the step as that of the end does; negative when a step fails.
  [[nodiscard]] Quad after(Quad elapsed, std::int64_t steps) {
    Integration<Quad> run = in_steps(elapsed, steps);
    if (!run.steps(steps).reached()) return Quad(-1);
    find_solution(elapsed);
    return error_at(run, exact_);
  }

  /// The same of one step. One that leads over the end of the motion is too long, and fails too.
  [[nodiscard]] Quad after_one(Quad h) {
    try {
      return after(h, 1);
    } catch (const SolutionEnds&) {
      return Quad(-1);
    }
  }

  /// Finds the state after that time. SolutionEnds where the motion ends before: no method can follow it, and
  /// its steps say nothing.
  void find_solution(const Quad& elapsed) {
    if (!exact_.empty() && elapsed == exact_after_) return;
    std::vector<Quad> z = start_;
    kinks_ = short_flow(*motion_, begin_.quad(), elapsed, z);
    exact_ = std::move(z);
    exact_after_ = elapsed;
  }

  /// True where the motion to the state last found meets a kink of the field.
  [[nodiscard]] bool across_kinks() const { return kinks_ > 0; }

  /// The root mean square of the errors after the last quarter of so many equal steps, at eight times;
  /// negative when a step fails. `steps` is a multiple of 32.
  [[nodiscard]] Quad late(Quad elapsed, std::int64_t steps) const {
    Integration<Quad> run = in_steps(elapsed, steps);
    std::vector<Quad> exact = start_;
    Quad sum(0), t = run.time();
    for (std::int64_t part = 25; part <= 32; ++part) {
      const std::int64_t more = steps / 32 * part - run.steps_taken();
      if (!run.steps(more).reached()) return Quad(-1);
      const Quad stretch = run.step() * Quad(static_cast<double>(more));
      short_flow(*motion_, t, stretch, exact);
      t += stretch;
      const Quad error = error_at(run, exact);
      sum += error * error;
    }
    return sqrt(sum / Quad(8));
  }

  /// The rate at which the state changes at the start, relative to its norm.
  [[nodiscard]] Quad rate() const {
    TaylorExpansion<Quad> expansion(motion_->tape(Formula::field), 1);
    expansion.expand(begin_.quad(), start_.data());
    const auto first = expansion.coefficients().begin() + static_cast<std::ptrdiff_t>(start_.size());
    return norm(std::vector<Quad>(first, expansion.coefficients().end())) / norm(start_);
  }

 private:
  [[nodiscard]] Integration<Quad> in_steps(const Quad& elapsed, std::int64_t steps) const {
    const Quad h = elapsed / Quad(static_cast<double>(steps));
    return Integration<Quad>(start_with(method_, model_, start_, h, begin_.quad()));
  }
  [[nodiscard]] Quad error_at(const Integration<Quad>& run, const std::vector<Quad>& exact) const {
    std::vector<Quad> difference(exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) difference[k] = run.state()[k] - exact[k];
    return norm(difference) / norm(start_);
  }
  [[nodiscard]] Quad norm(const std::vector<Quad>& z) const {
    Quad sum(0);
    for (std::size_t k = 0; k < z.size(); ++k) sum += z[k] / scales_[k] * (z[k] / scales_[k]);
    return sqrt(sum);
  }

  const MethodInstance& method_;
  std::shared_ptr<const Model> model_, motion_;
  std::vector<Quad> start_, scales_;
  Real begin_;
  Quad time_;
  std::vector<Quad> exact_;  // the state after the time that was asked for last
  Quad exact_after_;
  std::int64_t kinks_ = 0;
};

double logarithm2(Quad x) { return std::log2(static_cast<double>(x)); }

// Errors above this, relative to the state, say nothing of an order; those below the other may be round-off.
constexpr double largest_error = 0.1, largest_round_off = 1e-20;

// The slope at which the errors of successive halvings settle. error_of(k) is the error after k halvings,
// negative where the step failed; errors below floor_of(k) are round-off and not used.
template <class Error, class Floor>
MeasuredOrder settle(Error&& error_of, int halvings, Floor&& floor_of) {
  MeasuredOrder result;
  std::vector<double> slopes;
  Quad last_error(-1);
  for (int halving = 0; halving < halvings; ++halving) {
    const Quad error = error_of(halving);
    // Steps that are too large for the implicit solve, or lead where errors are no longer proportional to
    // anything.
    if (error < Quad(0) || error > Quad(largest_error)) {
      last_error = Quad(-1);
      continue;
    }
    // The longest step decides. In quad, a step of many operations loses up to two digits to round-off.
    if (last_error < Quad(0)) result.exact = error < std::max(floor_of(halving), Quad(1e-30));
    if (error < floor_of(halving)) break;
    if (last_error > Quad(0)) slopes.push_back(logarithm2(last_error / error));
    last_error = error;
    const std::size_t n = slopes.size();
    if (n >= 4 && std::abs(slopes[n - 1] - slopes[n - 2]) < 0.01 &&
        std::abs(slopes[n - 2] - slopes[n - 3]) < 0.02) {
      result.exact = false;
      result.slope = slopes.back();
      result.settled = true;
      // Round-off that nothing foresaw does not fall, while a method that is wrong is off by more than that.
      if (result.slope < 0.5 && last_error < Quad(largest_round_off)) {
        result.settled = false;
        result.reason = "errors stay at round-off, " + to_scientific(last_error, 1);
      }
      return result;
    }
  }
  if (!slopes.empty()) result.slope = slopes.back();
  if (const std::size_t n = slopes.size(); n >= 3)
    result.moving =
        std::max(std::abs(slopes[n - 1] - slopes[n - 2]), std::abs(slopes[n - 2] - slopes[n - 3]));
  // Slopes that fall where errors are this small are ratios of roundings.
  if (last_error > Quad(0) && last_error < Quad(largest_round_off) && !slopes.empty() &&
      result.slope < *std::max_element(slopes.begin(), slopes.end()) - 1)
    result.moving = 0;
  result.reason = slopes.empty() ? "no two errors between round-off and " + formatted("%g", largest_error)
                                 : "the slope of errors has not settled when round-off comes";
  return result;
}

const Quad interval = Quad(1) / Quad(8);
// Of methods with history, of which the beginning is another method: its part of the interval falls with the
// step, and with it what the slope lacks. Symmetric ones have errors that swing, at each step with another
// phase at the end, and the mean over a few ends does not.
const Quad long_interval = Quad(4);
constexpr std::int64_t fewest_steps = 2 * (longest_beginning + 1);

}  // namespace

MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                            bool history) {
  Errors errors(method, model);
  const Quad time = errors.time();
  // Below the floor, round-off is more than a hundredth of the error. It is that of quad, or, where the
  // coefficients are doubles, that of the coefficients: an error of the field, which is multiplied by the
  // time over which the field is followed, so that it falls with the step.
  const auto floor_after = [&, doubles = method.descriptor().double_coefficients,
                            rate = errors.rate()](const Quad& elapsed) {
    return doubles ? std::max(Quad(1e-32), Quad(1e-15) * rate * elapsed) : Quad(1e-32);
  };
  // What constrained motion remembers is a reaction, which is its own after a step.
  if (history && !model->restricted()) {
    const auto over = [&](const Quad& elapsed) {
      errors.find_solution(elapsed);
      if (errors.across_kinks()) return MeasuredOrder{.reason = across_a_kink};
      return settle([&](int k) { return errors.late(elapsed, fewest_steps << k); }, 10,
                    [&](int k) {
                      // Roundings of n steps of a recurrence of second order add up to n^2 / 2 of them.
                      const Quad n(static_cast<double>(fewest_steps << k));
                      return std::max(Quad(100) * floor_after(elapsed), Quad(1e-35) * n * n);
                    });
    };
    // Where errors do not come below a tenth of the state, a method is wrong or the motion is chaotic; over a
    // short time the first alone is so.
    const MeasuredOrder order = over(long_interval * time);
    return order.settled || order.moving > 0 ? order : over(interval * time);
  }
  if (method.needs_constraints() || history) {
    errors.find_solution(interval * time);
    if (errors.across_kinks()) return MeasuredOrder{.reason = across_a_kink};
    return settle([&](int k) { return errors.after(interval * time, std::int64_t{1} << k); }, 10,
                  [&](int) { return Quad(100) * floor_after(interval * time); });
  }
  // Backwards too: a method may be right for h > 0 alone, but for a symmetric one, whose step of -h undoes
  // that of h.
  const std::vector<Claim> claims = claims_in_scope(method.preserves(*model), *model);
  const bool symmetric = std::find(claims.begin(), claims.end(), Claim::symmetric) != claims.end();
  MeasuredOrder slower;
  for (const double direction : {1.0, -1.0}) {
    if (direction < 0 && symmetric) break;
    const auto step = [&](int k) { return time * Quad(std::ldexp(direction, -k - 1)); };
    bool kinks = false;
    const auto error_of_step = [&](int k) {
      const Quad error = errors.after_one(step(k));
      kinks = kinks || errors.across_kinks();
      return errors.across_kinks() ? Quad(-1) : error;
    };
    MeasuredOrder order = settle(error_of_step, 40, [&](int k) { return floor_after(abs(step(k))); });
    if (!order.settled && kinks) return direction > 0 ? MeasuredOrder{.reason = across_a_kink} : slower;
    order.slope -= 1;
    order.backwards = direction < 0;
    if (order.backwards && !order.settled && !order.exact) slower.forwards_alone = true;
    if (direction > 0 || (order.settled && slower.settled && order.slope < slower.slope - 0.5))
      slower = order;
  }
  return slower;
}

double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                            bool history) {
  Errors errors(method, model);
  const Quad time = errors.time();
  if (history && !model->restricted())
    return logarithm2(errors.late(long_interval * time, fewest_steps << 5) /
                      errors.late(long_interval * time, fewest_steps << 6));
  if (method.needs_constraints() &&
      method.order(*model) <= 2)  // at this h a change of 1e-6 exceeds the error h^2
    return logarithm2(errors.after(interval * time, 512) / errors.after(interval * time, 1024));
  // The slope at the smallest steps whose errors are above round-off is the result.
  double slope = 100;
  Quad h = Quad(1e-2) * time, last(-1);
  for (int k = 0; k < 9; ++k, h = h / Quad(10)) {
    const Quad error = errors.after(h, 1);
    if (error < Quad(1e-32)) break;
    if (last > Quad(0)) slope = logarithm2(last / error) / std::log2(10.0) - 1;
    last = error;
  }
  return slope;
}

}  // namespace pfaff
