#include <pfaff/core/native/native_series.hpp>

namespace pfaff::native {

namespace {
template <int W>
SeriesFunctions<W> functions_in(const Library& library) {
  const std::string width = std::to_string(W);
  SeriesFunctions<W> f;
  f.level = reinterpret_cast<decltype(f.level)>(library.symbol("pfaff_level_" + width));
  f.time = reinterpret_cast<decltype(f.time)>(library.symbol("pfaff_time_" + width));
  f.collocate = reinterpret_cast<decltype(f.collocate)>(library.symbol("pfaff_collocate_" + width));
  return f;
}

const NativeSeries& of(const void* system) { return *static_cast<const NativeSeries*>(system); }

template <int W>
void time(const void* system, Pack<W>* slots, int levels) {
  of(system).functions<W>().time(slots, levels);
}

// Any number of levels and kinds of columns.
template <int W>
void collocate(const void* system, Pack<W>* slots, const SeriesCombination<W>& c, const double* w,
               double* result) {
  const NativeSeries& native = of(system);
  const std::vector<int>& outputs = native.layout().outputs;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    slots[k * series_capacity] = Pack<W>(w[k]);
    result[k] = 0;
  }
  for (std::size_t level = 0; level < c.levels; ++level) {
    native.functions<W>().level(slots, static_cast<int>(level));
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const Pack<W> x = slots[static_cast<std::size_t>(outputs[k]) * series_capacity + level];
      if (!c.symmetric || level % 2 == 0) result[k] += (c.weight * x).sum();
      if (level + 1 == c.levels) continue;
      const auto& columns = c.columns[c.kind[k] * c.levels + level];
      Pack<W> next = columns[0] * Pack<W>(x[0]);
      for (std::size_t j = 1; j < W; ++j) next = next + columns[j] * Pack<W>(x[j]);
      slots[k * series_capacity + level + 1] = next;
    }
  }
}

template <int W>
void collocate_known(const void* system, Pack<W>* slots, const SeriesCombination<W>& c, const double* w,
                     double* result) {
  of(system).functions<W>().collocate(slots, c.columns.front().data(), &c.weight, c.symmetric,
                                      static_cast<int>(c.levels), w, result);
}

template <int W>
SeriesWidth<W> width(const SeriesFunctions<W>& functions) {
  if (functions.collocate == nullptr) return {&time<W>, &collocate<W>, nullptr, 0};
  return {&time<W>, &collocate<W>, &collocate_known<W>, static_cast<std::size_t>(known_levels(W))};
}
}  // namespace

NativeSeries::NativeSeries(std::shared_ptr<const Library> library, const SeriesText& text)
    : library_(std::move(library)),
      one_(functions_in<1>(*library_)),
      two_(functions_in<2>(*library_)),
      four_(functions_in<4>(*library_)),
      layout_{text.slots, text.timed, text.outputs},
      series_{static_cast<int>(text.outputs.size()), [](const void* system) { return of(system).layout(); },
              width(one_), width(two_), width(four_)} {}

}  // namespace pfaff::native
