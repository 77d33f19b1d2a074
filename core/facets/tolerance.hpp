// What a method that chooses its steps may err by in a step, and the scales of the coordinates it refers to.
//
// The error allowed in coordinate i is e s_i + a_i, with the relative tolerance e, an absolute one a_i, which
// is zero where none is given, and the scale of the coordinate
//
//   s_i = max(|z_i|, h |f_i|)     over the motion so far, f being the field and h the step,
//
// so that a coordinate that passes through zero or dies away is judged by what it was, and one that begins at
// zero by what a step adds to it. Only where that is zero does the coordinate have the scale of its group,
// that of the positions or of the momenta; what is below the square of round-off beside the group counts as
// zero, or the first traces of a wave that comes through a lattice would have to be right to all digits. No
// number enters that is not the motion's own: the steps are the same in all units, and to the last bit where
// units differ by powers of two.
//
// A method may be told to forget the motion so far: the scale is then max(|z_i|, |z'_i|), of the ends of the
// step alone, and an error that was small beside a past size may be large beside what is left of it.
//
// A motion that starts at rest in zero has no scale, and an absolute tolerance must say what counts there.
// What the rounding of the state makes of the field, h n_i, is allowed as well, since no step is better: a
// coordinate whose rate is a difference of large numbers could otherwise hold up the motion for ever.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

/// The error that a step may make: in coordinate i, `relative` times the scale of the coordinate and
/// absolute[i] besides. `absolute` is empty, or has one number >= 0 for each coordinate, in its unit. With
/// `forgets` the scales are those of the step alone.
template <class T>
struct Tolerance {
  // Not explicit: a number is a relative tolerance.
  // NOLINTNEXTLINE(google-explicit-constructor)
  Tolerance(T relative_one, std::span<const T> absolute_ones = {}, bool forgets_motion = false)
      : relative(std::move(relative_one)), absolute(absolute_ones), forgets(forgets_motion) {}
  T relative;
  std::span<const T> absolute;
  bool forgets;
};

/// So many steps rejected one after the other may be the fault of rounding errors: see find_noise().
inline constexpr int rejections_in_doubt = 3;

/// The scales of the coordinates of problem P along one motion. A method that chooses its steps has one in
/// its Work, asks it whether a step is good enough, and lets it remember each step that is.
template <class P>
class CoordinateScales {
 public:
  using T = Scalar<P>;
  explicit CoordinateScales(const P& p)
      : past_(p.make_state()),
        own_(p.make_state()),
        scale_(p.make_state()),
        noise_(p.make_state()),
        positions_(positions_of(p)) {}

  /// Finds the scales for a step of length h from z, where the field is `rate`. A group that is zero by all
  /// that has the scale that it has at the `end` of the step, where that is given. InputError for a start at
  /// rest in zero without an absolute tolerance.
  void find(const Tolerance<T>& tolerance, std::span<const T> z, std::span<const T> rate, const T& h,
            std::span<const T> end = {}) {
    const T step = abs(h);
    forgets_ = tolerance.forgets;
    bool known = size() == 0;
    for (std::size_t i = 0; i < size(); ++i) {
      own_[i] = tolerance.forgets ? std::max(T(abs(z[i])), end.empty() ? T(0) : T(abs(end[i])))
                                  : std::max({past_[i], T(abs(z[i])), T(step * abs(rate[i]))});
      known = known || own_[i] > T(0) || abs(rate[i]) > T(0) || amount(tolerance, i) > T(0);
    }
    if (!known)
      throw InputError(
          "--tolerance is relative to the scales of the coordinates, and a start at rest in zero has none; "
          "expected --absolute beside it: an error to allow in every coordinate, or one for each");
    constexpr T unit = std::numeric_limits<T>::epsilon();
    for (const auto& [from, to] : groups()) {
      T group = largest(own_, from, to);
      if (group == T(0) && !end.empty()) group = largest(end, from, to);
      const T zero = unit * unit * group;  // what no rounding error of the others could be told from
      for (std::size_t i = from; i < to; ++i)
        scale_[i] = (own_[i] > zero || (tolerance.forgets && amount(tolerance, i) > T(0)) ? own_[i] : group) +
                    (amount(tolerance, i) + step * noise_[i]) / tolerance.relative;
    }
  }
  /// Finds what the rounding of the state z at t makes of the field, which is `rate` there: to be asked where
  /// steps are rejected again and again.
  void find_noise(const P& p, const T& t, std::span<const T> z, std::span<const T> rate) {
    State<P>&point = own_, &slope = scale_;  // which the next find() fills anew
    const T rounding = T(8) * std::numeric_limits<T>::epsilon();
    for (std::size_t i = 0; i < size(); ++i) point[i] = z[i] + (i % 2 == 0 ? rounding : T(-rounding)) * z[i];
    p.field(t, point, slope);
    for (std::size_t i = 0; i < size(); ++i)
      if (const T noise = T(8) * abs(slope[i] - rate[i]); isfinite(noise))
        noise_[i] = std::max(noise_[i], noise);
  }
  /// The scales found last, absolute tolerances included: the error allowed is the relative tolerance times
  /// them. Zero where nothing moves in the group of a coordinate.
  [[nodiscard]] std::span<const T> get() const { return {scale_.data(), size()}; }
  /// The largest error relative to what is allowed with the scales found last: a step is good enough up to
  /// one. Infinite where an error is not finite.
  [[nodiscard]] double judge(const Tolerance<T>& tolerance, std::span<const T> errors) const {
    T largest_ratio(0);
    for (std::size_t i = 0; i < size(); ++i) {
      if (errors[i] == T(0)) continue;
      const T ratio = abs(errors[i]) / scale_[i] / tolerance.relative;
      if (!isfinite(ratio)) return std::numeric_limits<double>::infinity();
      largest_ratio = std::max(largest_ratio, ratio);
    }
    return static_cast<double>(largest_ratio);
  }
  /// Remembers the step that was looked at last as one of the motion.
  void keep() {
    past_ = own_;
    if (forgets_) std::fill(noise_.begin(), noise_.end(), T(0));
  }

  /// A step to begin with from z at t, where the field is `rate`, at most to `end`: one in which no
  /// coordinate bends by more than a few hundredths of its scale. The bending f' = X_t + X_z f follows from a
  /// very short step of Euler's, and then each coordinate gives a time, sqrt(s_i/|f'_i|) or, where that is
  /// longer, |f_i/f'_i|. hairer-norsett-wanner1993, II.4, have such a step that depends on the unit of time.
  /// No group is to change by more than its size, and a coordinate near zero is not to hold up the others.
  [[nodiscard]] T first_step(const P& p, const Tolerance<T>& tolerance, const T& t, const T& end,
                             std::span<const T> z, std::span<const T> rate) {
    find(tolerance, z, rate, T(0));
    const T distance = abs(end - t);
    T shortest = distance, longest(0);  // of the times in which groups change by their sizes
    for (const auto& [from, to] : groups()) {
      const T size_of_group = largest(scale_, from, to), speed = largest(rate, from, to);
      if (!(size_of_group > T(0) && speed > T(0))) continue;
      shortest = std::min(shortest, T(size_of_group / speed));
      longest = std::max(longest, T(size_of_group / speed));
    }
    const T probe = (end < t ? T(-shortest) : shortest) / T(1 << 20);
    State<P>&point = own_, &slope = scale_;  // which the next find() fills anew
    const State<P> scale = scale_;
    for (std::size_t i = 0; i < size(); ++i) point[i] = z[i] + probe * rate[i];
    p.field(t + probe, point, slope);
    T step = longest > T(0) ? std::min(longest, distance) : distance;
    for (std::size_t i = 0; i < size(); ++i) {
      const T bend = abs((slope[i] - rate[i]) / probe);
      const T within = std::max(T(sqrt(scale[i] / bend) / T(8)), T(abs(rate[i]) / bend / T(64)));
      if (isfinite(within) && within > T(0)) step = std::min(step, within);
    }
    return std::max(step, T(distance / T(1 << 30)));
  }

 private:
  using Groups = std::array<std::pair<std::size_t, std::size_t>, 2>;
  // Half of the coordinates where they are positions and momenta: with the canonical bracket, or with
  // friction beside it.
  static std::size_t positions_of(const P& p) {
    if constexpr (requires { p.model()->canonical(); })
      if (p.model()->canonical() || p.model()->content().has(Facet::conformal)) return p.size() / 2;
    return p.size();
  }
  [[nodiscard]] std::size_t size() const { return past_.size(); }
  [[nodiscard]] Groups groups() const { return {{{0, positions_}, {positions_, size()}}}; }
  static T amount(const Tolerance<T>& tolerance, std::size_t i) {
    return tolerance.absolute.empty() ? T(0) : tolerance.absolute[i];
  }
  template <class Numbers>
  static T largest(const Numbers& numbers, std::size_t from, std::size_t to) {
    T most(0);
    for (std::size_t i = from; i < to; ++i) most = std::max(most, T(abs(numbers[i])));
    return most;
  }

  State<P> past_, own_, scale_;  // over the steps kept; the same with the step looked at; what judges it
  State<P> noise_;               // of the rates
  bool forgets_ = false;         // the motion behind the step that is looked at
  std::size_t positions_;        // the coordinates before the momenta, or all of them
};

}  // namespace pfaff
