// Birkhoff's form of motion with linear friction, r_i'' + nu r_i' + dU/dr_i = 0, in z = (r, p) with p = r'.
//
// Friction makes the momenta decay as e^{-nu t}, so that the momenta times e^{nu t} obey Hamilton's equations
// (bateman1931; su-qin (92)-(95)):
//
//   F = e^{nu t} (p/2, -r/2),   K = e^{nu t} [[0, -1], [1, 0]],   Darboux chart y = (r, e^{nu t} p)
//
// The structure depends on time alone and not on the potential. What does depend on it, B and the Hamiltonian
// in the chart, each system writes itself. e^{nu t} overflows in double precision beyond nu t of about 709.
#pragma once

#include <cstddef>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The one-form and the chart of a system with the damping rate `nu`, in 1/s, which is a member of `S`. S is
/// the author's struct, derived from this one. States have r in their first half and p in the second.
template <class S>
struct ExponentialChart {
  /// e^{nu t}, by which momenta in the chart exceed those of the state.
  template <class T>
  T growth(const T& t) const {
    return exp(rate_of_damping() * t);
  }
  /// e^{-nu t}.
  template <class T>
  T decay(const T& t) const {
    return exp(-(rate_of_damping() * t));
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    const T half = growth(t) / 2;
    for (std::size_t i = 0, n = z.size() / 2; i < n; ++i) {
      form[i] = half * z[n + i];
      form[n + i] = -(half * z[i]);
    }
  }
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    scale_momenta<T>(growth(t), z, y);
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    scale_momenta<T>(decay(t), y, z);
  }

 private:
  [[nodiscard]] const auto& rate_of_damping() const { return static_cast<const S&>(*this).nu; }
  template <class T>
  static void scale_momenta(const T& factor, In<T> from, Out<T> to) {
    for (std::size_t i = 0, n = from.size() / 2; i < n; ++i) {
      to[i] = from[i];
      to[n + i] = factor * from[n + i];
    }
  }
};

}  // namespace pfaff
