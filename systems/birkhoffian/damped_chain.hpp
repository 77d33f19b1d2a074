// A chain of n damped sites with springs between neighbours and free ends, in Birkhoff's form,
// z = (r_1 .. r_n, p_1 .. p_n), p_i = r_i':
//
//   r_i'' + nu r_i' + w'(r_i) + kappa (2 r_i - r_{i-1} - r_{i+1}) = 0   (a missing neighbour pulls nothing)
//   U = sum w(r_i) + kappa/2 sum (r_{i+1} - r_i)^2
//   F = e^{nu t} (p/2, -r/2),   B = e^{nu t} (|p|^2/2 + nu r.p/2 + U),   K = e^{nu t} [[0, -1], [1, 0]]
//
// Darboux chart y = (r, e^{nu t} p), where the Hamiltonian is e^{-nu t} |y_p|^2/2 + e^{nu t} U(y_r). The
// energy |p|^2/2 + U decreases at the rate nu |p|^2. Every formula costs a number of operations linear in n.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/registry/parameter.hpp>

#include "exponential_chart.hpp"

namespace pfaff {

/// `Site` has static templates energy(r), which is w, and force(r) = -w'(r). `Chain` is the author's struct,
/// derived from this one.
template <class Chain, class Site>
struct DampedChain : ExponentialChart<Chain> {
  int count = 3;
  Real nu = 0.1_r, kappa = 0.5_r;
  static std::vector<Parameter> parameters() {
    return {
        parameter<Chain>(static_cast<int Chain::*>(&DampedChain::count), "count", "", 1, 4096,
                         "number of sites"),
        parameter<Chain>(static_cast<Real Chain::*>(&DampedChain::nu), "nu", "1/s", 0, 10, "damping rate"),
        parameter<Chain>(static_cast<Real Chain::*>(&DampedChain::kappa), "kappa", "1/s^2", 0, 1e3,
                         "stiffness of the springs, per unit inertia")};
  }
  [[nodiscard]] int dimension() const { return 2 * count; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count); }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> names;
    for (int i = 1; i <= count; ++i) names.push_back({"r" + std::to_string(i), Site::unit});
    for (int i = 1; i <= count; ++i)
      names.push_back({"p" + std::to_string(i), Site::unit + std::string("/s")});
    return names;
  }
  /// The first site out of place, the last one moving.
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(1);
    z[2 * size() - 1] = T(Real::fraction(1, 2));
  }

  /// U, of the first n entries of z.
  template <class T>
  T potential_energy(In<T> z) const {
    T sites(0), springs(0);
    for (std::size_t i = 0; i < size(); ++i) {
      sites = sites + Site::energy(z[i]);
      if (i > 0) springs = springs + (z[i] - z[i - 1]) * (z[i] - z[i - 1]);
    }
    return sites + kappa * springs / 2;
  }
  /// |p|^2, of the last n entries of z.
  template <class T>
  T square_of_momenta(In<T> z) const {
    T sum(0);
    for (const T& p : z.subspan(size())) sum = sum + p * p;
    return sum;
  }

  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    T virial(0);
    for (std::size_t i = 0; i < size(); ++i) virial = virial + z[i] * z[size() + i];
    return this->growth(t) * ((square_of_momenta<T>(z) + nu * virial) / 2 + potential_energy<T>(z));
  }
  template <class T>
  T chart_hamiltonian(const T& t, In<T> y) const {
    return this->decay(t) * square_of_momenta<T>(y) / 2 + this->growth(t) * potential_energy<T>(y);
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    T pull(0);  // of the spring to the left
    for (std::size_t i = 0, n = size(); i < n; ++i) {
      const T next = i + 1 < n ? kappa * (z[i + 1] - z[i]) : T(0);
      rate[i] = z[n + i];
      rate[n + i] = Site::force(z[i]) + (next - pull) - nu * z[n + i];
      pull = next;
    }
  }
};

}  // namespace pfaff
