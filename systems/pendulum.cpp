// The mathematical pendulum, H = p^2/2 - omega^2 cos q.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Pendulum {
  static constexpr int dimension = 2;
  Real omega = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&Pendulum::omega, "omega", "1/s", 1e-3, 1e3, "frequency of small swings")};
  }
  template <class T> T kinetic(const T& /*t*/, In<T> p) const { return p[0] * p[0] / 2; }
  template <class T> T potential(const T& /*t*/, In<T> q) const { return -(omega * omega * cos(q[0])); }
  template <class T> void force(const T& /*t*/, In<T> q, Out<T> f) const { f[0] = -(omega * omega * sin(q[0])); }
  template <class T> void velocity(const T& /*t*/, In<T> p, Out<T> v) const { v[0] = p[0]; }
  template <class T> void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(1)) + potential(t, z.first(1));
  }
};

const System<Pendulum> registered{{.name = "pendulum",
                                   .title = "pendulum, q'' + omega^2 sin q = 0",
                                   .reference = "hairer-lubich-wanner2006 (I.1.13)",
                                   .coordinates = {{"q", "rad"}, {"p", "rad/s"}},
                                   .initial = {1, 0.5_r},
                                   .invariants = {conserved("energy", "rad^2/s^2")}}};
}  // namespace
