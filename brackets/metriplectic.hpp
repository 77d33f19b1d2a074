// Metriplectic pairs: a Poisson bracket and a symmetric one that move a state together (morrison1986;
// nguyen-turski section 1).
//
// With a free energy H: zdot = Pi dH - G dH, so that H falls at the rate <H, H>.
// With an energy H and an entropy S: zdot = Pi dH + G dS, where Pi dS = 0 and G dH = 0: then H is conserved
// and S rises at the rate <S, S>. The two conditions are what degeneracy() measures.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

template <class Poisson, class Symmetric>
struct MetriplecticPair {
  Poisson poisson;
  Symmetric symmetric;

  /// rate = Pi dH - G dH.
  template <class T>
  void free_energy_field(const T& t, In<T> z, In<T> energy_slope, Out<T> rate) const {
    std::vector<T> friction(rate.size());
    poisson.sharp(t, z, energy_slope, rate);
    symmetric.sharp(t, z, energy_slope, Out<T>(friction));
    for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = rate[k] - friction[k];
  }
  /// rate = Pi dH + G dS.
  template <class T>
  void entropy_field(const T& t, In<T> z, In<T> energy_slope, In<T> entropy_slope, Out<T> rate) const {
    std::vector<T> relaxation(rate.size());
    poisson.sharp(t, z, energy_slope, rate);
    symmetric.sharp(t, z, entropy_slope, Out<T>(relaxation));
    for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = rate[k] + relaxation[k];
  }
  /// The largest components of Pi dS and G dH: both 0 for energy and entropy.
  template <class T>
  [[nodiscard]] std::pair<Value<T>, Value<T>> degeneracy(const T& t, In<T> z, In<T> energy_slope,
                                                         In<T> entropy_slope) const {
    std::vector<T> vector(z.size());
    const auto largest = [&] {
      Value<T> worst(0);
      for (const T& x : vector)
        if (const Value<T> size = abs(value_of(x)); !(size <= worst)) worst = size;
      return worst;
    };
    poisson.sharp(t, z, entropy_slope, Out<T>(vector));
    const Value<T> of_entropy = largest();
    symmetric.sharp(t, z, energy_slope, Out<T>(vector));
    return {of_entropy, largest()};
  }
};

template <class Poisson, class Symmetric>
MetriplecticPair<Poisson, Symmetric> metriplectic(Poisson poisson, Symmetric symmetric) {
  return {std::move(poisson), std::move(symmetric)};
}

}  // namespace pfaff
