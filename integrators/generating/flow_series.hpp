// The Taylor series of the flow in a Darboux chart over one step, from a compiled field where its author
// compiled it, else from the tape.
//
// Code without loops, several times as fast as loops, is compiled for more levels in two lanes than in one
// (core/facets/compiled_series.hpp). The series is therefore taken in two lanes where that is faster; both
// compute the same.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

namespace pfaff {

/// The series from a compiled field, by a collocation in which each lane is a node of its own: level l of the
/// field is followed by level l + 1 of the solution, h / (l + 1) times as large.
template <int W>
class CompiledFlowSeries {
 public:
  CompiledFlowSeries(const BoundSeries& field, std::size_t degree)
      : system_(field.system),
        width_(field.series->width<W>()),
        layout_(field.series->layout(system_)),
        n_(static_cast<std::size_t>(field.series->inputs)),
        slots_(static_cast<std::size_t>(layout_.slots) * series_capacity),
        sums_(n_) {
    combination_.levels = degree;
    combination_.symmetric = true;
    combination_.kind.assign(n_, 0);
    combination_.columns.resize(degree);
  }
  [[nodiscard]] std::size_t degree() const { return combination_.levels; }

  void expand(double t, double h, const double* y) {
    if (h != h_) set_step(h);
    Pack<W>* time = slots_.data() + n_ * series_capacity;
    time[0] = Pack<W>(t);
    time[1] = Pack<W>(h);
    if (layout_.timed) width_.time(system_, slots_.data(), static_cast<int>(degree()));
    width_.best(combination_)(system_, slots_.data(), combination_, y, sums_.data());
  }
  [[nodiscard]] double term(std::size_t k, std::size_t degree) const {
    const std::size_t last = this->degree();
    if (degree < last) return slots_[k * series_capacity + degree][0];
    const auto output = static_cast<std::size_t>(layout_.outputs[k]);
    return slots_[output * series_capacity + last - 1][0] * h_ / static_cast<double>(last);
  }

 private:
  void set_step(double h) {
    h_ = h;
    for (std::size_t level = 0; level < degree(); ++level)
      for (std::size_t lane = 0; lane < W; ++lane)
        combination_.columns[level][lane].set(lane, h / static_cast<double>(level + 1));
  }

  const void* system_;
  const SeriesWidth<W>& width_;
  CompiledSeries::Layout layout_;
  std::size_t n_;
  double h_ = 0;
  SeriesCombination<W> combination_;
  std::vector<Pack<W>> slots_;
  std::vector<double> sums_;  // which nobody reads
};

/// The series from the tape, for any scalar.
template <class T>
class TapedFlowSeries {
 public:
  TapedFlowSeries(std::shared_ptr<const Tape> field, std::size_t degree)
      : series_(std::move(field), static_cast<int>(degree)), powers_(degree + 1, T(1)) {}
  [[nodiscard]] std::size_t degree() const { return series_.order(); }

  void expand(const T& t, const T& h, const T* y) {
    series_.expand(t, y);
    for (std::size_t l = 1; l <= degree(); ++l) powers_[l] = powers_[l - 1] * h;
  }
  [[nodiscard]] T term(std::size_t k, std::size_t degree) const {
    return powers_[degree] * series_.coefficients()[degree * series_.size() + k];
  }

 private:
  TaylorExpansion<T> series_;
  std::vector<T> powers_;  // of the step
};

template <class T>
class FlowSeries {
  using Any =
      std::conditional_t<std::is_same_v<T, double>,
                         std::variant<TapedFlowSeries<T>, CompiledFlowSeries<1>, CompiledFlowSeries<2>>,
                         std::variant<TapedFlowSeries<T>>>;

 public:
  template <class P>
  FlowSeries(const P& p, std::size_t degree) : any_(make(p, degree)) {}

  [[nodiscard]] std::size_t degree() const {
    return std::visit([](const auto& series) { return series.degree(); }, any_);
  }
  /// Whether the field is run as its author's code, not from the tape.
  [[nodiscard]] bool is_compiled() const { return any_.index() > 0; }
  /// Expands y(t + h) - y(t) about t, y(t) = y, n numbers.
  void expand(const T& t, const T& h, const T* y) {
    std::visit([&](auto& series) { series.expand(t, h, y); }, any_);
  }
  /// The term of a degree from 1 to degree() in component k, the power of h in it.
  [[nodiscard]] T term(std::size_t k, std::size_t degree) const {
    return std::visit([&](const auto& series) { return series.term(k, degree); }, any_);
  }

 private:
  template <class P>
  static Any make(const P& p, std::size_t degree) {
    if constexpr (std::is_same_v<T, double>) {
      const BoundSeries field = p.chart_field_series();
      if (field.series != nullptr) {
        if (degree <= field.series->two.known) return CompiledFlowSeries<2>(field, degree);
        if (degree < series_capacity) return CompiledFlowSeries<1>(field, degree);
      }
    }
    return TapedFlowSeries<T>(p.chart_field_tape(), degree);
  }

  Any any_;
};

}  // namespace pfaff
