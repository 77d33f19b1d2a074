// Nystroem's method of order 4 with three forces a step, for energies that are quadratic in the momenta, H =
// p^T M^-1 p/2 + V(q, t):
//
//   q_2 = q + h/2 M^-1 (p + h/4 F_1),   q_3 = q + h M^-1 (p + h/2 F_2),
//   q' = q + h M^-1 (p + h/6 (F_1 + 2 F_2)),   p' = p + h/6 (F_1 + 4 F_2 + F_3)
//
// with F_1 at (q, t), F_2 at (q_2, t + h/2) and F_3 at (q_3, t + h).
//
// Source: Nystroem, Acta Soc. Sci. Fenn. 50 (1925) 1; Hairer, Norsett, Wanner, Solving Ordinary Differential
// Equations I, II.14.
#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Nystroem {
  static constexpr bool fixed_sizes = false;
  // What stands before h and F in the positions, and the weights of the forces in p'.
  std::array<Quad, 7> numbers{Quad(1) / Quad(4), Quad(1) / Quad(2), Quad(1) / Quad(6), Quad(1) / Quad(3),
                              Quad(1) / Quad(6), Quad(2) / Quad(3), Quad(1) / Quad(6)};
  std::span<Quad> coefficients() { return numbers; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    return quadratic_in_momenta(model) && steady_kinetic_energy(model)
               ? ""
               : "needs a kinetic energy that is quadratic in the momenta and does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::array<T, 7> number;
    State<P> first, second, third, momentum, velocity, position;
    Work(const Nystroem& method, const P& p)
        : first(p.make_state()),
          second(p.make_state()),
          third(p.make_state()),
          momentum(p.make_state()),
          velocity(p.make_state()),
          position(p.make_state()) {
      for (std::size_t k = 0; k < number.size(); ++k) number[k] = T(Real(method.numbers[k]));
    }
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t m = z.size() / 2;
    const T half = h / T(2);
    p.force(t, In<T>(z.data(), m), Out<T>(w.first.data(), m));
    for (std::size_t k = 0; k < m; ++k) w.momentum[k] = z[m + k] + w.number[0] * h * w.first[k];
    move(p, t, half, z, w);
    p.force(t + half, In<T>(w.position.data(), m), Out<T>(w.second.data(), m));
    for (std::size_t k = 0; k < m; ++k) w.momentum[k] = z[m + k] + w.number[1] * h * w.second[k];
    move(p, t, h, z, w);
    p.force(t + h, In<T>(w.position.data(), m), Out<T>(w.third.data(), m));
    for (std::size_t k = 0; k < m; ++k)
      w.momentum[k] = z[m + k] + h * (w.number[2] * w.first[k] + w.number[3] * w.second[k]);
    move(p, t, h, z, w);
    for (std::size_t k = 0; k < m; ++k) {
      z[k] = w.position[k];
      z[m + k] =
          z[m + k] + h * (w.number[4] * w.first[k] + w.number[5] * w.second[k] + w.number[6] * w.third[k]);
    }
    return Status::converged;
  }

 private:
  // The position that is reached from z in the time `length` with the momentum of w.
  template <class P>
  static void move(const P& p, const Scalar<P>& t, const Scalar<P>& length, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t m = z.size() / 2;
    p.velocity(t, In<T>(w.momentum.data(), m), Out<T>(w.velocity.data(), m));
    for (std::size_t k = 0; k < m; ++k) w.position[k] = z[k] + length * w.velocity[k];
  }
};

const Method<Nystroem> registered{{.name = "nystroem-4",
                                   .title = "Nystroem's method of order 4 for q'' = a(q, t)",
                                   .reference = "hairer-norsett-wanner1993 II.14",
                                   .description = "An explicit method of order 4 with three forces a step, "
                                                  "for constant masses. It keeps no structure.",
                                   .order = 4,
                                   .preserves = {Claim::none}}};
}  // namespace
