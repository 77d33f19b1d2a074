// A closed chain of n classical spins of Heisenberg's model with an anisotropy along the third axis,
//
//   H = -sum_k (s_k.s_(k+1) + (anisotropy) s_k3 s_(k+1)3),   s_k' = s_k x dH/ds_k
//
// with the bracket {s_a, s_b} = -e_abc s_c of the components of every spin, and 3 n coordinates. The length
// of every spin is a Casimir. The third component of the whole spin is conserved; the others are where there
// is no anisotropy.
//
// Source: Frank, Huang, Leimkuhler, Geometric integrators for classical spin systems, J. Comput. Phys. 133
// (1997) 160.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// The brackets of n spins side by side.
struct Spins {
  int n;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (std::size_t k = 0; k < z.size(); k += 3)
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        vector[k + a] = z[k + b] * covector[k + c] - z[k + c] * covector[k + b];
      }
  }
  [[nodiscard]] int casimir_count() const { return n; }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = z[3 * k] * z[3 * k] + z[3 * k + 1] * z[3 * k + 1] + z[3 * k + 2] * z[3 * k + 2];
  }
};

struct SpinChain {
  int n = 5;
  Real anisotropy = 0.4_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&SpinChain::n, "n", "", 2, 20, "number of spins"),
            parameter(&SpinChain::anisotropy, "anisotropy", "1/s", -5, 5,
                      "additional coupling of third components")};
  }
  [[nodiscard]] int dimension() const { return 3 * n; }
  [[nodiscard]] Spins bracket() const { return {n}; }

  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    T sum(0);
    const std::size_t size = z.size();
    for (std::size_t k = 0; k < size; k += 3) {
      const std::size_t next = (k + 3) % size;
      sum = sum - (z[k] * z[next] + z[k + 1] * z[next + 1] + (1 + anisotropy) * z[k + 2] * z[next + 2]);
    }
    return sum;
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    for (std::size_t k = 0; k < z.size(); ++k) reversed[k] = -z[k];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    for (std::size_t a = 0; a < 3; ++a) {
      values[1 + a] = T(0);
      for (std::size_t k = a; k < z.size(); k += 3) values[1 + a] = values[1 + a] + z[k];
    }
    values[4] = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    const Behaviour across = anisotropy.is(0) ? Behaviour::conserved : Behaviour::free;
    return {conserved_quadratic("energy", "1/s"),
            {"spin-1", "", across, false},
            {"spin-2", "", across, false},
            conserved("spin-3", ""),
            conserved_quadratic("first-length", "")};
  }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> list;
    for (int k = 1; k <= n; ++k)
      for (int a = 1; a <= 3; ++a) list.push_back({"s" + std::to_string(k) + "_" + std::to_string(a), ""});
    return list;
  }
  template <class T>
  void initial(Out<T> z) const {
    for (std::size_t k = 0; k < z.size(); k += 3) {
      const T angle = T(static_cast<int>(k)) / 2;
      z[k] = cos(angle) * T(0.8_r);
      z[k + 1] = sin(angle) * T(0.8_r);
      z[k + 2] = T(k % 2 == 0 ? 0.6_r : Real(-0.6_r));
    }
  }
};

const System<SpinChain> registered{{.name = "spin-chain",
                                    .title = "closed chain of classical spins, s_k' = s_k x dH/ds_k",
                                    .reference = "marsden-ratiu1999 10.1",
                                    .description = "A chain of spins on as many spheres, a Poisson system of "
                                                   "any size. Take it for methods that keep Casimirs."}};
}  // namespace
