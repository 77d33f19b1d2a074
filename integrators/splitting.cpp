// Explicit splitting methods for H = T(p) + V(q, t): alternating drifts q += d h T_p and kicks p += k h (-V_q).
//
// Stoermer-Verlet in its position form (drift h/2, kick h, drift h/2; hairer-lubich-wanner2006 (I.1.17)): order 2,
// symplectic, symmetric, one force a step, no force kept between steps. Symplectic Euler (kick, drift; (I.1.9)):
// order 1, symplectic. Forces of time-dependent potentials are taken at the time the drifts have reached.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

// Coefficients as data: drift, kick, drift, kick, … (a zero drift or kick is skipped).
template <std::size_t N> struct Splitting {
  std::array<Quad, N> coefficient;
  bool compensated = true;

  std::span<Quad> coefficients() { return coefficient; }

  template <class P> struct Work {
    using T = Scalar<P>;
    std::array<T, N> a;
    State<P> carry, slope;
    Work(const Splitting& method, const P& p) : carry(p.make_state()), slope(p.make_state()) {
      for (std::size_t k = 0; k < N; ++k) a[k] = T(Real(method.coefficient[k]));
    }
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t half = z.size() / 2;
    const In<T> q(z.data(), half), momentum(z.data() + half, half);
    const Out<T> slope(w.slope.data(), half);
    T time = t;
    for (std::size_t k = 0; k < N; ++k) {
      const bool drift = k % 2 == 0;
      if (coefficient[k] == Quad(0)) continue;
      const T length = w.a[k] * h;
      if (drift) {
        p.velocity(time, momentum, slope);
        time = time + length;
      } else {
        p.force(time, q, slope);
      }
      const std::size_t offset = drift ? 0 : half;
      for (std::size_t i = 0; i < half; ++i)
        add_to(z[offset + i], w.carry[offset + i], length * slope[i], compensated);
    }
    return Status::converged;
  }
};

struct Verlet : Splitting<3> {
  Verlet() : Splitting{{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)}} {}
  static std::vector<Parameter> parameters() {
    return {parameter(static_cast<bool Verlet::*>(&Verlet::compensated), "compensated", "compensated summation")};
  }
};

struct SymplecticEuler : Splitting<3> {
  SymplecticEuler() : Splitting{{Quad(0), Quad(1), Quad(1)}} {}
  static std::vector<Parameter> parameters() {
    return {parameter(static_cast<bool SymplecticEuler::*>(&SymplecticEuler::compensated), "compensated",
                      "compensated summation")};
  }
};

const Method<Verlet> verlet{{.name = "verlet",
                             .title = "Stoermer-Verlet, position form",
                             .reference = "hairer-lubich-wanner2006 (I.1.17)",
                             .order = 2,
                             .preserves = {Claim::symplectic, Claim::symmetric}}};
const Method<SymplecticEuler> symplectic_euler{{.name = "symplectic-euler",
                                                .title = "symplectic Euler: kick, then drift",
                                                .reference = "hairer-lubich-wanner2006 (I.1.9)",
                                                .order = 1,
                                                .preserves = {Claim::symplectic}}};
}  // namespace
