// CountedOutputs: room for a formula's results that knows which of them were written.
//
// A formula gets a span and may write past its end, which nothing in the language reports. While it is
// recorded the span lies in a larger array whose elements are zeros with a mark, which any assignment
// removes.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

class CountedOutputs {
 public:
  explicit CountedOutputs(int count)
      : count_(static_cast<std::size_t>(count)), values_(count_ + spare, Recorded::unwritten()) {}

  /// What the formula gets.
  [[nodiscard]] std::span<Recorded> span() { return {values_.data(), count_}; }
  /// One more than the last index written, past the end of the span too.
  [[nodiscard]] std::size_t written() const {
    const auto last = std::find_if(values_.rbegin(), values_.rend(), is_written);
    return static_cast<std::size_t>(values_.rend() - last);
  }
  /// The first index of the span that was not written; its size when all were.
  [[nodiscard]] std::size_t first_unwritten() const {
    const auto end = values_.begin() + static_cast<std::ptrdiff_t>(count_);
    return static_cast<std::size_t>(std::find_if_not(values_.begin(), end, is_written) - values_.begin());
  }

 private:
  static constexpr std::size_t spare = 256;  // how far past the end a mistake is still seen
  static bool is_written(const Recorded& x) { return !x.is_unwritten(); }

  std::size_t count_;
  std::vector<Recorded> values_;
};

}  // namespace pfaff
