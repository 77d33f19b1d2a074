// n equal bodies of total mass one that attract each other, in a plane or in space:
//
//   H = sum_i n |p_i|^2/2 - G/n^2 sum_{j < i} 1/sqrt(|q_i - q_j|^2 + epsilon^2)
//
// with the softening length epsilon, which bounds the pull of close encounters (aarseth1963).
// Units are those in which mass, length and, with G = 1, time are of the order of one.
//
// With seed 0 the bodies stand on a circle of radius one and turn at the rate w at which they keep doing so,
//   w^2 = (G/n) sum_k 2 s_k^2/(4 s_k^2 + epsilon^2)^{3/2},   s_k = sin(pi k/n), k = 1, ..., n - 1,
// a motion that is unstable for all but few bodies. Other seeds draw positions and velocities, with the
// centre of mass at rest.
#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/gravitation.hpp>

namespace {
using namespace pfaff;

struct NBody : Gravitation<NBody> {
  static constexpr bool batched = true;
  int count = 3, axes = 2, seed = 0;
  Real attraction = 1, length = 0;
  static std::vector<Parameter> parameters() {
    using S = NBody;
    return {parameter(&S::count, "bodies", "", 2, 10000, "number of bodies"),
            parameter(&S::axes, "dimension", "", 2, 3, "of space"),
            parameter(&S::attraction, "gravitation", "", 0, 1e6, "constant of gravitation"),
            parameter(&S::length, "softening", "", 0, 1e3, "length that is added to distances by squares"),
            parameter(&S::seed, "seed", "", 0, 1000000000, "of the state at the start; 0: a turning circle")};
  }
  static std::vector<Assignments> instances(bool full) {
    const Assignments cloud{{"bodies", "7"}, {"dimension", "3"}, {"softening", "0.1"}, {"seed", "1"}};
    if (full) return {{}, {{"bodies", "2"}}, cloud};
    return {{}, cloud};
  }
  [[nodiscard]] int dimension() const { return 2 * count * axes; }
  [[nodiscard]] int bodies() const { return count; }
  [[nodiscard]] int dimensions() const { return axes; }
  [[nodiscard]] const Real& constant() const { return attraction; }
  [[nodiscard]] const Real& softening() const { return length; }
  template <class T>
  T mass(std::size_t /*body*/) const {
    return T(1) / T(count);
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
    const std::vector<Real> drawn = seed == 0 ? circle() : cloud();
    for (std::size_t k = 0; k < 2 * half; ++k) z[k] = T(k < half ? drawn[k] : drawn[k] / Real(count));
  }

 private:
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
    for (std::size_t row = half; row < 2 * half; row += n) {
      Real sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum = sum + z[row + i];
      for (std::size_t i = 0; i < n; ++i) z[row + i] = (z[row + i] - sum / Real(count)) / Real(2);
    }
    return z;
  }
};

const System<NBody> registered{
    {.name = "n-body",
     .title = "n equal bodies that attract each other, H = n sum |p_i|^2/2 - G/n^2 sum 1/r_ij",
     .reference = "aarseth1963",
     .description =
         "Any number of equal bodies of total mass one under their attraction, in a plane or in space, with "
         "softened distances where wanted. Take it to see how methods and costs grow with the number of "
         "bodies: an evaluation takes n (n - 1)/2 square roots. Without softening, "
         "random starts lead to close encounters, which steps of one size do not resolve.",
     .time_unit = ""}};
}  // namespace
