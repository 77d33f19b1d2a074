// The gradient of a truncated generating function from a compiled field, W nodes in the lanes of a vector
// register.
//
// It forms the same sums as GeneratingGradient, for doubles, for fields whose author compiled them
// (core/facets/compiled_series.hpp), for at most four nodes and series_capacity degrees, and for a share P
// (generating_share.hpp) that is diagonal. The step is multiplied into the coefficients once; lanes beyond
// the nodes repeat the last one with weight zero.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/integrators/generating/generating_nodes.hpp>
#include <pfaff/integrators/generating/generating_share.hpp>

namespace pfaff {

template <int W>
class CompiledGradient {
 public:
  static constexpr bool fits(const GeneratingNodes& nodes) {
    return nodes.lanes <= W && nodes.levels <= static_cast<std::size_t>(series_capacity);
  }

  CompiledGradient(const BoundSeries& field, const GeneratingNodes& nodes, const GeneratingShare& share)
      : system_(field.system),
        width_(field.series->width<W>()),
        n_(static_cast<std::size_t>(field.series->inputs)),
        evaluations_(nodes.evaluations()) {
    const auto number = [](const Quad& x) { return static_cast<double>(x); };
    const CompiledSeries::Layout layout = field.series->layout(system_);
    slots_.resize(static_cast<std::size_t>(layout.slots) * series_capacity);
    timed_ = layout.timed;
    unit_.levels = nodes.levels;
    unit_.symmetric = nodes.symmetric;
    for (std::size_t i = 0; i < W; ++i) {
      const std::size_t from = std::min(i, nodes.lanes - 1);
      node_.set(i, number(nodes.node[from]));
      unit_.weight.set(i, i == from ? number(nodes.weight[i]) : 0);
    }
    // What lane j adds to the next level of every lane, for each component. In variant P stages are measured
    // from w, which moves by P psi, so that P times the weights is subtracted. Components with the same entry
    // of P share one matrix and are of one kind.
    std::vector<Quad> shares;
    for (std::size_t k = 0; k < n_; ++k) {
      const Quad moving = nodes.symmetric ? Quad(0) : (Quad(1) + share.normal(k, k, n_)) / Quad(2);
      std::size_t same = 0;
      while (same < shares.size() && !(shares[same] == moving)) ++same;
      unit_.kind.push_back(same);
      if (same < shares.size()) continue;
      shares.push_back(moving);
      for (std::size_t level = 0; level < nodes.levels; ++level) {
        const std::vector<Quad>& matrix = level % 2 == 0 ? nodes.even : nodes.odd;
        std::array<Pack<W>, W> columns{};
        for (std::size_t j = 0; j < nodes.lanes; ++j)
          for (std::size_t i = 0; i < W; ++i)
            columns[j].set(
                i, number(matrix[std::min(i, nodes.lanes - 1) * nodes.lanes + j] - moving * nodes.weight[j]));
        unit_.columns.push_back(columns);
      }
    }
    unit_.one_kind = shares.size() == 1;
    scaled_ = unit_;
  }

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

  void set_step(double t, double tau) {
    if (tau != tau_) {
      tau_ = tau;
      for (std::size_t k = 0; k < unit_.columns.size(); ++k)
        for (std::size_t j = 0; j < W; ++j) scaled_.columns[k][j] = Pack<W>(tau) * unit_.columns[k][j];
      scaled_.weight = Pack<W>(tau) * unit_.weight;
    }
    Pack<W>* time = slots_.data() + n_ * series_capacity;
    time[0] = Pack<W>(unit_.symmetric ? t + tau / 2 : t);
    time[1] = Pack<W>(tau) * node_;
    if (timed_) width_.time(system_, slots_.data(), static_cast<int>(unit_.levels));
  }

  void operator()(const double* w, double* psi) {
    width_.best(scaled_)(system_, slots_.data(), scaled_, w, psi);
  }

 private:
  const void* system_;
  const SeriesWidth<W>& width_;
  std::size_t n_, evaluations_;
  bool timed_ = false;
  SeriesCombination<W> unit_, scaled_;  // for a step of 1, and multiplied by the step
  Pack<W> node_;
  double tau_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<Pack<W>> slots_;
};

}  // namespace pfaff
