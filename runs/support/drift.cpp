#include <pfaff/runs/support/drift.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/runs/support/drift_rules.hpp>

namespace pfaff {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

DriftAccumulator::DriftAccumulator(std::size_t capacity)
    : capacity_(std::max<std::size_t>(capacity + capacity % 2, 64)) {}

void DriftAccumulator::add(double t, double error) {
  take_waiting();
  take_one(t, error);
}

void DriftAccumulator::add(double t0, double h, std::int64_t first, std::int64_t stride,
                           std::span<const double> errors) {
  const Steps steps{t0, h, first, stride};
  Steps next = steps_of_waiting_;
  next.first += static_cast<std::int64_t>(waiting_.size()) * next.stride;
  if (!waiting_.empty() && steps != next) take_waiting();
  if (waiting_.empty()) steps_of_waiting_ = steps;
  while (!errors.empty()) {
    const std::size_t some = std::min(most_waiting - waiting_.size(), errors.size());
    if (waiting_.size() + some > waiting_.capacity())
      waiting_.reserve(waiting_.capacity() == 0 ? std::max(first_room, some) : most_waiting);
    waiting_.insert(waiting_.end(), errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(some));
    errors = errors.subspan(some);
    if (waiting_.size() == most_waiting) take_waiting();
  }
}

// Groups end where blocks do, whose lengths are powers of two.
void DriftAccumulator::take_waiting() {
  if (waiting_.empty()) return;
  Steps& steps = steps_of_waiting_;
  const double dt = static_cast<double>(steps.stride) * steps.h;
  while (known_length_ * capacity_ < samples_ + waiting_.size()) known_length_ *= 2;
  for (std::size_t done = 0; done < waiting_.size();) {
    const std::size_t some = std::min(group - samples_ % group, waiting_.size() - done);
    take(steps.t0 + static_cast<double>(steps.first) * steps.h, dt, std::span(waiting_).subspan(done, some));
    steps.first += static_cast<std::int64_t>(some) * steps.stride;
    done += some;
  }
  waiting_.clear();
}

void DriftAccumulator::take(double t, double dt, std::span<const double> errors) {
  if (non_finite_ > 0) return;
  const sums::Sums all = sums::of(errors, samples_ > 0 ? last_error_ : errors[0]);
  const bool finite = std::isfinite(all.sum) && std::max(-all.low, all.high) <= largest_error &&
                      std::isfinite(t + dt * static_cast<double>(errors.size()));
  if (!finite) {
    for (std::size_t k = 0; k < errors.size(); ++k) take_one(t + static_cast<double>(k) * dt, errors[k]);
    return;
  }
  if (samples_ == 0) first_time_ = t;
  add_moments(t, dt, errors.back(), all);
  note_values(errors);
  for (std::size_t done = 0; done < errors.size();) {
    const std::size_t some = std::min(room_in_block(), errors.size() - done);
    const std::span<const double> part = errors.subspan(done, some);
    append(sums::block_of(some == errors.size() ? all : sums::of(part, part[0]),
                          t + static_cast<double>(done) * dt, dt));
    done += some;
  }
}

void DriftAccumulator::take_one(double t, double error) {
  if (!std::isfinite(t) || !(std::abs(error) <= largest_error)) {
    if (non_finite_++ == 0) non_finite_time_ = t;
    return;
  }
  if (non_finite_ > 0) return;
  if (samples_++ == 0) first_time_ = t;
  if (samples_ > 1 && error != last_error_) ++(error > last_error_ ? rises_ : falls_);
  note_values({&error, 1});
  last_time_ = t;
  last_error_ = error;
  const double dt = t - moments_.mean_time, de = error - moments_.mean;
  moments_.mean_time += dt / double(samples_);
  moments_.mean += de / double(samples_);
  moments_.time_time += dt * (t - moments_.mean_time);
  moments_.time_error += dt * (error - moments_.mean);
  moments_.error_error += de * (error - moments_.mean);
  append({1, t, error, error, error, error * error});
}

// Sums about the means of two sets of samples give those about the means of both [chan-golub-leveque1983].
void DriftAccumulator::add_moments(double t, double dt, double last, const sums::Sums& of) {
  const auto count = static_cast<double>(of.count), before = static_cast<double>(samples_);
  const double total = before + count, weight = before * count / total;
  const double away_time = t + dt * (count - 1) / 2 - moments_.mean_time;
  const double away = of.shift + of.sum / count - moments_.mean;
  moments_.time_time += dt * dt * count * (count * count - 1) / 12 + away_time * away_time * weight;
  moments_.time_error += dt * (of.ramp - (count - 1) / 2 * of.sum) + away_time * away * weight;
  moments_.error_error += std::max(of.square - of.sum * of.sum / count, 0.0) + away * away * weight;
  moments_.mean_time += away_time * count / total;
  moments_.mean += away * count / total;
  samples_ += of.count;
  rises_ += of.rises;
  falls_ += of.falls;
  last_time_ = t + dt * (count - 1);
  last_error_ = last;
}

void DriftAccumulator::note_values(std::span<const double> errors) {
  for (const double error : errors) {
    if (values_.size() > most_values) return;
    if (std::find(values_.begin(), values_.end(), error) == values_.end()) values_.push_back(error);
  }
}

// How many samples the last block takes before it is full.
std::size_t DriftAccumulator::room_in_block() const {
  const bool full = blocks_.empty() || blocks_.back().count >= block_length_;
  return full ? block_length_ : block_length_ - blocks_.back().count;
}

void DriftAccumulator::append(const windows::Block& some) {
  if (!blocks_.empty() && blocks_.back().count < block_length_) {
    blocks_.back() = merged(blocks_.back(), some);
    return;
  }
  const bool grows = block_length_ < known_length_ && blocks_.size() >= std::min(most_at_start, capacity_);
  if (grows || blocks_.size() == capacity_) {
    double_length();
    append(some);
    return;
  }
  blocks_.push_back(some);
}

// Merges neighbours; the last block, where it is without one, goes on to be filled.
void DriftAccumulator::double_length() {
  starts_.emplace_back(blocks_.begin(),
                       blocks_.begin() + std::ptrdiff_t(std::min(most_at_start, blocks_.size())));
  const std::size_t pairs = blocks_.size() / 2;
  for (std::size_t i = 0; i < pairs; ++i) blocks_[i] = merged(blocks_[2 * i], blocks_[2 * i + 1]);
  if (blocks_.size() % 2 == 1) blocks_[pairs] = blocks_.back();
  blocks_.resize(pairs + blocks_.size() % 2);
  block_length_ *= 2;
}

Drift DriftAccumulator::result(const RoundOff& round_off) const {
  if (waiting_.empty()) return result_of_taken(round_off);
  DriftAccumulator whole = *this;
  whole.take_waiting();
  return whole.result_of_taken(round_off);
}

namespace {
// Of all errors in blocks, the largest less the smallest.
double range_of(const std::vector<windows::Block>& blocks) {
  double smallest = infinity, largest = -infinity;
  for (const windows::Block& block : blocks)
    smallest = std::min(smallest, block.minimum), largest = std::max(largest, block.maximum);
  return largest - smallest;
}
}  // namespace

Drift DriftAccumulator::result_of_taken(const RoundOff& round_off) const {
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
    if (const double whole = range_of(blocks_); std::abs(slope.value * span) > 1.5 * whole) {
      // No line of least squares through errors in such a range is so steep (at most by 3/2). What models of
      // correlated noise make of errors that leave their start and then stay, say, is no trend.
      drift.slope = line;
      drift.slope_low = std::min({slope.low, line, 0.0}),
      drift.slope_high = std::max({slope.high, line, 0.0});
    }
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
