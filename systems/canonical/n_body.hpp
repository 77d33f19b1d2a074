// n bodies of total mass one that attract each other, in a plane or in space:
//
//   H = sum_i |p_i|^2/(2 m_i) - G sum_{j < i} m_i m_j/sqrt(|q_i - q_j|^2 + epsilon^2)
//
// all of the mass 1/n, or the first of them c times as heavy as each other one, m_0 = c/(c + n - 1), with the
// softening length epsilon, which bounds the pull of close encounters (aarseth1963).
// Units are those in which mass, length and, with G = 1, time are of the order of one.
//
// With seed 0 the bodies stand on a circle of radius one and turn at the rate w at which they keep doing so,
//   w^2 = (G/n) sum_k 2 s_k^2/(4 s_k^2 + epsilon^2)^{3/2},   s_k = sin(pi k/n), k = 1, ..., n - 1,
// a motion that is unstable for all but few bodies. A heavier first body, c > 1, has the others on circles
// about it instead, of radii 1, 3/2, 2, ..., which their pulls on each other disturb. Other seeds draw
// positions and velocities. The centre of mass is at rest.
#pragma once

#include <array>

#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/systems/canonical/gravitation.hpp>

namespace pfaff {

struct NBody : Gravitation<NBody> {
  static constexpr bool batched = true;
  int count = 3, axes = 2, seed = 0;
  Real attraction = 1, length = 0, central = 1;
  static std::vector<Parameter> parameters() {
    using S = NBody;
    return {
        parameter(&S::count, "bodies", "", 2, 10000, "number of bodies"),
        parameter(&S::axes, "dimension", "", 2, 3, "of space"),
        parameter(&S::attraction, "gravitation", "", 0, 1e6, "constant of gravitation"),
        parameter(&S::length, "softening", "", 0, 1e3, "length that is added to distances by squares"),
        parameter(&S::central, "central", "", 1, 1e12, "mass of the first body, in that of each other one"),
        parameter(&S::seed, "seed", "", 0, 1000000000, "of the state at the start; 0: a turning circle")};
  }
  static std::vector<Assignments> instances(bool full) {
    const Assignments cloud{{"bodies", "7"}, {"dimension", "3"}, {"softening", "0.1"}, {"seed", "1"}};
    const Assignments planets{{"bodies", "4"}, {"dimension", "3"}, {"central", "1000"}};
    if (full) return {{}, {{"bodies", "2"}}, cloud, planets};
    return {{}, cloud, planets};
  }
  [[nodiscard]] int dimension() const { return 2 * count * axes; }
  [[nodiscard]] int bodies() const { return count; }
  [[nodiscard]] int dimensions() const { return axes; }
  [[nodiscard]] const Real& constant() const { return attraction; }
  [[nodiscard]] const Real& softening() const { return length; }
  template <class T>
  T mass(std::size_t body) const {
    return (body == 0 ? T(central) : T(1)) / (T(central) + T(count - 1));
  }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<std::string> names;
    for (int i = 1; i <= count; ++i) names.push_back(std::to_string(i));
    return named(names, static_cast<std::size_t>(axes), "", "");
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    return kept(static_cast<std::size_t>(axes), "", "", "");
  }
  template <class T>
  void initial(Out<T> z) const {
    const auto n = static_cast<std::size_t>(count), half = n * static_cast<std::size_t>(axes);
    const std::vector<Real> drawn = seed != 0 ? cloud() : central.is(1) ? circle() : orbits();
    for (std::size_t k = 0; k < 2 * half; ++k)
      z[k] = T(k < half ? drawn[k] : drawn[k] * weight(k % n) / whole());
  }

 private:
  // The masses in that of each body but the first.
  [[nodiscard]] Real weight(std::size_t body) const { return body == 0 ? central : Real(1); }
  [[nodiscard]] Real whole() const { return central + Real(count - 1); }
  // Brings the mean, by mass, of each row of n numbers from the row at `first` on to zero.
  void centre(std::vector<Real>& z, std::size_t first) const {
    const auto n = static_cast<std::size_t>(count);
    for (std::size_t row = first; row < z.size(); row += n) {
      Real sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum = sum + weight(i) * z[row + i];
      for (std::size_t i = 0; i < n; ++i) z[row + i] = z[row + i] - sum / whole();
    }
  }
  // Positions and velocities.
  [[nodiscard]] std::vector<Real> circle() const {
    const auto n = static_cast<std::size_t>(count), half = n * static_cast<std::size_t>(axes);
    const Real pi = 3.14159265358979323846264338327950288_r;
    Real square = 0;
    for (int k = 1; k < count; ++k) {
      const Real s = sin(pi * Real::fraction(k, count)), r = Real(4) * s * s + length * length;
      square = square + Real(2) * s * s / (r * sqrt(r));
    }
    const Real rate = sqrt(attraction / Real(count) * square);
    std::vector<Real> z(2 * half);
    for (std::size_t i = 0; i < n; ++i) {
      const Real angle = pi * Real::fraction(2 * static_cast<std::int64_t>(i), count);
      z[i] = cos(angle);
      z[n + i] = sin(angle);
      // Quarters of a turn exactly. The sine of the rounded pi is not zero but 1e-35, which would pass for
      // the size of a coordinate.
      if (4 * i % n == 0) {
        constexpr std::array<int, 5> quarter{1, 0, -1, 0, 1};
        z[i] = quarter[4 * i / n];
        z[n + i] = quarter[(4 * i / n + 3) % 4];
      }
      z[half + i] = -(rate * z[n + i]);
      z[half + n + i] = rate * z[i];
    }
    return z;
  }
  [[nodiscard]] std::vector<Real> cloud() const {
    const auto n = static_cast<std::size_t>(count), half = n * static_cast<std::size_t>(axes);
    RandomNumbers random(seed);
    std::vector<Real> z(2 * half);
    for (Real& x : z) x = random.next();
    centre(z, half);
    for (std::size_t k = half; k < 2 * half; ++k) z[k] = z[k] / Real(2);
    return z;
  }
  // Circles about the first body, an angle of two radians apart; in space each a little off the plane.
  [[nodiscard]] std::vector<Real> orbits() const {
    const auto n = static_cast<std::size_t>(count), half = n * static_cast<std::size_t>(axes);
    std::vector<Real> z(2 * half);
    Real radius = 1;
    for (std::size_t i = 1; i < n; ++i, radius = radius + Real::fraction(1, 2)) {
      const Real angle = Real(static_cast<int>(2 * i)),
                 inner = (central + Real(static_cast<int>(i))) / whole();
      const Real speed = sqrt(attraction * inner / radius);
      z[i] = radius * cos(angle);
      z[n + i] = radius * sin(angle);
      z[half + i] = -(speed * sin(angle));
      z[half + n + i] = speed * cos(angle);
      if (axes == 3) z[half + 2 * n + i] = speed * Real::fraction(i % 2 == 0 ? 1 : -1, 50);
    }
    centre(z, 0);
    return z;
  }
};

}  // namespace pfaff
