// SlopePrediction: whether the slope at an end of an extrapolated step is the one to which its rows lead.
//
// Of the slopes at the substeps of row j the midpoint rule adds up those at odd numbers: the first of them is
// taken s_j = h/(2 j) behind the start, the last one s_j before the end. No row looks nearer to the ends than
// the last one. A jump of the field there, or a pole, changes nothing in the rows, which then agree on a
// wrong step. The slopes f at both ends are known: one has begun the step, with the other the next one
// begins. The slopes f_j that the rows take nearest to an end have an expansion in s_j, so that polynomials
// in s through those of the rows 1, ..., i lead to predictions of f,
//     P_i = sum_j w_ij f_j,    w_ij = product over m != j, m <= i, of j/(j - m).
// Where the field is smooth their errors fall with i, the faster the more rows there are, and the distance
// from P_i to P_{i-1} tells how far f may be from P_i. Where the field jumps the predictions come together,
// and f stays away.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// The slopes that the rows of a step of problem P take nearest to one of its ends; so many rows at most.
template <class P, std::size_t Most>
class SlopePrediction {
 public:
  using T = Scalar<P>;
  explicit SlopePrediction(const P& p) {
    for (State<P>& slope : nearest_) slope = p.make_state();
  }

  /// Takes the slope of row j = 1, 2, ....
  void take(int j, const State<P>& slope) { nearest_[static_cast<std::size_t>(j - 1)] = slope; }

  /// Whether `slope`, at the end in question of a step of length h with two rows or more, is the one to which
  /// these lead, or what it differs by changes no coordinate, over the time between that end and the last
  /// row, by more than is allowed: the relative tolerance times `scales`. False where it is not finite.
  [[nodiscard]] bool leads_to(const State<P>& slope, int rows, const T& h, const T& tolerance,
                              std::span<const T> scales) const {
    const T unseen = abs(h) / T(2 * rows);
    T away(0), last(0), rounded(0);  // the largest of all coordinates, in their scales
    for (std::size_t k = 0; k < slope.size(); ++k) {
      const auto note = [&](T& largest, const T& x) {
        if (x == T(0)) return;
        if (const T part = abs(x) / scales[k]; !(part <= largest)) largest = part;
      };
      const T newest = prediction(rows, k), older = prediction(rows - 1, k);
      note(away, slope[k] - newest);
      note(last, newest - older);
      note(rounded, rounding(rows, k));
    }
    if (unseen * away <= tolerance) return true;
    return away <= T(most_times) * last + rounded;
  }

 private:
  using Weights = std::array<T, Most>;
  // Where the field is smooth f is nearer to P_i than P_{i-1} is, but for two predictions that agree by
  // chance.
  static constexpr int most_times = 4;

  static Weights weights_of(int rows) {
    Weights w{};
    for (int j = 1; j <= rows; ++j) {
      T product(1);
      for (int m = 1; m <= rows; ++m)
        if (m != j) product = product * T(j) / T(j - m);
      w[static_cast<std::size_t>(j - 1)] = product;
    }
    return w;
  }
  // Of each number of rows. They are found once: in quad that takes longer than a step.
  static const std::array<Weights, Most>& all_weights() {
    static const std::array<Weights, Most> all = [] {
      std::array<Weights, Most> made;
      for (int rows = 1; rows <= static_cast<int>(Most); ++rows)
        made[static_cast<std::size_t>(rows - 1)] = weights_of(rows);
      return made;
    }();
    return all;
  }
  // P_i of coordinate k, for i rows.
  [[nodiscard]] T prediction(int rows, std::size_t k) const {
    const auto count = static_cast<std::size_t>(rows);
    T sum(0);
    for (std::size_t j = 0; j < count; ++j) sum += weights_[count - 1][j] * nearest_[j][k];
    return sum;
  }
  // What rounding of the slopes makes of it, with some to spare for slopes that are rounded more than once.
  [[nodiscard]] T rounding(int rows, std::size_t k) const {
    const auto count = static_cast<std::size_t>(rows);
    T sum(0);
    for (std::size_t j = 0; j < count; ++j) sum += abs(weights_[count - 1][j] * nearest_[j][k]);
    return T(8) * std::numeric_limits<Value<T>>::epsilon() * sum;
  }

  std::array<State<P>, Most> nearest_;
  const std::array<Weights, Most>& weights_ = all_weights();
};

}  // namespace pfaff
