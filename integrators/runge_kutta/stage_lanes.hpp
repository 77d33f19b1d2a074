// Stages side by side: what holds several stages of a component of a collocation step, and the sum over all
// of them. That sum is formed in one order whatever the lanes and the registers behind them: blocks of lanes
// one after the other, then the lanes by halves.
#pragma once

#include <cstddef>

#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/solve/sum_of_two.hpp>

namespace pfaff::detail {

/// What holds several stages of a component where there are `Stages` of them, and how many it holds.
template <class T, int Stages>
struct StageLanes {
  using type = T;
  static constexpr std::size_t width = 1;
  static T get(const T& lanes, std::size_t /*lane*/) { return lanes; }
  static void set(T& lanes, std::size_t /*lane*/, const T& x) { lanes = x; }
};
// One pack for up to eight stages, where the compiler knows their number.
template <int Stages>
struct StageLanes<double, Stages> {
  static constexpr std::size_t width = Stages > 4 && Stages <= 8 ? 8 : 4;
  using type = Pack<static_cast<int>(width)>;
  static double get(const type& lanes, std::size_t lane) { return lanes[lane]; }
  static void set(type& lanes, std::size_t lane, double x) { lanes.set(lane, x); }
};

/// sum + lost = the sum over all lanes of `sums` + `rest`, where `lost` is what additions rounded off.
template <class T>
void add_lanes(const T& sums, const T& rest, T& sum, T& lost) {
  sum = sums;
  lost = rest;
}
template <int W>
void add_lanes(const Pack<W>& sums, const Pack<W>& rest, double& sum, double& lost) {
  if constexpr (W == 1) {
    sum = sums[0];
    lost = rest[0];
  } else {
    Pack<W / 2> half, error;
    two_sum(sums.lower(), sums.upper(), half, error);
    add_lanes(half, error + (rest.lower() + rest.upper()), sum, lost);
  }
}

}  // namespace pfaff::detail
