// Explicit Runge-Kutta methods from their tableaus. The classical method of order 4 keeps no structure; it is the
// control that structure tests must reject.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct RungeKutta4 {
  static constexpr std::size_t stages = 4;
  // Lower triangle of a, row by row, then b (hairer-norsett-wanner1993, II.1, table 1.2); c_i is the row sum.
  std::array<Quad, 10> tableau{Quad(1) / Quad(2), Quad(0), Quad(1) / Quad(2), Quad(0), Quad(0), Quad(1),
                               Quad(1) / Quad(6), Quad(1) / Quad(3), Quad(1) / Quad(3), Quad(1) / Quad(6)};
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&RungeKutta4::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return tableau; }

  template <class P> struct Work {
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
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const auto combined = [&](std::size_t first, std::size_t count, std::size_t k) {
      T sum = w.a[first] * w.rate[0][k];
      for (std::size_t j = 1; j < count; ++j) sum = sum + w.a[first + j] * w.rate[j][k];
      return h * sum;
    };
    p.field(t, z, w.rate[0]);
    for (std::size_t i = 1; i < stages; ++i) {
      for (std::size_t k = 0; k < n; ++k) w.point[k] = z[k] + combined(i * (i - 1) / 2, i, k);
      p.field(t + w.c[i] * h, w.point, w.rate[i]);
    }
    for (std::size_t k = 0; k < n; ++k)
      add_to(z[k], w.carry[k], combined(stages * (stages - 1) / 2, stages, k), compensated);
    return Status::converged;
  }
};

const Method<RungeKutta4> registered{{.name = "rk4",
                                      .title = "classical Runge-Kutta method of order 4",
                                      .reference = "hairer-norsett-wanner1993 II.1",
                                      .order = 4,
                                      .preserves = {Claim::none}}};
}  // namespace
