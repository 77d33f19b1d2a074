// Series of a field that was compiled from its tape, in the form in which methods take those of authors
// (core/facets/compiled_series.hpp).
#pragma once

#include <memory>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/native/compiler.hpp>
#include <pfaff/core/native/series_text.hpp>

namespace pfaff::native {

/// The functions of one width.
template <int W>
struct SeriesFunctions {
  void (*level)(Pack<W>* slots, int level) = nullptr;
  void (*time)(Pack<W>* slots, int levels) = nullptr;
  void (*collocate)(Pack<W>* slots, const Pack<W>* columns, const Pack<W>* weight, bool symmetric, int levels,
                    const double* w, double* result) = nullptr;
};

/// What compiled series are called with as their system.
class NativeSeries {
 public:
  /// The functions of `library`, which was made of `text`.
  NativeSeries(std::shared_ptr<const Library> library, const SeriesText& text);
  [[nodiscard]] const CompiledSeries& series() const { return series_; }

  template <int W>
  [[nodiscard]] const SeriesFunctions<W>& functions() const {
    if constexpr (W == 1)
      return one_;
    else if constexpr (W == 2)
      return two_;
    else
      return four_;
  }
  [[nodiscard]] const CompiledSeries::Layout& layout() const { return layout_; }

 private:
  std::shared_ptr<const Library> library_;
  SeriesFunctions<1> one_;
  SeriesFunctions<2> two_;
  SeriesFunctions<4> four_;
  CompiledSeries::Layout layout_;
  CompiledSeries series_;
};

}  // namespace pfaff::native
