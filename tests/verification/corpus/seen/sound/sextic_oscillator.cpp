// A particle in the potential k q^6/6, with the two exact flows that its energy splits into, a drift and a
// kick.
//
// Source: Bender, Orszag, Advanced Mathematical Methods (1978), chapter 10; Hairer, Lubich, Wanner, II.5.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct SexticOscillator {
  static constexpr int dimension = 2;
  Real mass = 1, k = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&SexticOscillator::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&SexticOscillator::k, "k", "J/m^6", 0, 1e3, "stiffness")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / (2 * mass);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T square = q[0] * q[0];
    return k * square * square * square / 6;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const T square = q[0] * q[0];
    f[0] = -(k * square * square * q[0]);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reversed[0] = -z[0];
    reversed[1] = z[1];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(1)) + potential(t, z.first(1));
  }
  static constexpr int part_count = 2;
  [[nodiscard]] std::vector<std::string> part_names() const { return {"drift", "kick"}; }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const T square = z[0] * z[0];
    change[0] = part == 0 ? h * z[1] / mass : T(0);
    change[1] = part == 0 ? T(0) : -(h * k * square * square * z[0]);
    return Status::converged;
  }
};

const System<SexticOscillator> registered{
    {.name = "sextic-oscillator",
     .title = "particle in a sextic trap, m q'' + k q^5 = 0",
     .reference = "hairer-lubich-wanner2006 II.5",
     .description = "A particle in a trap of sixth degree, whose frequency grows with the square of the "
                    "amplitude. Take it as a problem that no quadratic form describes. It has no "
                    "harmonic limit.",
     .coordinates = {{"q", "m"}, {"p", "kg m/s"}},
     .initial = {0.8_r, 0.3_r},
     .invariants = {conserved("energy", "J")}}};
}  // namespace
