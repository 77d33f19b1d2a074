// The Lie-Poisson bracket of a heavy top, in its angular momentum m and the direction g of gravity:
//
//   {m_i, m_j} = -e_ijk m_k,  {m_i, g_j} = -e_ijk g_k,  {g_i, g_j} = 0
//
// Source: Marsden, Ratiu, Introduction to Mechanics and Symmetry (1999), section 15.10.
//
// False: the second of the `casimirs`, |m|^2, is none, as {m_i, g_j} changes it; beside |g|^2 it is m.g.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

struct BodyAndGravity {
  static constexpr int dimension = 6;

  // vector = Pi covector: with covector = (a, b), m' = m x a + g x b and g' = g x a.
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const In<T> m = z.first(3), g = z.subspan(3), a = covector.first(3), b = covector.subspan(3);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      vector[i] = (m[j] * a[k] - m[k] * a[j]) + (g[j] * b[k] - g[k] * b[j]);
      vector[3 + i] = g[j] * a[k] - g[k] * a[j];
    }
  }
  [[nodiscard]] int casimir_count() const { return 2; }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[3] * z[3] + z[4] * z[4] + z[5] * z[5];
    values[1] = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  }
};

const Bracket<BodyAndGravity> registered{
    {.name = "body-and-gravity",
     .title = "Lie-Poisson bracket of heavy tops",
     .reference = "marsden-ratiu1999",
     .description = "The bracket of the dual of se(3). Take it for tops. It has two Casimirs.",
     .symmetry = Symmetry::skew,
     .jacobi = true}};
}  // namespace
