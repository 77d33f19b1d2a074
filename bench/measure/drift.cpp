#include <pfaff/bench/measure/drift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pfaff/bench/measure/low_frequency.hpp>

namespace pfaff {
namespace {

using low_frequency::Projection;
using low_frequency::Samples;
using Block = DriftAccumulator::Block;

constexpr std::size_t fewest_samples = 32;  // a series with fewer is not classified
constexpr std::size_t envelope_points = 128;
constexpr double largest_error = 1e150;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Prior weights of the explanations that compete for a series. Trends other than a line get little, so that
/// the data must show one clearly before it is chosen.
constexpr low_frequency::PerNoise no_trend_prior{0.42, 0.42, 0.04};
constexpr double linear_prior = 0.09, other_trend_prior = 0.03;

/// A trend: s^parameter, or exp(parameter s), on scaled time s.
struct Trend {
  bool exponential;
  double parameter;

  double operator()(double s) const { return exponential ? std::exp(parameter * s) : std::pow(s, parameter); }
};
constexpr std::array<Trend, 14> trends{{{false, 0.8},
                                        {false, 1},
                                        {false, 1.25},
                                        {false, 1.5},
                                        {false, 2},
                                        {false, 2.5},
                                        {false, 3},
                                        {false, 4},
                                        {false, 6},
                                        {true, 3},
                                        {true, 5},
                                        {true, 8},
                                        {true, 12},
                                        {true, 16}}};

struct Verdict {
  DriftClass drift_class = DriftClass::undetermined;
  double probability = 0;
  std::optional<double> exponent, rate;  // rate per unit of scaled time
};

Block merged(const Block& a, const Block& b) {
  const std::size_t count = a.count + b.count;
  const double share = double(b.count) / double(count);
  const auto mean = [share](double x, double y) { return x + share * (y - x); };
  return {count,
          mean(a.time, b.time),
          mean(a.mean, b.mean),
          std::min(a.minimum, b.minimum),
          std::max(a.maximum, b.maximum),
          mean(a.mean_square, b.mean_square)};
}

/// The trend parameter near that of `start` that explains the data best, by golden-section search. The
/// exponent 1 (a line) is kept unless the best one is better by more than 2 in log evidence.
double refined(const Projection& data, Trend start) {
  const auto evidence = [&](double x) { return data.with_trend(Trend{start.exponential, x}); };
  double low = 0.75 * start.parameter, high = 1.34 * start.parameter;
  constexpr double ratio = 0.6180339887498949;
  double left = high - ratio * (high - low), right = low + ratio * (high - low);
  double at_left = evidence(left), at_right = evidence(right);
  while (high - low > 1e-3 * high) {
    if (at_left > at_right) {
      high = right, right = left, at_right = at_left;
      left = high - ratio * (high - low), at_left = evidence(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + ratio * (high - low), at_right = evidence(right);
    }
  }
  const double best = (low + high) / 2;
  return start.parameter == 1 && evidence(best) < evidence(1) + 2 ? 1 : best;
}

Verdict classify(const Projection& data, const low_frequency::Slope& slope) {
  const Projection::NoiseEvidence noise = data.without_trend();
  low_frequency::PerNoise plain{};
  std::array<double, trends.size()> with_trend{};
  double top = -infinity;
  for (std::size_t kind = 0; kind < plain.size(); ++kind)
    top = std::max(top, plain[kind] = noise.log_evidence[kind] + std::log(no_trend_prior[kind]));
  for (std::size_t i = 0; i < trends.size(); ++i) {
    const bool line = !trends[i].exponential && trends[i].parameter == 1;
    const double prior = line ? linear_prior : other_trend_prior / double(trends.size() - 1);
    top = std::max(top, with_trend[i] = data.with_trend(trends[i]) + std::log(prior));
  }
  double trend = 0, total = 0;
  for (double& value : with_trend) trend += value = std::exp(value - top);
  for (double& value : plain) total += value = std::exp(value - top);
  total += trend;

  const auto best = std::size_t(std::max_element(plain.begin(), plain.end()) - plain.begin());
  if (trend > 0.5 * total) {
    const Trend likely =
        trends[std::size_t(std::max_element(with_trend.begin(), with_trend.end()) - with_trend.begin())];
    const double parameter = refined(data, likely), probability = trend / total;
    if (likely.exponential) return {DriftClass::exponential, probability, {}, parameter};
    if (parameter > 1.25) return {DriftClass::polynomial, probability, parameter, {}};
    if (parameter >= 0.75 && std::abs(slope.value) > slope.half_width)
      return {DriftClass::linear, probability, parameter, {}};
  }
  const double probability = plain[best] / total;
  if (probability <= 0.5 || best == low_frequency::smooth) return {};
  if (best == low_frequency::walk) return {DriftClass::random_walk, probability, noise.walk_exponent, {}};
  return {DriftClass::bounded, probability, 0.0, {}};
}

/// Sum of squared residuals of the least-squares line through (x, y), and its slope.
struct Line {
  double slope, residual, total;
};
Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;
    mean_x += dx / double(i + 1);
    mean_y += dy / double(i + 1);
    xx += dx * (x[i] - mean_x);
    xy += dx * (y[i] - mean_y);
    yy += dy * (y[i] - mean_y);
  }
  return {xy / xx, yy - xy * xy / xx, yy};
}

/// The rate, per unit of s, at which the envelope grows exponentially; nothing where it does not. Only the
/// part after the envelope has last been within ten times its smallest value is looked at, since growth
/// starts from a floor of round-off.
std::optional<double> exponential_rate(const Samples& envelope) {
  double floor = infinity;
  for (double value : envelope.value)
    if (value > 0) floor = std::min(floor, value);
  std::size_t start = 0;
  for (std::size_t i = 0; i < envelope.value.size(); ++i)
    if (envelope.value[i] <= 10 * floor) start = i + 1;
  std::vector<double> s, log_s, log_value;
  for (std::size_t i = start; i < envelope.value.size(); ++i) {
    s.push_back(envelope.s[i]);
    log_s.push_back(std::log(envelope.s[i]));
    log_value.push_back(std::log(envelope.value[i]));
  }
  if (s.size() < 6) return {};
  const Line exponential = fit_line(s, log_value), power = fit_line(log_s, log_value);
  const bool grows = exponential.slope * (s.back() - s.front()) > 3;
  const bool fits =
      exponential.residual < 0.1 * exponential.total && exponential.residual < 0.25 * power.residual;
  return grows && fits ? std::optional(exponential.slope) : std::nullopt;
}

/// True where the mean over the last quarter of the series is more than twice that over the first.
bool doubles(const std::vector<double>& value) {
  double early = 0, late = 0;
  for (std::size_t i = 0; i < value.size() / 4; ++i) {
    early += value[i];
    late += value[value.size() - 1 - i];
  }
  return late > 2 * early;
}

}  // namespace

DriftAccumulator::DriftAccumulator(std::size_t capacity)
    : capacity_(std::max<std::size_t>(capacity + capacity % 2, 64)) {
  blocks_.reserve(capacity_);
}

void DriftAccumulator::add(double t, double error) {
  if (!std::isfinite(t) || !(std::abs(error) <= largest_error)) {
    if (non_finite_++ == 0) non_finite_time_ = t;
    return;
  }
  if (non_finite_ > 0) return;
  if (samples_++ == 0) first_time_ = t;
  last_time_ = t;
  last_error_ = error;
  const double dt = t - moments_.mean_time, de = error - moments_.mean;
  moments_.mean_time += dt / double(samples_);
  moments_.mean += de / double(samples_);
  moments_.time_time += dt * (t - moments_.mean_time);
  moments_.time_error += dt * (error - moments_.mean);
  moments_.error_error += de * (error - moments_.mean);

  const Block sample{1, t, error, error, error, error * error};
  if (!blocks_.empty() && blocks_.back().count < block_length_) {
    blocks_.back() = merged(blocks_.back(), sample);
    return;
  }
  if (blocks_.size() == capacity_) {
    for (std::size_t i = 0; i < capacity_ / 2; ++i) blocks_[i] = merged(blocks_[2 * i], blocks_[2 * i + 1]);
    blocks_.resize(capacity_ / 2);
    block_length_ *= 2;
  }
  blocks_.push_back(sample);
}

Drift DriftAccumulator::result() const {
  Drift drift;
  drift.samples = samples_;
  drift.non_finite = non_finite_;
  if (non_finite_ > 0) drift.non_finite_time = non_finite_time_;
  drift.slope_low = -infinity, drift.slope_high = infinity;
  if (samples_ == 0) return drift;

  const double line = moments_.time_time > 0 ? moments_.time_error / moments_.time_time : 0;
  double mean_square = 0, above = -infinity, below = infinity;
  for (const Block& block : blocks_) {
    drift.maximum = std::max({drift.maximum, std::abs(block.minimum), std::abs(block.maximum)});
    mean_square += block.mean_square * (double(block.count) / double(samples_));
    const double trend = moments_.mean + line * (block.time - moments_.mean_time);
    above = std::max(above, block.maximum - trend);
    below = std::min(below, block.minimum - trend);
  }
  drift.rms = std::sqrt(mean_square);
  drift.final_value = last_error_;
  drift.slope = line;
  drift.oscillation_amplitude = (above - below) / 2;
  drift.oscillation_rms =
      std::sqrt(std::max(moments_.error_error - line * moments_.time_error, 0.0) / double(samples_));
  if (drift.maximum == 0 && samples_ > 1) {
    drift.slope_low = drift.slope_high = 0;
    if (non_finite_ > 0) return drift;
    drift.drift_class = DriftClass::exact;
    drift.probability = 1;
    return drift;
  }
  if (samples_ < 4 || !(moments_.time_time > 0)) return drift;

  // Sample k of n sits at s = (k + 1/2) / n.
  const double span = (last_time_ - first_time_) * double(samples_) / double(samples_ - 1);
  const double origin = first_time_ - span / double(2 * samples_);
  Samples means, envelope;
  const auto append = [&](Samples& to, const Block& block, double value) {
    to.s.push_back((block.time - origin) / span);
    to.value.push_back(value);
    to.count.push_back(double(block.count));
  };
  for (const Block& block : blocks_) append(means, block, block.mean);
  const double resolution = std::numeric_limits<double>::epsilon() * drift.maximum;
  const Projection data(means, resolution);
  const low_frequency::Slope slope = data.slope();
  drift.slope = slope.value / span;
  drift.slope_low = drift.slope - slope.half_width / std::abs(span);
  drift.slope_high = drift.slope + slope.half_width / std::abs(span);
  if (samples_ < fewest_samples || non_finite_ > 0) return drift;

  Verdict verdict = classify(data, slope);
  const std::size_t group = (blocks_.size() + envelope_points - 1) / envelope_points;
  for (std::size_t first = 0; first + group <= blocks_.size(); first += group) {
    Block block = blocks_[first];
    for (std::size_t i = 1; i < group; ++i) block = merged(block, blocks_[first + i]);
    append(envelope, block, std::sqrt(block.mean_square));
  }
  if (const std::optional<double> rate = exponential_rate(envelope)) {
    verdict = {DriftClass::exponential, 1.0, {}, rate};
  } else if (verdict.drift_class == DriftClass::bounded && doubles(envelope.value)) {
    const Projection amplitude(envelope, resolution);
    const Verdict growth = classify(amplitude, amplitude.slope());
    if (growth.drift_class != DriftClass::undetermined) verdict = growth;
  }
  drift.drift_class = verdict.drift_class;
  drift.probability = verdict.probability;
  drift.growth_exponent = verdict.exponent;
  if (verdict.rate) drift.growth_rate = *verdict.rate / span;
  return drift;
}

}  // namespace pfaff
