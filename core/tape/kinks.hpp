// The kinks of a field along its solution: where the condition of a `select` on its tape (core/tape/tape.hpp)
// changes its sign, so that the power series of the solution ends. abs, sign, min and max are selects too.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/series.hpp>

namespace pfaff {

/// A change of sign: two times after the point of expansion, as close as round-off of the step, the first on
/// the side on which the series begins, the second behind the kink.
template <class V>
struct Kink {
  V before, behind;
  std::size_t condition = 0;  // whose sign it is, its slot on the tape
  bool positive = false;      // before
  /// True where another kink is the change of the same condition from the same sign: a motion that has gone
  /// through the other one has not arrived on its far side.
  [[nodiscard]] bool repeats(const std::optional<Kink>& other) const {
    return other && other->condition == condition && other->positive == positive;
  }
};

/// Looks for the kinks of one field.
template <class T>
class Kinks {
  using V = Value<T>;

 public:
  explicit Kinks(const Tape& field) {
    for (const Instruction& i : field.code)
      if (i.operation == Operation::select && i.a >= field.time_begin)
        conditions_.push_back(static_cast<std::size_t>(i.a));
  }
  [[nodiscard]] bool none() const { return conditions_.empty(); }

  /// The first kink up to the time h after the point of expansion. Conditions are looked at in equal parts of
  /// h: two changes of sign within one part are not seen.
  [[nodiscard]] std::optional<Kink<V>> first(const SeriesReplay<T>& series, const V& h) {
    std::optional<Kink<V>> found;
    const V resolution = std::numeric_limits<V>::epsilon() * abs(h);
    V end = h;
    for (const std::size_t slot : conditions_) {
      const bool positive = value(series, slot, V(0)) > V(0);
      const auto changed = [&](const V& s) { return (value(series, slot, s) > V(0)) != positive; };
      V before(0);
      for (int part = 1; part <= parts; ++part) {
        V behind = part == parts ? end : end * V(part) / V(parts);
        if (!changed(behind)) {
          before = behind;
          continue;
        }
        while (abs(behind - before) > resolution) {
          const V middle = before + (behind - before) / V(2);
          if (middle == before || middle == behind) break;  // no number lies between them
          (changed(middle) ? behind : before) = middle;
        }
        if (!found || abs(behind) < abs(found->behind)) {
          found = Kink<V>{before, behind, slot, positive};
        }
        end = behind;
        break;
      }
    }
    return found;
  }

  /// The time s about which a kink lies as a number of T: its derivatives are those of the time at which the
  /// condition is zero.
  [[nodiscard]] T time(const SeriesReplay<T>& series, const Kink<V>& kink, const V& s) const {
    if constexpr (std::is_same_v<T, V>) {
      return s;
    } else {
      T sum(0), slope(0);
      for (std::size_t l = series.levels(); l-- > 0;) {
        slope = slope * T(s) + sum;
        sum = sum * T(s) + series.coefficient(kink.condition, l);
      }
      const V rate = value_of(slope);
      return rate == V(0) ? T(s) : T(s) - (sum - T(value_of(sum))) / T(rate);
    }
  }

 private:
  static constexpr int parts = 16;

  static V value(const SeriesReplay<T>& series, std::size_t slot, const V& s) {
    V sum(0);
    for (std::size_t l = series.levels(); l-- > 0;) sum = sum * s + value_of(series.coefficient(slot, l));
    return sum;
  }
  std::vector<std::size_t> conditions_;  // slots
};

}  // namespace pfaff
