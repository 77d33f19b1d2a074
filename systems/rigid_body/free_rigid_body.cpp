// The free rigid body in the body frame, z = angular momentum, H = sum z_i^2 / (2 I_i) with the Lie-Poisson
// bracket of so(3)*: z' = z x I^-1 z. The Casimir |z|^2/2 and the energy are conserved, both quadratic.
//
// Exact solution by Jacobi's functions (landau-lifshitz1976 section 37) for any moments and any state. Where
// two moments are equal or nearly so it turns into the regular precession without a loss of accuracy.
#include <array>

#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/numbers/elliptic.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct FreeRigidBody {
  static constexpr int dimension = 3;
  Real i1 = 2, i2 = 1, i3 = Real::fraction(2, 3);
  static std::vector<Parameter> parameters() {
    return {parameter(&FreeRigidBody::i1, "i1", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&FreeRigidBody::i2, "i2", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&FreeRigidBody::i3, "i3", "kg m^2", 1e-3, 1e3, "principal moment of inertia")};
  }
  [[nodiscard]] LiePoissonBracket bracket() const { return LiePoissonBracket::rigid_body(); }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] / i1 + z[1] * z[1] / i2 + z[2] * z[2] / i3) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T w1 = z[0] / i1, w2 = z[1] / i2, w3 = z[2] / i3;
    rate[0] = z[1] * w3 - z[2] * w2;
    rate[1] = z[2] * w1 - z[0] * w3;
    rate[2] = z[0] * w2 - z[1] * w1;
  }
  // H = sum H_a with H_a = z_a^2/(2 I_a), which turns the other two components by the angle h z_a/I_a.
  static constexpr int part_count = 3;
  static std::vector<std::string> part_names() { return {"turn about 1", "turn about 2", "turn about 3"}; }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const std::size_t b = (part + 1) % 3, d = (part + 2) % 3;
    T sine, cosine;
    sine_cosine(T(h * z[part] / (2 * T(part == 0 ? i1 : part == 1 ? i2 : i3))), sine, cosine);
    const T turned = 2 * sine * cosine, less = -(2 * sine * sine);
    change[part] = T(0);
    change[b] = less * z[b] + turned * z[d];
    change[d] = less * z[d] - turned * z[b];
    return Status::converged;
  }
  // The field is quadratic: turned round, the body goes the same way backwards.
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    for (std::size_t a = 0; a < 3; ++a) reversed[a] = -z[a];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) / 2;
  }
  // z_a' = c_a z_b z_d for (a, b, d) = (1, 2, 3), (2, 3, 1), (3, 1, 2), with c_1 + c_2 + c_3 = 0: where no c
  // vanishes, that of the middle moment has the sign opposite to the others'. With sigma = sqrt|c_1 c_2 c_3|
  // and z_k/sqrt|c_k| for z_k it is jacobi_flow in time sigma t, up to a sign of the middle component.
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const std::array<Real, 3> c{1 / i3 - 1 / i2, 1 / i1 - 1 / i3, 1 / i2 - 1 / i1};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      if (c[a].is(0)) {  // symmetric about axis a: the others turn at a constant rate
        const T phase = c[b] * z0[a] * elapsed, cosine = cos(phase), sine = sin(phase);
        z[a] = z0[a];
        z[b] = z0[b] * cosine + z0[d] * sine;
        z[d] = z0[d] * cosine - z0[b] * sine;
        return;
      }
    }
    std::size_t middle = 0;
    const auto alike = [&](std::size_t a, std::size_t b) { return (c[a] > Real(0)) == (c[b] > Real(0)); };
    while (alike(middle, (middle + 1) % 3) || alike(middle, (middle + 2) % 3)) ++middle;
    const std::size_t one = (middle + 1) % 3, two = (middle + 2) % 3;
    const auto root = [&](std::size_t k) { return sqrt(c[k] > Real(0) ? c[k] : -c[k]); };
    // x' = y z, y' = -x z, z' = -x y wants the middle coefficient positive.
    const Real sign = c[middle] > Real(0) ? Real(1) : Real(-1);
    const Real sigma = root(0) * root(1) * root(2);
    const JacobiState<T> start{sign * z0[middle] / root(middle), z0[one] / root(one), z0[two] / root(two)};
    const JacobiState<T> end = jacobi_flow(sigma * elapsed, start).state;
    z[middle] = sign * end.x * root(middle);
    z[one] = end.y * root(one);
    z[two] = end.z * root(two);
  }
};

const System<FreeRigidBody> registered{
    {.name = "free-rigid-body",
     .title = "free rigid body, z' = z x I^-1 z, on so(3)*",
     .reference = "marsden-ratiu1999 (1.2.9); hairer-lubich-wanner2006 VII.5",
     .description =
         "A rigid body that turns freely, by its angular momentum in the body frame, with an exact solution "
         "in elliptic functions. Take it as the simplest Lie-Poisson system: energy and Casimir are both "
         "quadratic, and the Gauss methods keep both. Motion near the middle axis is unstable.",
     .coordinates = {{"z1", "kg m^2/s"}, {"z2", "kg m^2/s"}, {"z3", "kg m^2/s"}},
     .initial = {Real::fraction(9, 10), 0, Real::fraction(3, 5)},
     .invariants = {conserved_quadratic("energy", "J"), conserved_quadratic("casimir", "kg^2 m^4/s^2")}}};
}  // namespace
