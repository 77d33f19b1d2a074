// The values of a number of states in a row, such as rates or forces, that a linear multistep method sums up.
//
// States lie in a ring, so that a new one takes the place of the oldest. Sums over states are formed for
// eight components at a time, which stay in registers on the way; each has the bits that it would have alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff {

template <class T>
class MultistepHistory {
 public:
  /// Room for the values of `states` states with `components` components each, all 0.
  MultistepHistory(std::size_t states, std::size_t components)
      : states_(states), components_(components), values_(states * components, T(0)) {}

  /// Forgets the oldest state. What is returned is the place of the values of the new one, which the caller
  /// writes. There must be room for one state at least.
  Out<T> next() {
    oldest_ = oldest_ + 1 == states_ ? 0 : oldest_ + 1;
    return newest();
  }
  [[nodiscard]] Out<T> newest() { return (*this)[states_ - 1]; }
  /// The values of state `state`, counted from the oldest.
  [[nodiscard]] Out<T> operator[](std::size_t state) { return {place(state), components_}; }
  [[nodiscard]] bool empty() const { return values_.empty(); }

  /// sums = sum_j weights_j times state j, oldest first, for as many states as have weights.
  void weighted(const std::vector<T>& weights, Out<T> sums) const {
    std::size_t component = 0;
    if constexpr (std::is_same_v<T, double>) {
      component = weighted_by<8>(weights, component, sums);
      component = weighted_by<4>(weights, component, sums);
      component = weighted_by<2>(weights, component, sums);
    }
    weighted_by<1>(weights, component, sums);
  }

 private:
  // The sums of the components from `component` on, as long as there are W of them; returns the next one.
  template <int W>
  std::size_t weighted_by(const std::vector<T>& weights, std::size_t component, Out<T> sums) const {
    using Several = std::conditional_t<W == 1, T, Pack<W>>;
    const std::size_t count = std::min(weights.size(), states_);
    const T *const begin = values_.data(), *const end = begin + values_.size();
    for (; component + W <= components_; component += W) {
      const T* state = begin + oldest_ * components_;
      Several sum(0);
      for (std::size_t j = 0; j < count; ++j) {
        if constexpr (W == 1)
          sum = sum + weights[j] * state[component];
        else
          sum = sum + Several(weights[j]) * Several::load(state + component);
        state += components_;
        if (state == end) state = begin;
      }
      if constexpr (W == 1)
        sums[component] = sum;
      else
        sum.store(sums.data() + component);
    }
    return component;
  }
  [[nodiscard]] T* place(std::size_t state) {
    const std::size_t at = oldest_ + state;
    return values_.data() + (at < states_ ? at : at - states_) * components_;
  }

  std::size_t states_, components_, oldest_ = 0;
  std::vector<T> values_;
};

}  // namespace pfaff
