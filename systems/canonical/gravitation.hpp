// Newton's attraction between n bodies in d dimensions, d = 2 or 3:
//
//   V = -G sum_{j < i} m_i m_j / r_ij,   r_ij^2 = |q_i - q_j|^2 + epsilon^2
//
// with the constant of gravitation G and the softening length epsilon, zero for points. Coordinates stand by
// direction, q = (x_1, ..., x_n, y_1, ..., y_n, ...), momenta likewise. What is the same for every number of
// bodies, every mass and every state is here: energies, forces, velocities and the invariants energy,
// momentum and angular momentum.
//
// Forces go through the pairs once, n (n - 1)/2 square roots and divisions, and allocate nothing. Points are
// also split into Kepler orbits and their interaction (planetary_splitting.hpp), with any masses; the
// interaction is small where the first body is much heavier than the others. Softened pulls have no such
// splitting.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/systems/canonical/planetary_splitting.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace pfaff {

/// S has the masses, `template <class T> T mass(std::size_t body) const`, and bodies(), dimensions(),
/// constant() and softening().
template <class S>
class Gravitation {
 public:
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const std::size_t n = count();
    T sum(0);
    for (std::size_t i = 0; i < n; ++i) {
      T square = p[i] * p[i];
      for (std::size_t x = 1; x < directions(); ++x) square = square + p[x * n + i] * p[x * n + i];
      sum = sum + square / mass<T>(i);
    }
    return sum / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const std::size_t n = count();
    T sum(0);
    for (std::size_t i = 1; i < n; ++i) {
      const T strength = T(self().constant()) * mass<T>(i);
      for (std::size_t j = 0; j < i; ++j) {
        std::array<T, 3> way{};
        sum = sum - strength * mass<T>(j) / sqrt(square_distance<T>(q, i, j, way));
      }
    }
    return sum;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const std::size_t n = count(), d = directions();
    for (std::size_t k = 0; k < n * d; ++k) f[k] = T(0);
    for (std::size_t i = 1; i < n; ++i) {
      const T strength = T(self().constant()) * mass<T>(i);
      std::array<T, 3> sum{};
      for (std::size_t j = 0; j < i; ++j) {
        std::array<T, 3> way{};
        const T square = square_distance<T>(q, i, j, way);
        const T scale = strength * mass<T>(j) / (square * sqrt(square));
        for (std::size_t x = 0; x < d; ++x) {
          const T pull = scale * way[x];
          sum[x] = sum[x] + pull;
          f[x * n + j] = f[x * n + j] - pull;
        }
      }
      for (std::size_t x = 0; x < d; ++x) f[x * n + i] = f[x * n + i] + sum[x];
    }
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    const std::size_t n = count();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t x = 0; x < directions(); ++x) v[x * n + i] = p[x * n + i] / mass<T>(i);
  }
  static constexpr std::size_t small_part = planetary::interaction;
  [[nodiscard]] int part_count() const { return self().softening().is(0) ? 2 : 0; }
  [[nodiscard]] std::vector<std::string> part_names() const {
    return part_count() == 0 ? std::vector<std::string>{} : planetary::part_names();
  }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const auto of_body = [this](std::size_t body) { return mass<T>(body); };
    return planetary::part_flow<T>(part, of_body, T(self().constant()), count(), directions(), h, z, change);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  /// Energy, momentum, and angular momentum about the axes 3 in the plane and 1, 2, 3 in space.
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const std::size_t n = count(), d = directions(), half = n * d;
    const In<T> q = z.first(half), p = z.subspan(half);
    std::size_t next = 0;
    values[next++] = kinetic(t, p) + potential(t, q);
    for (std::size_t x = 0; x < d; ++x) {
      T sum(0);
      for (std::size_t i = 0; i < n; ++i) sum = sum + p[x * n + i];
      values[next++] = sum;
    }
    for (std::size_t axis = d == 2 ? 2 : 0; axis < 3; ++axis) {
      const std::size_t x = (axis + 1) % 3 * n, y = (axis + 2) % 3 * n;
      T sum(0);
      for (std::size_t i = 0; i < n; ++i) sum = sum + (q[x + i] * p[y + i] - q[y + i] * p[x + i]);
      values[next++] = sum;
    }
  }

  /// x_NAME, ..., px_NAME, ... with the names of the bodies.
  static std::vector<Coordinate> named(const std::vector<std::string>& bodies, std::size_t dimensions,
                                       const std::string& length, const std::string& momentum) {
    std::vector<Coordinate> list;
    for (const char* prefix : {"", "p"})
      for (std::size_t x = 0; x < dimensions; ++x)
        for (const std::string& body : bodies)
          list.push_back({prefix + std::string(1, "xyz"[x]) + "_" + body, *prefix == 0 ? length : momentum});
    return list;
  }
  static std::vector<Invariant> kept(std::size_t dimensions, const std::string& energy,
                                     const std::string& momentum, const std::string& angular) {
    std::vector<Invariant> list{conserved("energy", energy)};
    for (std::size_t x = 0; x < dimensions; ++x)
      list.push_back(conserved("momentum-" + std::string(1, "xyz"[x]), momentum));
    for (std::size_t axis = dimensions == 2 ? 2 : 0; axis < 3; ++axis)
      list.push_back(conserved_quadratic("angular-momentum-" + std::string(1, "xyz"[axis]), angular));
    return list;
  }

 private:
  [[nodiscard]] const S& self() const { return static_cast<const S&>(*this); }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(self().bodies()); }
  [[nodiscard]] std::size_t directions() const { return static_cast<std::size_t>(self().dimensions()); }

  template <class T>
  T mass(std::size_t body) const {
    return self().template mass<T>(body);
  }
  // r_ij^2, and q_j - q_i.
  template <class T>
  T square_distance(In<T> q, std::size_t i, std::size_t j, std::array<T, 3>& way) const {
    const std::size_t n = count();
    const T softening = T(self().softening());
    T square = softening * softening;
    for (std::size_t x = 0; x < directions(); ++x) {
      way[x] = q[x * n + j] - q[x * n + i];
      square = square + way[x] * way[x];
    }
    return square;
  }
};

}  // namespace pfaff
