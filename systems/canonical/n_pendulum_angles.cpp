// The planar n-pendulum in minimal coordinates: angles theta_i of the rods from the downward vertical, equal
// masses m on rods of equal length l, canonical momenta p = M(theta) omega,
//   H = p^T M(theta)^-1 p / 2 + V,  M_ij = m l^2 (n - max(i, j)) cos(theta_i - theta_j),
//   V = -m g l sum_i (n - i) cos theta_i  (i, j = 0 .. n - 1).
// Nothing is constrained, so that this is a reference for n-pendulum that is independent of rods and
// multipliers. Bob k is at l sum_{i <= k} (sin theta_i, -cos theta_i). M is positive definite: the
// factorisation M = L D L^T needs no pivots. Limits: M is dense, O(n^3) an evaluation.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct NPendulumAngles {
  int bobs = 2;
  Real mass = 1, length = 1, gravity = 9.81_r;
  static std::vector<Parameter> parameters() {
    using S = NPendulumAngles;
    return {parameter(&S::bobs, "bobs", "", 1, 12, "number of bobs, n"),
            parameter(&S::mass, "mass", "kg", 1e-6, 1e6, "of each bob"),
            parameter(&S::length, "length", "m", 1e-6, 1e6, "of each rod"),
            parameter(&S::gravity, "gravity", "m/s^2", 0, 1e6)};
  }
  [[nodiscard]] int dimension() const { return 2 * bobs; }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> list;
    for (int k = 1; k <= bobs; ++k) list.push_back({"theta" + std::to_string(k), "rad"});
    for (int k = 1; k <= bobs; ++k) list.push_back({"p" + std::to_string(k), "kg m^2/s"});
    return list;
  }

  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const auto n = static_cast<std::size_t>(bobs);
    std::vector<T> sine(n), cosine(n), factor(n * n), pivot(n), y(n);
    for (std::size_t i = 0; i < n; ++i) sine_cosine(z[i], sine[i], cosine[i]);
    // L D L^T y = p, and p^T M^-1 p = y'^T D^-1 y' with L y' = p.
    T twice_kinetic(0), potential(0);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = z[n + i];
      for (std::size_t j = 0; j <= i; ++j) {
        T entry = T(mass * length * length * Real(static_cast<int>(n - i))) *
                  (cosine[i] * cosine[j] + sine[i] * sine[j]);
        for (std::size_t k = 0; k < j; ++k) entry = entry - factor[i * n + k] * factor[j * n + k] * pivot[k];
        if (i == j) {
          pivot[i] = entry;
        } else {
          factor[i * n + j] = entry / pivot[j];
          y[i] = y[i] - factor[i * n + j] * y[j];
        }
      }
      twice_kinetic = twice_kinetic + y[i] * y[i] / pivot[i];
      potential = potential - T(mass * gravity * length * Real(static_cast<int>(n - i))) * cosine[i];
    }
    return twice_kinetic / 2 + potential;
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
  }
  template <class T>
  void initial(Out<T> z) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(bobs); ++k)
      z[k] = T(Real::fraction(1, 2 + static_cast<int>(k)));
  }
};

const System<NPendulumAngles> registered{
    {.name = "n-pendulum-angles",
     .title = "planar n-pendulum in angles, H = p.M(theta)^-1 p/2 - m g l sum (n - i) cos theta_i",
     .reference = "nguyen-turski appendix B; landau-lifshitz1976 section 5",
     .description = "The planar pendulum of n equal bobs in angles, where nothing is constrained and the "
                    "mass matrix depends on the state. Take it as an independent reference for the "
                    "constrained n-pendulum. The mass matrix is dense, so that an evaluation costs the cube "
                    "of n, and the energy is not separable, which excludes explicit splitting methods.",
     .invariants = {conserved("energy", "J")}}};
}  // namespace
