// Calahan's Rosenbrock method of order 3 with two stages, A-stable, which saves Jacobians: one is kept for
// four steps, as long as the step is of the same length and nobody else has touched the state.
//
//   (1 - h g J) k_1 = h X(z),   (1 - h g J) k_2 = h X(z + a k_1),   z' = z + 3/4 k_1 + 1/4 k_2
//
// with g = (3 + sqrt 3)/6 and a = -2/sqrt 3.
//
// It is for fields that do not depend on time.
//
// Source: Calahan, A stable, accurate method of numerical integration for nonlinear systems, Proc. IEEE 56
// (1968) 744; Steihaug, Wolfbrandt, Math. Comp. 33 (1979) 521.
//
// False: the order. The conditions of order 3 use that J is the Jacobian at the beginning of the step. The
// first step has it; from the second on it is wrong by a multiple of the step, and the order is 2.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/linear/lu.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace {
using namespace pfaff;

struct ThriftyRosenbrock {
  static constexpr bool fixed_sizes = false;
  static constexpr int kept_for = 4;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.autonomous() ? "" : "needs a field that does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T gamma, reach;
    LU<T> matrix;
    std::vector<T> jacobian;
    State<P> slope, point, first, second;
    int age = 0;
    Continuation<P> continuation;
    Work(const ThriftyRosenbrock& /*method*/, const P& p)
        : gamma((T(3) + sqrt(T(3))) / T(6)),
          reach(T(-2) / sqrt(T(3))),
          matrix(p.size()),
          jacobian(p.size() * p.size()),
          slope(p.make_state()),
          point(p.make_state()),
          first(p.make_state()),
          second(p.make_state()),
          continuation(p) {}
  };

  template <HasVectorField P>
  requires HasFieldJacobian<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                           Work<P>& w)
  const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    if (!w.continuation.holds(t, h, z) || w.age == kept_for) {
      p.field_jacobian(t, z, w.jacobian);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          w.matrix(i, j) = T(i == j ? 1 : 0) - h * w.gamma * w.jacobian[i * n + j];
      w.continuation.forget();
      if (!w.matrix.factor()) return Status::singular;
      w.age = 0;
    }
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < n; ++k) w.slope[k] = h * w.slope[k];
    w.matrix.solve(w.slope.data(), w.first.data());
    for (std::size_t k = 0; k < n; ++k) w.point[k] = z[k] + w.reach * w.first[k];
    p.field(t, w.point, w.slope);
    for (std::size_t k = 0; k < n; ++k) w.slope[k] = h * w.slope[k];
    w.matrix.solve(w.slope.data(), w.second.data());
    for (std::size_t k = 0; k < n; ++k) z[k] = z[k] + (T(3) * w.first[k] + w.second[k]) / T(4);
    ++w.age;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

const Method<ThriftyRosenbrock> registered{
    {.name = "thrifty-rosenbrock",
     .title = "Calahan's Rosenbrock method with a Jacobian for every four steps",
     .reference = "hairer-norsett-wanner1993",
     .description = "A linearly implicit method for stiff fields that do not depend on time, with one "
                    "factorisation for four steps. It "
                    "keeps no structure.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
