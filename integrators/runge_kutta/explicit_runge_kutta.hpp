// Explicit Runge-Kutta methods from their tableaus. The classical method of order 4 keeps no structure; it is
// the control that structure tests must reject.
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

/// The classical method of order 4.
struct RungeKutta4 {
  static constexpr std::size_t stages = 4;
  // Lower triangle of a, row by row, then b (hairer-norsett-wanner1993, II.1, table 1.2); c_i is the row sum.
  std::array<Quad, 10> tableau{Quad(1) / Quad(2), Quad(0),          Quad(1) / Quad(2), Quad(0),
                               Quad(0),           Quad(1),          Quad(1) / Quad(6), Quad(1) / Quad(3),
                               Quad(1) / Quad(3), Quad(1) / Quad(6)};
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&RungeKutta4::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return tableau; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::array<T, 10> a;
    std::array<T, stages> c{};
    std::array<State<P>, stages> rate;
    State<P> point, carry;
    Work(const RungeKutta4& method, const P& p) : point(p.make_state()), carry(p.make_state()) {
      for (std::size_t k = 0; k < a.size(); ++k) a[k] = T(Real(method.tableau[k]));
      for (std::size_t i = 1; i < stages; ++i)
        for (std::size_t j = 0; j < i; ++j) c[i] = c[i] + a[i * (i - 1) / 2 + j];
      for (State<P>& r : rate) r = p.make_state();
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    evaluate_all(Row<stages>(), p, t, h, z, w);
    for (std::size_t k = 0; k < z.size(); ++k)
      add_to(z[k], w.carry[k], combined(Row<stages>(), Scalar<P>(0), h, w, k), compensated);
    return Status::converged;
  }

 private:
  // Everything is unrolled by hand: with constant indices the compiler keeps the stages in registers.
  template <std::size_t I>
  using Row = std::make_index_sequence<I>;

  template <std::size_t... I, class P>
  static void evaluate_all(std::index_sequence<I...>, const P& p, const Scalar<P>& t, const Scalar<P>& h,
                           const State<P>& z, Work<P>& w) {
    (evaluate<I>(p, t, h, z, w), ...);
  }

  // rate_i = X(z + h sum_j a_ij rate_j, t + c_i h)
  template <std::size_t I, class P>
  static void evaluate(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    if constexpr (I == 0) {
      p.field(t, z, w.rate[0]);
    } else {
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = combined(Row<I>(), z[k], h, w, k);
      p.field(t + w.c[I] * h, w.point, w.rate[I]);
    }
  }

  // start + h sum_j a_ij rate_j, component k; row `stages` of a is b. The latest rate is added last, so that
  // the sum of the others need not wait for it.
  template <std::size_t... J, class W, class T>
  static T combined(std::index_sequence<J...>, const T& start, const T& h, const W& w, std::size_t k) {
    constexpr std::size_t i = sizeof...(J);
    return (start + ... + (h * w.a[i * (i - 1) / 2 + J] * w.rate[J][k]));
  }
};

}  // namespace pfaff
