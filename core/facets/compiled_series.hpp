// A system's field in the Darboux chart, compiled for truncated series in 1, 2 and 4 lanes of doubles.
//
// What SeriesReplay does by interpreting the tape, this does by running the author's formula itself with the
// scalar OnlineSeries: 2-6 times faster, and several nodes in the lanes of one vector register. Low levels,
// which every order needs, are compiled with the level known, so that no loop is left of the recurrences; the
// others share one copy.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/online_series.hpp>

namespace pfaff {

/// A formula ready to extend series of its inputs and of time. Slots are Pack<W>[slot][series_capacity]: the
/// n inputs first, then time, then the formula's own.
struct CompiledSeries {
  /// Extends every slot of one kind by one level.
  using Extend = void (*)(const void* system, void* slots, int level);
  struct Width {
    Extend time;                                  // slots that depend on time alone
    std::array<Extend, series_capacity> state{};  // by level
  };

  int inputs = 0;
  struct Layout {
    int slots = 0;
    bool timed = false;  // whether any slot depends on time alone, besides the time itself
  };
  /// Writes where output k is found, for k = 0 .. inputs-1.
  Layout (*layout)(const void* system, int* outputs) = nullptr;
  std::array<Width, 3> widths{};  // 1, 2 and 4 lanes
};

/// Compiled series and the object to call them with; `series` is null where there are none.
struct BoundSeries {
  const CompiledSeries* series = nullptr;
  const void* system = nullptr;
};

namespace detail {

template <class S>
concept FixedSize = requires {
  typename std::integral_constant<int, S::dimension>;
};

// Whether the author of S writes the chart's field, or the force and velocity that are one.
template <class S, class T>
concept WritesChartField = requires(const S& s, const T& t, In<T> y, Out<T> rate) {
  s.chart_field(t, y, rate);
};
template <class S, class T>
concept WritesForceAndVelocity = requires(const S& s, const T& t, In<T> x, Out<T> o) {
  s.kinetic(t, x);
  s.potential(t, x);
  s.force(t, x, o);
  s.velocity(t, x, o);
};
template <class S>
concept CompilesChartField = FixedSize<S> &&
    (WritesChartField<S, double> || WritesForceAndVelocity<S, double>);

template <CompilesChartField S, class T>
[[gnu::always_inline]] inline void chart_field_of(const S& s, const T& t, In<T> y, Out<T> rate) {
  if constexpr (WritesChartField<S, double>) {
    s.chart_field(t, y, rate);
  } else {
    constexpr std::size_t half = S::dimension / 2;
    s.velocity(t, y.subspan(half), rate.first(half));
    s.force(t, y.first(half), rate.subspan(half));
  }
}

// One run of the formula.
template <class S, int W>
[[gnu::always_inline]] inline void run_series(const S& s, SeriesRun<W>& run, int* outputs) {
  constexpr auto n = static_cast<std::size_t>(S::dimension);
  using T = OnlineSeries<W>;
  std::array<T, n> y, rate;
  for (std::size_t k = 0; k < n; ++k) y[k] = T(run, static_cast<int>(k), false);
  const T t(run, S::dimension, true);
  run.next = S::dimension + 1;
  chart_field_of<S, T>(s, t, std::span<const T>(y), std::span<T>(rate));
  for (std::size_t k = 0; k < n; ++k) {
    const int slot = rate[k].placed(run);
    if (outputs != nullptr) outputs[k] = slot;
  }
}
template <class S, int W, SeriesPass Pass>
[[gnu::flatten]] void extend_series(const void* system, void* slots, int level) {
  SeriesRun<W> run{static_cast<Pack<W>*>(slots), level, Pass};
  run_series(*static_cast<const S*>(system), run, nullptr);
}
template <class S, int W, int Level>
[[gnu::flatten]] void extend_series_at(const void* system, void* slots, int /*level*/) {
  SeriesRun<W> run{static_cast<Pack<W>*>(slots), Level, SeriesPass::state};
  run_series(*static_cast<const S*>(system), run, nullptr);
}
template <class S>
CompiledSeries::Layout series_layout(const void* system, int* outputs) {
  SeriesRun<1> run{nullptr, 0, SeriesPass::none};
  run_series(*static_cast<const S*>(system), run, outputs);
  return {run.next, run.timed > 0};
}
// `Known` levels compiled one by one, the others together.
template <class S, int W, int... Known>
CompiledSeries::Width series_width(std::integer_sequence<int, Known...> /*levels*/) {
  CompiledSeries::Width width{&extend_series<S, W, SeriesPass::time>, {}};
  width.state.fill(&extend_series<S, W, SeriesPass::state>);
  ((width.state[Known] = &extend_series_at<S, W, Known>), ...);
  return width;
}

}  // namespace detail

/// The chart's field of S. Orders to 4 (one lane) and to 8 (two lanes) of the symmetric schemes know their
/// levels.
template <detail::CompilesChartField S>
const CompiledSeries& compiled_series() {
  static const CompiledSeries series{S::dimension,
                                     &detail::series_layout<S>,
                                     {detail::series_width<S, 1>(std::make_integer_sequence<int, 3>()),
                                      detail::series_width<S, 2>(std::make_integer_sequence<int, 7>()),
                                      detail::series_width<S, 4>(std::make_integer_sequence<int, 0>())}};
  return series;
}

}  // namespace pfaff
