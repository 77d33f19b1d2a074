#include <pfaff/runs/support/drift.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/runs/support/drift_rules.hpp>

namespace pfaff {

namespace {
constexpr double largest_error = 1e150;
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

DriftAccumulator::DriftAccumulator(std::size_t capacity)
    : capacity_(std::max<std::size_t>(capacity + capacity % 2, 64)) {
  blocks_.reserve(capacity_);
  values_.reserve(most_values + 1);
}

void DriftAccumulator::add(double t, double error) {
  if (!std::isfinite(t) || !(std::abs(error) <= largest_error)) {
    if (non_finite_++ == 0) non_finite_time_ = t;
    return;
  }
  if (non_finite_ > 0) return;
  if (samples_++ == 0) first_time_ = t;
  if (samples_ > 1 && error != last_error_) ++(error > last_error_ ? rises_ : falls_);
  if (values_.size() <= most_values && std::find(values_.begin(), values_.end(), error) == values_.end())
    values_.push_back(error);
  last_time_ = t;
  last_error_ = error;
  const double dt = t - moments_.mean_time, de = error - moments_.mean;
  moments_.mean_time += dt / double(samples_);
  moments_.mean += de / double(samples_);
  moments_.time_time += dt * (t - moments_.mean_time);
  moments_.time_error += dt * (error - moments_.mean);
  moments_.error_error += de * (error - moments_.mean);

  const windows::Block sample{1, t, error, error, error, error * error};
  if (!blocks_.empty() && blocks_.back().count < block_length_) {
    blocks_.back() = merged(blocks_.back(), sample);
    return;
  }
  if (blocks_.size() == capacity_) {
    starts_.emplace_back(blocks_.begin(),
                         blocks_.begin() + std::ptrdiff_t(std::min(most_at_start, capacity_)));
    for (std::size_t i = 0; i < capacity_ / 2; ++i) blocks_[i] = merged(blocks_[2 * i], blocks_[2 * i + 1]);
    blocks_.resize(capacity_ / 2);
    block_length_ *= 2;
  }
  blocks_.push_back(sample);
}

Drift DriftAccumulator::result(const RoundOff& round_off) const {
  Drift drift;
  drift.samples = samples_;
  drift.non_finite = non_finite_;
  if (non_finite_ > 0) drift.non_finite_time = non_finite_time_;
  drift.slope_low = -infinity, drift.slope_high = infinity;
  drift.evidence = "no samples";
  if (samples_ == 0) return drift;

  const double line = moments_.time_time > 0 ? moments_.time_error / moments_.time_time : 0;
  double mean_square = 0;
  for (const windows::Block& block : blocks_) {
    drift.maximum = std::max({drift.maximum, std::abs(block.minimum), std::abs(block.maximum)});
    mean_square += block.mean_square * (double(block.count) / double(samples_));
  }
  drift.rms = std::sqrt(mean_square);
  drift.final_value = last_error_;
  drift.slope = line;
  drift.oscillation_rms =
      std::sqrt(std::max(moments_.error_error - line * moments_.time_error, 0.0) / double(samples_));

  drift_rules::Observed observed{
      {}, starts_, values_, rises_, falls_, drift.maximum, drift.non_finite_time, round_off};
  if (samples_ > 1 && moments_.time_time > 0)
    observed.series = windows::on_scaled_time(blocks_, first_time_, last_time_);
  const drift_rules::Verdict verdict = drift_rules::judge(observed);
  drift.drift_class = verdict.drift_class;
  drift.evidence = verdict.evidence;
  drift.exponent = verdict.exponent;
  double span = observed.series.span;
  const auto per_time = [&span](const windows::Estimate& x) {
    return windows::Estimate{x.value / span, std::min(x.low / span, x.high / span),
                             std::max(x.low / span, x.high / span)};
  };
  if (verdict.slope) {
    const windows::Estimate slope = per_time({verdict.slope->value, verdict.slope->low, verdict.slope->high});
    drift.slope = slope.value, drift.slope_low = slope.low, drift.slope_high = slope.high;
  }
  double above = -infinity, below = infinity;
  for (const windows::Block& block : blocks_) {
    const double trend = moments_.mean + drift.slope * (block.time - moments_.mean_time);
    above = std::max(above, block.maximum - trend);
    below = std::min(below, block.minimum - trend);
  }
  drift.oscillation_amplitude = (above - below) / 2;
  if (verdict.of_start) {
    span = verdict.of_start->span;
    const windows::Slope& s = verdict.of_start->slope;
    const windows::Estimate slope = per_time({s.value, s.low, s.high});
    drift.slope = slope.value, drift.slope_low = slope.low, drift.slope_high = slope.high;
  }
  if (verdict.rate) drift.rate = per_time(*verdict.rate);
  return drift;
}

}  // namespace pfaff
