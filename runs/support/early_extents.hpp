// How far the coordinates of a run reach early in it.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pfaff {

/// The largest size of every coordinate over the first samples of a run. How many these are is known only
/// when it has ended. So extents are kept as they were after each number of samples up to 128, and behind
/// that after numbers of which there are 64 between two powers of two, and that which is looked for in a run
/// that goes to its end.
class EarlyExtents {
 public:
  /// For a run of so many samples, if it does not end before.
  explicit EarlyExtents(std::size_t samples) : planned_(early(samples)) {}
  void add(const std::vector<double>& z) {
    ++samples_;
    if (samples_ > planned_) return;
    extents_.resize(z.size());
    bool wider = samples_ == 1;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (std::abs(z[i]) > extents_[i]) extents_[i] = std::abs(z[i]), wider = true;
    changed_ = changed_ || wider;
    const std::size_t apart = std::max<std::size_t>(1, std::bit_floor(samples_) / 64);
    if (!changed_ || (samples_ % apart != 0 && samples_ != planned_)) return;
    kept_.push_back({samples_, extents_});
    changed_ = false;
  }
  /// Counts samples behind those that are looked at.
  void pass(std::size_t samples) { samples_ += samples; }
  /// Whether the next sample is looked at.
  [[nodiscard]] bool looks() const { return samples_ < planned_; }
  /// Those of the first tenth of all samples, and of eight at least.
  [[nodiscard]] std::vector<double> first_tenth() const {
    std::vector<double> extents(extents_.size());
    for (const Kept& kept : kept_)
      if (kept.samples <= early(samples_)) extents = kept.extents;
    return extents;
  }

 private:
  struct Kept {
    std::size_t samples;
    std::vector<double> extents;
  };
  static std::size_t early(std::size_t samples) { return std::max<std::size_t>(8, samples / 10); }

  std::size_t planned_, samples_ = 0;
  std::vector<double> extents_;
  bool changed_ = false;  // since extents were last kept
  std::vector<Kept> kept_;
};

}  // namespace pfaff
