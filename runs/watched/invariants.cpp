#include <pfaff/runs/watched/invariants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include <pfaff/runs/support/own_range.hpp>

namespace pfaff {

template <class T>
WatchedInvariants<T>::WatchedInvariants(std::shared_ptr<const Model> model, bool backwards,
                                        std::size_t samples)
    : model_(std::move(model)),
      values_(model_->invariants().size()),
      drift_(values_.size()),
      extents_(samples) {
  for (const Invariant& invariant : model_->invariants())
    setbacks_.emplace_back(backwards ? seen_backwards(invariant.behaviour) : invariant.behaviour);
  if (values_.empty()) return;
  problem_.emplace(model_);
  roundings_.emplace(model_->tape(Formula::invariants));
}

template <class T>
std::string WatchedInvariants<T>::take(const T& t, const std::vector<T>& z) {
  const auto& invariants = model_->invariants();
  if (problem_) problem_->invariants(t, z, values_);
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (!isfinite(values_[i])) return "the invariant " + invariants[i].name + " is not finite";
  if (initial_.empty()) initial_ = values_;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const bool finite = drift_[i].add(static_cast<double>(t), static_cast<double>(values_[i] - initial_[i]));
    setbacks_[i].add(values_[i]);
    if (invariants[i].behaviour == Behaviour::conserved && !finite)
      return "the drift of " + invariants[i].name + " is not finite";
    if (!std::isfinite(setbacks_[i].largest()))
      return "the setback of " + invariants[i].name + " is not finite";
  }
  return {};
}

template <class T>
bool WatchedInvariants<T>::evaluate(const Block<T>& block) {
  if (values_.empty()) return true;
  if (block_values_ == nullptr)
    block_values_ =
        std::make_unique<BlockValues<T>>(model_, Formula::invariants, values_.size(), block.capacity);
  in_block_ = &(*block_values_)(block);
  errors_.resize(values_.size() * block.rows);
  bool fit = true;
  for (std::size_t i = 0; i < values_.size(); ++i)
    fit = errors_of(i, {errors_.data() + i * block.rows, block.rows}) && fit;
  return fit;
}

// The errors of an invariant at the rows of the block; whether drift takes each of them.
template <class T>
bool WatchedInvariants<T>::errors_of(std::size_t i, std::span<double> errors) const {
  std::array<double, lanes<T>> unfit{};
  const auto take = [&](std::size_t tile, std::size_t lane) {
    const double error = static_cast<double>(in_block_->tile(tile)[i * lanes<T> + lane] - initial_[i]);
    errors[tile * lanes<T> + lane] = error;
    unfit[lane] += std::abs(error) <= DriftAccumulator::largest_error ? 0.0 : 1.0;
  };
  const std::size_t tiles = errors.size() / lanes<T>, rest = errors.size() % lanes<T>;
  for (std::size_t tile = 0; tile < tiles; ++tile)
    for (std::size_t lane = 0; lane < lanes<T>; ++lane) take(tile, lane);
  for (std::size_t lane = 0; lane < rest; ++lane) take(tiles, lane);
  return std::all_of(unfit.begin(), unfit.end(), [](double count) { return count == 0; });
}

template <class T>
void WatchedInvariants<T>::take(const Block<T>& block, std::size_t rows) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    drift_[i].add(static_cast<double>(block.t0), static_cast<double>(block.h), block.first, block.stride,
                  {errors_.data() + i * block.rows, rows});
    if (setback_words(model_->invariants()[i].behaviour))
      for (std::size_t row = 0; row < rows; ++row) setbacks_[i].add(in_block_->at(row, i));
  }
}

template <class T>
void WatchedInvariants<T>::at_row(std::size_t row) {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = in_block_->at(row, i);
}

template <class T>
void WatchedInvariants<T>::sample(double t, const std::vector<double>& z) {
  if (roundings_ && to_next_looked_at() == 0) roundings_->add(t, z);
  count_samples(1);
  extents_.add(z);
  if (!first_state_.empty()) return;
  first_time_ = t;
  first_state_ = z;
}

template <class T>
void WatchedInvariants<T>::sample(const Block<T>& block, const ChosenRows& rows) {
  extents_.add(block.states, rows);
  for (std::size_t k = 0; k < rows.count; ++k) {
    const std::size_t passed = std::min(to_next_looked_at(), rows.count - k);
    count_samples(passed);
    k += passed;
    if (k == rows.count) return;
    if (roundings_)
      roundings_->add(static_cast<double>(block.time(rows[k])), extents_.state(block.states, rows[k]));
    count_samples(1);
  }
}

// How many samples stand before the next one at which it is found what roundings do.
template <class T>
std::size_t WatchedInvariants<T>::to_next_looked_at() const {
  const std::size_t mask = apart_ - 1;  // apart_ is a power of two
  return (apart_ - (samples_ & mask)) & mask;
}

// No more than up to the next one at which it is found.
template <class T>
void WatchedInvariants<T>::count_samples(std::size_t count) {
  samples_ += count;
  if (samples_ == most_roundings * apart_) apart_ *= 2;
}

// What there is of each invariant to lose; the extents are those of the first tenth of the motion, since what
// is lost or blows up changes them.
template <class T>
std::vector<double> WatchedInvariants<T>::ranges() {
  if (first_state_.empty() || !roundings_) return {};
  StartOfMotion start{first_time_, first_state_, extents_.first_tenth(), {}, roundings_->first_terms()};
  for (const T& value : initial_) start.values.push_back(static_cast<double>(value));
  return own_ranges(*model_, start);
}

template <class T>
InvariantsLeft WatchedInvariants<T>::left(std::int64_t steps) {
  InvariantsLeft left;
  const double unit = std::is_same_v<T, Quad> ? 0x1p-113 : 0x1p-53;
  const std::vector<double> own = ranges();
  for (std::size_t i = 0; i < drift_.size(); ++i) {
    RoundOff round_off = roundings_->largest(unit, steps, i, drift_.size());
    if (i < own.size()) round_off.range = own[i];
    left.drift.push_back(drift_[i].result(round_off));
    left.round_off.push_back(round_off);
    left.setback.push_back(setbacks_[i].largest());
  }
  return left;
}

template class WatchedInvariants<double>;
template class WatchedInvariants<Quad>;

}  // namespace pfaff
