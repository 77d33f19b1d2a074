// The gradient of a truncated generating function from a compiled field, W nodes in the lanes of a vector
// register.
//
// The same sums as GeneratingGradient, for doubles, fields whose author compiled them
// (core/facets/compiled_series.hpp), at most four nodes, at most series_capacity degrees, and shares that mix
// no components. The step is multiplied into the coefficients once; lanes beyond the nodes repeat the last
// one with weight zero.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/integrators/generating_nodes.hpp>
#include <pfaff/integrators/generating_share.hpp>

namespace pfaff {

template <int W>
class CompiledGradient {
 public:
  static constexpr bool fits(const GeneratingNodes& nodes) {
    return nodes.lanes <= W && nodes.levels <= static_cast<std::size_t>(series_capacity);
  }

  CompiledGradient(const BoundSeries& field, const GeneratingNodes& nodes, const GeneratingShare& share)
      : series_(*field.series),
        system_(field.system),
        width_(series_.widths[W == 1   ? 0
                              : W == 2 ? 1
                                       : 2]),
        n_(static_cast<std::size_t>(series_.inputs)),
        levels_(nodes.levels),
        evaluations_(nodes.evaluations()),
        symmetric_(nodes.symmetric),
        output_(n_),
        sum_(n_) {
    const auto number = [](const Quad& x) { return static_cast<double>(x); };
    const CompiledSeries::Layout layout = series_.layout(system_, output_.data());
    slots_.resize(static_cast<std::size_t>(layout.slots) * series_capacity);
    timed_ = layout.timed;
    for (std::size_t i = 0; i < W; ++i) {
      const std::size_t from = std::min(i, nodes.lanes - 1);
      node_.set(i, number(nodes.node[from]));
      weight_.set(i, i == from ? number(nodes.weight[i]) : 0);
    }
    // What lane j adds to the next level of every lane, for each component: the share of w that moves with
    // psi is taken off (variant P). Components of equal share have equal matrices.
    for (std::size_t k = 0; k < n_; ++k) {
      const Quad moving = symmetric_ ? Quad(0) : (Quad(1) + share.normal(k, k, n_)) / Quad(2);
      std::size_t same = 0;
      while (same < moving_.size() && !(moving_[same] == moving)) ++same;
      kind_.push_back(same);
      if (same < moving_.size()) continue;
      moving_.push_back(moving);
      for (const std::vector<Quad>* matrix : {&nodes.even, &nodes.odd}) {
        Columns columns{};
        for (std::size_t j = 0; j < nodes.lanes; ++j)
          for (std::size_t i = 0; i < W; ++i)
            columns[j].set(i, number((*matrix)[std::min(i, nodes.lanes - 1) * nodes.lanes + j] -
                                     moving * nodes.weight[j]));
        unit_.push_back(columns);
      }
    }
    matrix_ = unit_;
  }

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

  void set_step(double t, double tau) {
    if (tau != tau_) {
      tau_ = tau;
      for (std::size_t k = 0; k < unit_.size(); ++k)
        for (std::size_t j = 0; j < W; ++j) matrix_[k][j] = Pack<W>(tau) * unit_[k][j];
      scaled_weight_ = Pack<W>(tau) * weight_;
    }
    Pack<W>* time = slots_.data() + n_ * series_capacity;
    time[0] = Pack<W>(symmetric_ ? t + tau / 2 : t);
    time[1] = Pack<W>(tau) * node_;
    for (std::size_t level = 0; timed_ && level < levels_; ++level)
      width_.time(system_, slots_.data(), static_cast<int>(level));
  }

  void operator()(const double* w, double* psi) {
    Pack<W>* slots = slots_.data();
    for (std::size_t k = 0; k < n_; ++k) {
      slots[k * series_capacity] = Pack<W>(w[k]);
      sum_[k] = Pack<W>(0);
    }
    for (std::size_t level = 0; level < levels_; ++level) {
      width_.state[level](system_, slots, static_cast<int>(level));
      const bool counts = !symmetric_ || level % 2 == 0, last = level + 1 == levels_;
      for (std::size_t k = 0; k < n_; ++k) {
        const Pack<W> x = slots[static_cast<std::size_t>(output_[k]) * series_capacity + level];
        if (counts) sum_[k] = sum_[k] + scaled_weight_ * x;
        if (last) continue;
        const Columns& columns = matrix_[2 * kind_[k] + level % 2];
        Pack<W> next = columns[0] * Pack<W>(x[0]);
        for (std::size_t j = 1; j < W; ++j) next = next + columns[j] * Pack<W>(x[j]);
        slots[k * series_capacity + level + 1] = next;
      }
    }
    for (std::size_t k = 0; k < n_; ++k) psi[k] = sum_[k].sum();
  }

 private:
  using Columns = std::array<Pack<W>, W>;

  const CompiledSeries& series_;
  const void* system_;
  const CompiledSeries::Width& width_;
  std::size_t n_, levels_, evaluations_;
  bool symmetric_, timed_ = false;
  std::vector<int> output_;
  std::vector<Quad> moving_;
  std::vector<std::size_t> kind_;       // of component k: which matrices
  std::vector<Columns> unit_, matrix_;  // [2 kind + parity of the level]; matrix = tau unit
  Pack<W> node_, weight_, scaled_weight_;
  double tau_ = 0;
  std::vector<Pack<W>> slots_, sum_;
};

}  // namespace pfaff
