// Rosenbrock's method ROS2 of two stages, which keeps order 2 whatever matrix A it solves with. Here A is
// the Jacobian X_z at the beginning of the step, and X_t is left out, as order 2 does not need it:
//
//   (I - gamma h A) k1 = X(z, t),  (I - gamma h A) k2 = X(z + h k1, t + h) - 2 k1,
//   z' = z + h (3 k1 + k2)/2
//
// Source: Verwer, Spee, Blom, Hundsdorfer, SIAM J. Sci. Comput. 20 (1999) 1456; Hairer, Wanner, Solving
// Ordinary Differential Equations II, IV.7.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/linear/lu.hpp>

namespace {
using namespace pfaff;

struct RosenbrockW {
  static constexpr bool fixed_sizes = false;
  Real gamma = Real::fraction(3, 10);
  static std::vector<Parameter> parameters() {
    return {parameter(&RosenbrockW::gamma, "gamma", "", 0.25, 2, "the method is A-stable from 1/4 on")};
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    LU<T> matrix;
    std::vector<T> jacobian;
    State<P> rate, first, second, point;
    T gamma;
    Work(const RosenbrockW& method, const P& p)
        : matrix(p.size()),
          jacobian(p.size() * p.size()),
          rate(p.make_state()),
          first(p.make_state()),
          second(p.make_state()),
          point(p.make_state()),
          gamma(method.gamma) {}
  };

  template <HasFieldJacobian P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    p.field_jacobian(t, z, w.jacobian);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        w.matrix(i, j) = T(i == j ? 1 : 0) - w.gamma * h * w.jacobian[i * n + j];
    if (!w.matrix.factor()) return Status::not_converged;
    p.field(t, z, w.rate);
    w.matrix.solve(w.rate.data(), w.first.data());
    for (std::size_t k = 0; k < n; ++k) w.point[k] = z[k] + h * w.first[k];
    p.field(t + h, w.point, w.rate);
    for (std::size_t k = 0; k < n; ++k) w.rate[k] = w.rate[k] - T(2) * w.first[k];
    w.matrix.solve(w.rate.data(), w.second.data());
    for (std::size_t k = 0; k < n; ++k) z[k] = z[k] + h * (T(3) * w.first[k] + w.second[k]) / T(2);
    return Status::converged;
  }
};

const Method<RosenbrockW> registered{
    {.name = "rosenbrock-w",
     .title = "Rosenbrock's method ROS2, order 2 with any matrix",
     .reference = "hairer-norsett-wanner1993",
     .description = "A linearly implicit method of two stages. Take it where motion decays fast, since no "
                    "iteration has to converge. It keeps no structure.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
