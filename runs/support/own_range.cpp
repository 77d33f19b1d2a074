#include <pfaff/runs/support/own_range.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <pfaff/runs/support/output_gradients.hpp>

namespace pfaff {

namespace {

// A range that is so small beside the terms may be their roundings.
constexpr double least_part = 0x1p-46;

// Steps of Barzilai and Borwein [barzilai-borwein1988 (5)] down sign * output, in coordinates divided by
// their extents.
class Descent {
 public:
  Descent(const std::shared_ptr<const Tape>& tape, double t, const std::vector<double>& extents)
      : t_(t), extents_(extents), values_(tape->outputs.size()), replay_(tape), gradients_(*tape) {}

  /// How far sign * output falls from the start to a minimum; nothing where it comes to none.
  std::optional<double> distance(std::size_t output, const std::vector<double>& start, double sign) {
    output_ = output;
    std::vector<double> z = start, slope = gradient(z, sign), last_z, last_slope, next(z.size());
    const double begin = sign * value(z);
    double now = begin, length = 0.1 / norm(slope);
    if (!std::isfinite(begin) || !std::isfinite(length)) return std::nullopt;
    for (int k = 0; k < most_steps; ++k) {
      if (k > 0 && left(z, slope) <= precision * (begin - now)) {
        if (!leave_saddle(z, sign, now - precision * (begin - now))) return begin - now;
        slope = gradient(z, sign);
        now = sign * value(z);
        length = 0.1 / norm(slope);
      }
      length = std::min(length, 1 / norm(slope));  // no step is longer than the motion
      double reached = now;
      for (int halving = 0; halving < 60; ++halving, length /= 2) {
        for (std::size_t i = 0; i < z.size(); ++i) next[i] = z[i] - length * slope[i] * extents_[i];
        if (reached = sign * value(next); reached < now) break;
      }
      if (!(reached < now)) return std::nullopt;
      last_z = std::exchange(z, next);
      last_slope = std::exchange(slope, gradient(z, sign));
      now = reached;
      if (!std::isfinite(now) || !std::isfinite(norm(slope))) return std::nullopt;
      double moved = 0, turned = 0;
      for (std::size_t i = 0; i < z.size(); ++i) {
        if (extents_[i] == 0) continue;
        const double move = (z[i] - last_z[i]) / extents_[i];
        moved += move * move;
        turned += move * (slope[i] - last_slope[i]);
      }
      length = turned > 0 ? moved / turned : 4 * length;
    }
    return std::nullopt;
  }

 private:
  static constexpr int most_steps = 400;
  static constexpr double precision = 0.05;

  double value(const std::vector<double>& z) {
    replay_(t_, z.data(), values_.data());
    return values_[output_];
  }
  std::vector<double> gradient(const std::vector<double>& z, double sign) {
    std::vector<double> slope(z.size());
    const std::vector<double>& slopes = gradients_.values(t_, z.data());
    const auto& entries = gradients_.entries();
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (entries[e].output == output_)
        slope[entries[e].input] = sign * slopes[e] * extents_[entries[e].input];
    return slope;
  }
  // Moves z along one coordinate to where sign * output is below `lower`, which there is beside a saddle and
  // not beside a minimum; false where there is no such place. A motion that starts at rest has no momenta to
  // lead away from the one above it.
  bool leave_saddle(std::vector<double>& z, double sign, double lower) {
    for (std::size_t i = 0; i < z.size(); ++i)
      for (const double part : {0.5, -0.5}) {
        const double before = z[i];
        z[i] += part * extents_[i];
        if (sign * value(z) < lower) return true;
        z[i] = before;
      }
    return false;
  }
  static double norm(const std::vector<double>& x) {
    double sum = 0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum);
  }
  // What a further step that is as long as the way so far, or as the motion, might gain. Far out, where a
  // quantity falls for ever, that is as much as what was gained.
  [[nodiscard]] double left(const std::vector<double>& z, const std::vector<double>& slope) const {
    double sum = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (extents_[i] > 0) sum += std::abs(slope[i]) * std::max(1.0, std::abs(z[i]) / extents_[i]);
    return sum;
  }

  std::size_t output_ = 0;
  double t_;
  const std::vector<double>& extents_;
  std::vector<double> values_;
  Replay<double> replay_;
  OutputGradients<double> gradients_;
};

}  // namespace

std::vector<double> own_ranges(const Model& model, const StartOfMotion& start) {
  const std::shared_ptr<const Tape> tape = model.tape(Formula::invariants);
  std::optional<Descent> descent;
  if (!model.restricted() && takes_gradients(*tape)) descent.emplace(tape, start.t, start.extents);
  std::vector<double> ranges;
  for (std::size_t k = 0; k < start.values.size(); ++k) {
    double range = std::abs(start.values[k]);
    if (descent) {
      const auto down = descent->distance(k, start.z, 1), up = descent->distance(k, start.z, -1);
      if (down || up) range = std::min(down.value_or(HUGE_VAL), up.value_or(HUGE_VAL));
    }
    ranges.push_back(range > least_part * start.terms[k] ? range : start.terms[k]);
  }
  return ranges;
}

}  // namespace pfaff
