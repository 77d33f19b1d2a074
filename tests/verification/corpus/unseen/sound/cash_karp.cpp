// The explicit pair of Cash and Karp of orders 5 and 4 with six stages, which with a tolerance chooses its
// steps. It goes on with the result of order 5 and takes the difference of the two for the error.
//
// Source: Cash, Karp, A variable order Runge-Kutta method for initial value problems with rapidly varying
// right-hand sides, ACM Trans. Math. Softw. 16 (1990) 201.
#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

// Problems in double or quad, not in numbers with derivatives, from which no step size can be chosen.
template <class P>
concept HasPlainField = HasVectorField<P> && std::is_same_v<Scalar<P>, Value<Scalar<P>>>;

Quad part(int numerator, int denominator) { return Quad(numerator) / Quad(denominator); }

struct CashKarp {
  static constexpr bool fixed_sizes = false;
  static constexpr std::size_t stages = 6;
  // The rows of a, each with as many numbers as stages before it, then the weights of order 5.
  std::array<Quad, 21> tableau{part(1, 5),       part(3, 40),         part(9, 40),       part(3, 10),
                               part(-9, 10),     part(6, 5),          part(-11, 54),     part(5, 2),
                               part(-70, 27),    part(35, 27),        part(1631, 55296), part(175, 512),
                               part(575, 13824), part(44275, 110592), part(253, 4096),   part(37, 378),
                               Quad(0),          part(250, 621),      part(125, 594),    Quad(0),
                               part(512, 1771)};
  std::span<Quad> coefficients() { return tableau; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::array<std::array<T, stages>, stages> a{};
    std::array<T, stages> b{}, difference{}, c{};
    std::array<State<P>, stages> rate;
    State<P> point, change, error, carry;
    CoordinateScales<P> scales;
    T next_step{0};

    Work(const CashKarp& method, const P& p)
        : point(p.make_state()),
          change(p.make_state()),
          error(p.make_state()),
          carry(p.make_state()),
          scales(p) {
      std::size_t next = 0;
      for (std::size_t i = 1; i < stages; ++i)
        for (std::size_t j = 0; j < i; ++j) {
          a[i][j] = T(Real(method.tableau[next++]));
          c[i] = c[i] + a[i][j];
        }
      const std::array<Quad, stages> embedded{part(2825, 27648),  Quad(0),          part(18575, 48384),
                                              part(13525, 55296), part(277, 14336), part(1, 4)};
      for (std::size_t i = 0; i < stages; ++i) {
        b[i] = T(Real(method.tableau[next]));
        difference[i] = T(Real(Quad(method.tableau[next++] - embedded[i])));
      }
      for (State<P>& r : rate) r = p.make_state();
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.rate[0]);
    evaluate(p, t, h, z, w);
    for (std::size_t k = 0; k < z.size(); ++k) compensated_add(z[k], w.carry[k], w.change[k]);
    return Status::converged;
  }

  template <HasPlainField P>
  Status advance_to(const P& p, Scalar<P>& t, const Scalar<P>& end, const Tolerance<Scalar<P>>& tolerance,
                    State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!(tolerance.relative >= std::numeric_limits<T>::epsilon())) return Status::not_converged;
    detail::AllowedSteps<P> steps(p);
    int rejections = 0;
    while (t != end) {
      if (rejections == 0) {
        if (steps.next(1) == 0) break;
        p.field(t, z, w.rate[0]);
      }
      if (w.next_step == T(0)) w.next_step = w.scales.first_step(p, tolerance, t, end, z, w.rate[0]);
      const bool last = abs(end - t) <= w.next_step;
      const T after = last ? end : end < t ? T(t - w.next_step) : T(t + w.next_step);
      const T h = after - t;
      if (h == T(0) || rejections > 100) return Status::not_converged;
      evaluate(p, t, h, z, w);
      for (std::size_t k = 0; k < z.size(); ++k) {
        w.error[k] = T(0);
        for (std::size_t i = 0; i < stages; ++i) w.error[k] = w.error[k] + h * w.difference[i] * w.rate[i][k];
        w.point[k] = z[k] + w.change[k];
      }
      w.scales.find(tolerance, z, w.rate[0], h, w.point);
      const double error = w.scales.judge(tolerance, w.error);
      const double factor =
          std::isfinite(error) ? std::clamp(0.9 * std::pow(std::max(error, 1e-30), -0.2), 0.2, 4.0) : 0.1;
      if (!(error <= 1)) {
        w.next_step = T(std::min(factor, 0.9)) * abs(h);
        if (++rejections < rejections_in_doubt) w.scales.find_noise(p, t, z, w.rate[0]);
        continue;
      }
      w.scales.keep();
      for (std::size_t k = 0; k < z.size(); ++k) compensated_add(z[k], w.carry[k], w.change[k]);
      t = after;
      const T proposed = T(rejections > 0 ? std::min(factor, 1.0) : factor) * abs(h);
      if (!last || proposed > w.next_step) w.next_step = proposed;
      rejections = 0;
      ++p.counters().steps;
    }
    return Status::converged;
  }

 private:
  // The rates of the stages from the second on, and the change of order 5.
  template <class P>
  static void evaluate(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    for (std::size_t i = 1; i < stages; ++i) {
      for (std::size_t k = 0; k < z.size(); ++k) {
        Scalar<P> sum = w.a[i][0] * w.rate[0][k];
        for (std::size_t j = 1; j < i; ++j) sum = sum + w.a[i][j] * w.rate[j][k];
        w.point[k] = z[k] + h * sum;
      }
      p.field(t + w.c[i] * h, w.point, w.rate[i]);
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      Scalar<P> sum = w.b[0] * w.rate[0][k];
      for (std::size_t i = 1; i < stages; ++i) sum = sum + w.b[i] * w.rate[i][k];
      w.change[k] = h * sum;
    }
  }
};

const Method<CashKarp> registered{{.name = "cash-karp",
                                   .title = "explicit pair of Cash and Karp of orders 5 and 4",
                                   .reference = "hairer-norsett-wanner1993 II.5",
                                   .description = "An explicit method of order 5 that chooses its steps "
                                                  "where a tolerance is given. It keeps no structure.",
                                   .order = 5,
                                   .preserves = {Claim::none}}};
}  // namespace
