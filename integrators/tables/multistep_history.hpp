// The values of a number of states in a row, such as rates or forces, that a linear multistep method sums up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

template <class T>
class MultistepHistory {
 public:
  /// Room for the values of `states` states with `components` components each, all 0.
  MultistepHistory(std::size_t states, std::size_t components)
      : components_(components), values_(states * components, T(0)) {}

  /// Forgets the oldest state. What is returned is the place of the values of the new one, which the caller
  /// writes. There must be room for one state at least.
  Out<T> next() {
    std::copy(values_.begin() + static_cast<std::ptrdiff_t>(components_), values_.end(), values_.begin());
    return newest();
  }
  [[nodiscard]] Out<T> newest() { return {values_.data() + (values_.size() - components_), components_}; }
  /// The values of state `state`, counted from the oldest.
  [[nodiscard]] Out<T> operator[](std::size_t state) {
    return {values_.data() + state * components_, components_};
  }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  /// sum_j weights_j times component `component` of state j, oldest first, for as many states as have
  /// weights.
  [[nodiscard]] T weighted(const std::vector<T>& weights, std::size_t component) const {
    T sum(0);
    const std::size_t states = components_ == 0 ? 0 : values_.size() / components_;
    for (std::size_t j = 0; j < std::min(weights.size(), states); ++j)
      sum = sum + weights[j] * values_[j * components_ + component];
    return sum;
  }

 private:
  std::size_t components_;
  std::vector<T> values_;
};

}  // namespace pfaff
