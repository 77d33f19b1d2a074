// Moves against the expected direction. For a quantity that is expected to decrease this is the largest rise
// above its lowest value so far; for one that is expected to increase, the largest fall below its highest.
// Along exact solutions there are no such moves, so any that a run shows are errors of the method.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The words for such a move in messages and files.
struct SetbackWords {
  std::string_view move;  // "rise" or "fall"; summary.json calls the largest one largest_rise, largest_fall
  std::string_view expected;  // what the quantity is expected to do: "decrease" or "increase"
};

/// The words for a behaviour; nothing for a behaviour without a direction.
constexpr std::optional<SetbackWords> setback_words(Behaviour behaviour) {
  switch (behaviour) {
    case Behaviour::decreasing:
      return SetbackWords{"rise", "decrease"};
    case Behaviour::increasing:
      return SetbackWords{"fall", "increase"};
    case Behaviour::conserved:
    case Behaviour::free:
      break;
  }
  return std::nullopt;
}

/// What is expected of a quantity along a run backwards in time: one that decreases with time increases
/// there.
constexpr Behaviour seen_backwards(Behaviour behaviour) {
  if (behaviour == Behaviour::decreasing) return Behaviour::increasing;
  if (behaviour == Behaviour::increasing) return Behaviour::decreasing;
  return behaviour;
}

/// The largest move against the expected direction among the values so far.
template <class T>
class Setback {
 public:
  explicit Setback(Behaviour behaviour)
      : watched_(setback_words(behaviour).has_value()), increasing_(behaviour == Behaviour::increasing) {}

  /// Takes the next value. Not-a-number counts as no move.
  void add(const T& value) {
    if (!watched_) return;
    const T depth = increasing_ ? T(-value) : value;
    lowest_ = std::min(lowest_, depth);
    largest_ = std::max(largest_, static_cast<double>(depth - lowest_));
  }
  /// The largest move, in the unit of the quantity; 0 for a behaviour without a direction.
  [[nodiscard]] double largest() const { return largest_; }

 private:
  bool watched_, increasing_;
  T lowest_ = std::numeric_limits<T>::infinity();
  double largest_ = 0;
};

}  // namespace pfaff
