// A system's field in the Darboux chart, compiled for truncated series in 1, 2 and 4 lanes of doubles.
//
// What SeriesReplay does by interpreting the tape, this does by running the author's formula itself with the
// scalar OnlineSeries. It is 3-10 times faster, and takes several nodes at once in the lanes of one vector
// register. Level l is the l-th coefficient of a series. A collocation computes level l of the field,
// combines it over the lanes and feeds it back as level l + 1 of the inputs; one call runs through all
// levels. For the numbers of levels that low orders have, the recurrences are compiled without loops; all
// other numbers share one copy with loops.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/facets/written_formulas.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/online_series.hpp>

// Marks functions into which all their calls are inlined, so that the compiler knows every slot where it is
// used, which takes it seconds for each system. Code that is compiled to be soon there does without
// (PFAFF_COLD, cmake/PfaffTargets.cmake), and so does the address sanitizer, which adds code to every access
// of memory and with this would take minutes.
#if defined(PFAFF_COLD) || defined(__SANITIZE_ADDRESS__)
#define PFAFF_FLATTEN
#else
#define PFAFF_FLATTEN [[gnu::flatten]]
#endif

namespace pfaff {

/// How a collocation, or the Taylor series of a solution, goes on from X_l, level l of the field at its
/// nodes: the matrix `columns` of this level times X_l is level l + 1 of the inputs, and `weight` times X_l
/// is added to the sums.
template <int W>
struct SeriesCombination {
  std::size_t levels = 0;
  bool symmetric = false;  // only even levels reach the sums
  Pack<W> weight;
  std::vector<std::array<Pack<W>, W>> columns;  // [kind * levels + level][lane of X]
  std::vector<std::size_t> kind;                // of each component: which of the columns it takes
  bool one_kind = true;                         // all components take the same
};

/// The formula in W lanes. Slots are [slot][series_capacity]: the n inputs first, then time, then the
/// formula's own.
template <int W>
struct SeriesWidth {
  /// Levels 0 .. levels-1 of the slots that depend on time alone.
  void (*time)(const void* system, Pack<W>* slots, int levels) = nullptr;
  /// Computes all levels from the inputs w, the same in every lane; result = the sums over levels and lanes.
  using Collocate = void (*)(const void* system, Pack<W>* slots, const SeriesCombination<W>& combination,
                             const double* w, double* result);
  Collocate collocate = nullptr;
  Collocate collocate_known = nullptr;  // the same without loops, for up to `known` levels and one kind
  std::size_t known = 0;

  /// The faster of the two that can be called.
  [[nodiscard]] Collocate best(const SeriesCombination<W>& combination) const {
    return combination.levels <= known && combination.one_kind ? collocate_known : collocate;
  }
};

/// A formula ready for series.
struct CompiledSeries {
  struct Layout {
    int slots = 0;
    bool timed = false;        // whether any slot depends on time alone, besides the time itself
    std::vector<int> outputs;  // the slots of the results
  };
  int inputs = 0;
  Layout (*layout)(const void* system) = nullptr;
  SeriesWidth<1> one;
  SeriesWidth<2> two;
  SeriesWidth<4> four;

  template <int W>
  [[nodiscard]] const SeriesWidth<W>& width() const {
    if constexpr (W == 1)
      return one;
    else if constexpr (W == 2)
      return two;
    else
      return four;
  }
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

// True where the author of S writes the chart's field, or the velocity and force that together are this
// field.
template <class S>
concept CompilesChartField = FixedSize<S> &&
    (writes<S, Formula::chart_field, double> ||
     (writes<S, Formula::kinetic, double> && writes<S, Formula::potential, double> &&
      writes<S, Formula::force, double> && writes<S, Formula::velocity, double> && !WritesDamping<S>));

template <CompilesChartField S, class T>
void chart_field_of(const S& s, const T& t, In<T> y, Out<T> rate) {
  if constexpr (writes<S, Formula::chart_field, double>) {
    s.chart_field(t, y, rate);
  } else {
    constexpr std::size_t half = S::dimension / 2;
    s.velocity(t, y.subspan(half), rate.first(half));
    s.force(t, y.first(half), rate.subspan(half));
  }
}

// Runs the formula once and returns in `outputs` the slots of its results.
template <class S, int W>
void run_series(const S& s, SeriesRun<W>& run,
                std::array<int, static_cast<std::size_t>(S::dimension)>& outputs) {
  constexpr auto n = static_cast<std::size_t>(S::dimension);
  using T = OnlineSeries<W>;
  std::array<T, n> y, rate;
  for (std::size_t k = 0; k < n; ++k) y[k] = T(run, static_cast<int>(k), false);
  const T t(run, S::dimension, true, 1);
  run.next = S::dimension + 1;
  chart_field_of<S, T>(s, t, std::span<const T>(y), std::span<T>(rate));
  for (std::size_t k = 0; k < n; ++k) outputs[k] = rate[k].placed(run);
}
template <class S>
CompiledSeries::Layout series_layout(const void* system) {
  SeriesRun<1> run{nullptr, 0, SeriesPass::none};
  std::array<int, static_cast<std::size_t>(S::dimension)> outputs;
  run_series(*static_cast<const S*>(system), run, outputs);
  return {run.next, run.timed > 0, {outputs.begin(), outputs.end()}};
}
template <class S, int W>
PFAFF_FLATTEN void expand_time(const void* system, Pack<W>* slots, int levels) {
  std::array<int, static_cast<std::size_t>(S::dimension)> outputs;
  for (int level = 0; level < levels; ++level) {
    SeriesRun<W> run{slots, level, SeriesPass::time};
    run_series(*static_cast<const S*>(system), run, outputs);
  }
}

// Computes one level of the field, adds it to the sums and, unless it is the last, forms the inputs' next
// one.
template <class S, int W, bool OneKind>
void collocate_level(const S& s, Pack<W>* slots, const SeriesCombination<W>& c, std::size_t level, bool last,
                     std::array<Pack<W>, static_cast<std::size_t>(S::dimension)>& sum) {
  SeriesRun<W> run{slots, static_cast<int>(level), SeriesPass::state};
  std::array<int, static_cast<std::size_t>(S::dimension)> outputs;
  run_series(s, run, outputs);
  const bool counts = !c.symmetric || level % 2 == 0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    const Pack<W> x = slots[static_cast<std::size_t>(outputs[k]) * series_capacity + level];
    if (counts) sum[k] = sum[k] + c.weight * x;
    if (last) continue;
    const auto& columns = c.columns[(OneKind ? 0 : c.kind[k] * c.levels) + level];
    Pack<W> next = columns[0] * Pack<W>(x[0]);
    for (std::size_t j = 1; j < W; ++j) next = next + columns[j] * Pack<W>(x[j]);
    slots[k * series_capacity + level + 1] = next;
  }
}
template <class S, int W>
void begin_collocation(Pack<W>* slots, const double* w,
                       std::array<Pack<W>, static_cast<std::size_t>(S::dimension)>& sum) {
  for (std::size_t k = 0; k < sum.size(); ++k) {
    slots[k * series_capacity] = Pack<W>(w[k]);
    sum[k] = Pack<W>(0);
  }
}
template <class S, int W>
PFAFF_FLATTEN void collocate(const void* system, Pack<W>* slots, const SeriesCombination<W>& c,
                             const double* w, double* result) {
  std::array<Pack<W>, static_cast<std::size_t>(S::dimension)> sum;
  begin_collocation<S, W>(slots, w, sum);
  for (std::size_t level = 0; level < c.levels; ++level)
    collocate_level<S, W, false>(*static_cast<const S*>(system), slots, c, level, level + 1 == c.levels, sum);
  for (std::size_t k = 0; k < sum.size(); ++k) result[k] = sum[k].sum();
}
template <class S, int W, std::size_t... Levels>
PFAFF_FLATTEN void collocate_known(const void* system, Pack<W>* slots, const SeriesCombination<W>& c,
                                   const double* w, double* result) {
  std::array<Pack<W>, static_cast<std::size_t>(S::dimension)> sum;
  begin_collocation<S, W>(slots, w, sum);
  // One level after the other, until && finds the last one.
  static_cast<void>(((collocate_level<S, W, true>(*static_cast<const S*>(system), slots, c, Levels,
                                                  Levels + 1 == c.levels, sum),
                      Levels + 1 < c.levels) &&
                     ...));
  for (std::size_t k = 0; k < sum.size(); ++k) result[k] = sum[k].sum();
}
template <class S, int W, std::size_t... Levels>
SeriesWidth<W> series_width(std::index_sequence<Levels...> /*known*/) {
  SeriesWidth<W> width{&expand_time<S, W>, &collocate<S, W>, nullptr, sizeof...(Levels)};
  if constexpr (sizeof...(Levels) > 0) width.collocate_known = &collocate_known<S, W, Levels...>;
  return width;
}

}  // namespace detail

/// The chart's field of S, ready for series. The levels that are compiled without loops are those of the
/// symmetric schemes up to order 12 (one lane and 3 levels up to order 4, then two lanes up to order 8 and
/// four up to 12), and of order 8 with four more degrees. Fields in more than twelve coordinates are compiled
/// with loops only: for the six bodies of outer-solar-system code without loops is 200 kilobytes long, which
/// is more than caches of instructions hold.
template <detail::CompilesChartField S>
const CompiledSeries& compiled_series() {
  constexpr bool small = S::dimension <= 12;
  static const CompiledSeries series{
      S::dimension, &detail::series_layout<S>,
      detail::series_width<S, 1>(std::make_index_sequence < small ? 3 : 0 > ()),
      detail::series_width<S, 2>(std::make_index_sequence < small ? 11 : 0 > ()),
      detail::series_width<S, 4>(std::make_index_sequence < small ? 11 : 0 > ())};
  return series;
}

}  // namespace pfaff

#undef PFAFF_FLATTEN
