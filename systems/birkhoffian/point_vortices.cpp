// Point vortices in the plane (aref2007), z = (x_1 .. x_n, y_1 .. y_n); the strength g_i of a vortex is its
// circulation over 2 pi, of either sign.
//
//   g_i x_i' = dH/dy_i,  g_i y_i' = -dH/dx_i,   H = -sum_{i<j} g_i g_j log r_ij
//   F = (g_i y_i/2, -g_i x_i/2),   B = H,   K = [[0, -G], [G, 0]],  G = diag(g_i)
//
// K is constant, but the canonical one only where all strengths are 1. Darboux chart (x_i, g_i y_i).
// Conserved are the energy H, the impulses sum g_i x_i and sum g_i y_i and the angular impulse
// sum g_i (x_i^2 + y_i^2).
#include <array>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct PointVortices {
  int count = 4;
  Real gamma1 = 1, gamma2 = 0.8_r, gamma3 = -0.6_r, gamma4 = 1.2_r;
  static std::vector<Parameter> parameters() {
    const std::string meaning = "strength of every fourth vortex from this one on, other than 0";
    return {parameter(&PointVortices::count, "count", "", 2, 256, "number of vortices"),
            parameter(&PointVortices::gamma1, "gamma1", "m^2/s", -100, 100, meaning),
            parameter(&PointVortices::gamma2, "gamma2", "m^2/s", -100, 100, meaning),
            parameter(&PointVortices::gamma3, "gamma3", "m^2/s", -100, 100, meaning),
            parameter(&PointVortices::gamma4, "gamma4", "m^2/s", -100, 100, meaning)};
  }
  [[nodiscard]] int dimension() const { return 2 * count; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count); }
  [[nodiscard]] const Real& strength(std::size_t i) const {
    const std::array<const Real*, 4> pattern{&gamma1, &gamma2, &gamma3, &gamma4};
    return *pattern[i % 4];
  }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> names;
    for (const char* axis : {"x", "y"})
      for (int i = 1; i <= count; ++i) names.push_back({axis + std::to_string(i), "m"});
    return names;
  }
  // On squares about the origin, four vortices on each. Without a strength K would be singular.
  template <class T>
  void initial(Out<T> z) const {
    for (std::size_t i = 0; i < size(); ++i) {
      if (strength(i).is(0))
        throw InputError("system point-vortices: gamma" + std::to_string(i % 4 + 1) +
                         " = 0, expected a strength other than 0");
      const int radius = static_cast<int>(2 + i / 4);
      z[i % 2 * size() + i] = T(i % 4 < 2 ? radius : -radius);
    }
  }

  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return energy<T>(z, [&](std::size_t i) { return z[size() + i]; });
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    for (std::size_t i = 0, n = size(); i < n; ++i) {
      form[i] = strength(i) * z[n + i] / 2;
      form[n + i] = -(strength(i) * z[i]) / 2;
    }
  }
  template <class T>
  void chart(const T& /*t*/, In<T> z, Out<T> y) const {
    for (std::size_t i = 0, n = size(); i < n; ++i) {
      y[i] = z[i];
      y[n + i] = strength(i) * z[n + i];
    }
  }
  template <class T>
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const {
    for (std::size_t i = 0, n = size(); i < n; ++i) {
      z[i] = y[i];
      z[n + i] = y[n + i] / strength(i);
    }
  }
  template <class T>
  T chart_hamiltonian(const T& /*t*/, In<T> y) const {
    return energy<T>(y, [&](std::size_t i) { return y[size() + i] / strength(i); });
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const std::size_t n = size();
    for (std::size_t i = 0; i < 2 * n; ++i) rate[i] = T(0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const T x = z[i] - z[j], y = z[n + i] - z[n + j], square = x * x + y * y;
        const T turn_x = -y / square, turn_y = x / square;
        rate[i] = rate[i] + strength(j) * turn_x;
        rate[n + i] = rate[n + i] + strength(j) * turn_y;
        rate[j] = rate[j] - strength(i) * turn_x;
        rate[n + j] = rate[n + j] - strength(i) * turn_y;
      }
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = birkhoffian(t, z);
    for (std::size_t k = 1; k < 4; ++k) values[k] = T(0);
    for (std::size_t i = 0, n = size(); i < n; ++i) {
      values[1] = values[1] + strength(i) * z[i];
      values[2] = values[2] + strength(i) * z[n + i];
      values[3] = values[3] + strength(i) * (z[i] * z[i] + z[n + i] * z[n + i]);
    }
  }

 private:
  /// H of the positions (x_i, height(i)).
  template <class T, class Height>
  T energy(In<T> x, const Height& height) const {
    T sum(0);
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const T across = x[i] - x[j], along = height(i) - height(j);
        sum = sum - strength(i) * (strength(j) * log(across * across + along * along)) / 2;
      }
    return sum;
  }
};

const System<PointVortices> registered{
    {.name = "point-vortices",
     .title = "point vortices in the plane, of strengths of either sign",
     .reference = "aref2007",
     .description =
         "Vortices of any strengths in an ideal fluid in the plane, which move each other by their velocity "
         "fields. Its structure is constant but not of unit entries, and energy, both impulses and the "
         "angular impulse are conserved. Four vortices and more are chaotic in general, and vortices that "
         "come close turn about each other so fast that steps have to follow.",
     .invariants = {conserved("energy", "m^4/s^2"), conserved("impulse-x", "m^3/s"),
                    conserved("impulse-y", "m^3/s"), conserved_quadratic("angular-impulse", "m^4/s")}}};
}  // namespace
