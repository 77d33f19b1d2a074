// A structure K(t) in four dimensions without a zero off its diagonal, for an anharmonic energy; nothing in
// it is canonical, and it comes without a Darboux chart (su-qin (4), (5), and (17) for F).
//
//   K_12 = c (2 + cos wt),  K_13 = -(2 + sin wt),  K_14 = c (2 + sin wt),
//   K_23 = c (2 - cos wt),  K_24 = -(2 + cos wt),  K_34 = c (2 - sin wt)
//   F = -K z/2,   B = |z|^2/2 + lambda (z_1^4 + z_2^4 + z_3^4 + z_4^4)/4
//
// K is regular, as its Pfaffian K_12 K_34 - K_13 K_24 + K_14 K_23 is negative at all times for c <= 0.45. The
// field is K^-1 (grad B - K' z/2), with the inverse of a skew matrix of four rows written out. Nothing is
// conserved: B changes at the rate grad B.K^-1 F_t.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct DenseTimeStructure {
  static constexpr int dimension = 4;
  Real c = 0.2_r, omega = 1, lambda = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&DenseTimeStructure::c, "c", "", 0, 0.45, "the structure's non-canonical part"),
            parameter(&DenseTimeStructure::omega, "omega", "1/s", 0, 100, "the structure's frequency"),
            parameter(&DenseTimeStructure::lambda, "lambda", "", 0, 100, "quartic part of the energy")};
  }

  /// K_12, K_13, K_14, K_23, K_24, K_34 of K or of its derivative.
  template <class T>
  struct Skew {
    T k12, k13, k14, k23, k24, k34;
    void times(In<T> z, Out<T> product) const {
      product[0] = k12 * z[1] + k13 * z[2] + k14 * z[3];
      product[1] = k23 * z[2] + k24 * z[3] - k12 * z[0];
      product[2] = k34 * z[3] - k13 * z[0] - k23 * z[1];
      product[3] = -(k14 * z[0]) - k24 * z[1] - k34 * z[2];
    }
  };
  template <class T>
  Skew<T> entries(const T& t) const {
    const T cosine = cos(omega * t), sine = sin(omega * t);
    return {c * (2 + cosine), -(2 + sine), c * (2 + sine), c * (2 - cosine), -(2 + cosine), c * (2 - sine)};
  }
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    T sum(0);
    for (const T& x : z) sum = sum + x * x * (2 + lambda * (x * x));
    return sum / 4;
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    entries(t).times(z, form);
    for (T& x : form) x = -x / 2;
  }
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    const T cosine = omega * cos(omega * t), sine = omega * sin(omega * t);
    const Skew<T> slope{-(c * sine), -cosine, c * cosine, c * sine, sine, -(c * cosine)}, k = entries(t);
    slope.times(z, rate);
    T g[dimension];
    for (std::size_t i = 0; i < dimension; ++i) g[i] = z[i] + lambda * (z[i] * z[i] * z[i]) - rate[i] / 2;
    const T pfaffian = k.k12 * k.k34 - k.k13 * k.k24 + k.k14 * k.k23;
    const Skew<T> dual{-k.k34, k.k24, -k.k23, -k.k14, k.k13, -k.k12};
    dual.times(g, rate);
    for (T& x : rate) x = x / pfaffian;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = birkhoffian(t, z);
  }
};

const System<DenseTimeStructure> registered{
    {.name = "dense-time-structure",
     .title = "anharmonic energy in a dense structure K(t) of four dimensions",
     .reference = "su-qin (4), (5), (17)",
     .description = "A constructed system of four dimensions whose structure depends on time and has no zero "
                    "off its diagonal. Take it to test that methods and derivations of charts make no use of "
                    "sparse or canonical structure. Nothing is conserved and there is no physical meaning; "
                    "it is regular for its coupling up to 0.45.",
     .coordinates = {{"z1", ""}, {"z2", ""}, {"z3", ""}, {"z4", ""}},
     .initial = {1, 0.5_r, -0.3_r, 0.7_r},
     .invariants = {{"birkhoffian", "", Behaviour::free}}}};
}  // namespace
