// Explicit splitting methods for H = T(p, t) + V(q, t): alternating drifts q += d h T_p and kicks p += k h
// (-V_q).
//
// Stoermer-Verlet in its position form (drift h/2, kick h, drift h/2; hairer-lubich-wanner2006 (I.1.17)):
// order 2, symplectic, symmetric, one force a step, no force kept between steps. Symplectic Euler (kick,
// drift; (I.1.9)): order 1, symplectic.
//
// Time is split as the state is. A drift moves the positions and with them the time s of the potential, a
// kick the momenta and with them the time u of the kinetic energy:
//
//   (q, s)' = (T_p(p, u), 1),   (p, u)' = (-V_q(q, s), 1)
//
// are two fields, each of which is constant along its own flow, and their sum is the motion wherever s = u =
// t. Every splitting so has its order, its symmetry and its structure on energies that depend on time, but
// for those that are made for T quadratic in p: u is one more momentum, in which T is not quadratic.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>

namespace pfaff {

/// Which part of H acts first.
enum class Part { drift, kick };

/// N drifts and kicks in turn, with their lengths in units of the step as coefficients.
template <Part First, std::size_t N>
struct Splitting {
  std::array<Quad, N> coefficient;
  bool compensated = true;

  std::span<Quad> coefficients() { return coefficient; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::array<T, N> a;
    State<P> carry, slope;
    Work(const Splitting& method, const P& p) : carry(p.make_state()), slope(p.make_state()) {
      for (std::size_t k = 0; k < N; ++k) a[k] = T(Real(method.coefficient[k]));
    }
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    act_all(std::make_index_sequence<N>(), p, t, h, z, w);
    return Status::converged;
  }

 private:
  // Unrolled by hand: with constant offsets the compiler keeps state and carries in registers.
  template <std::size_t... K, class P>
  void act_all(std::index_sequence<K...>, const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
               Work<P>& w) const {
    Scalar<P> drifted = t, kicked = t;
    (act<K>(p, drifted, kicked, w.a[K] * h, z, w), ...);
  }

  template <std::size_t K, class P>
  void act(const P& p, Scalar<P>& drifted, Scalar<P>& kicked, const Scalar<P>& length, State<P>& z,
           Work<P>& w) const {
    using T = Scalar<P>;
    constexpr bool drift = (K % 2 == 0) == (First == Part::drift);
    const std::size_t half = z.size() / 2;
    const Out<T> q(z.data(), half), momentum(z.data() + half, half), slope(w.slope.data(), half);
    if constexpr (drift) {
      p.velocity(kicked, momentum, slope);
      drifted = drifted + length;
    } else {
      p.force(drifted, q, slope);
      kicked = kicked + length;
    }
    const std::size_t offset = drift ? 0 : half;
    for (std::size_t i = 0; i < half; ++i)
      add_to(z[offset + i], w.carry[offset + i], length * slope[i], compensated);
  }
};

/// Stoermer-Verlet.
struct Verlet : Splitting<Part::drift, 3> {
  Verlet() : Splitting{{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)}} {}
  static std::vector<Parameter> parameters() {
    return {
        parameter(static_cast<bool Verlet::*>(&Verlet::compensated), "compensated", "compensated summation")};
  }
};

/// Symplectic Euler.
struct SymplecticEuler : Splitting<Part::kick, 2> {
  SymplecticEuler() : Splitting{{Quad(1), Quad(1)}} {}
  static std::vector<Parameter> parameters() {
    return {parameter(static_cast<bool SymplecticEuler::*>(&SymplecticEuler::compensated), "compensated",
                      "compensated summation")};
  }
};

}  // namespace pfaff
