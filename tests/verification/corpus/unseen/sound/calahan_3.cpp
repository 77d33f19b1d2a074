// Calahan's Rosenbrock method of order 3 with two stages and one matrix a step, A-stable:
//
//   (1 - h g J) k_1 = h X(z),   (1 - h g J) k_2 = h X(z + a k_1),   z' = z + b_1 k_1 + b_2 k_2,
//   g = (3 + sqrt 3)/6,  a = -2/sqrt 3,  b = (3/4, 1/4),  J the Jacobian of X at z.
//
// It is for fields that do not depend on time.
//
// Source: Calahan, A stable, accurate method of numerical integration for nonlinear systems, Proc. IEEE 56
// (1968) 744; Hairer, Wanner, Solving Ordinary Differential Equations II, IV.7.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/linear/lu.hpp>

namespace {
using namespace pfaff;

struct Calahan {
  static constexpr bool fixed_sizes = false;
  std::array<Quad, 4> numbers{(Quad(3) + sqrt(Quad(3))) / Quad(6), Quad(-2) / sqrt(Quad(3)),
                              Quad(3) / Quad(4), Quad(1) / Quad(4)};
  std::span<Quad> coefficients() { return numbers; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.autonomous() ? "" : "needs a field that does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T gamma, reach, first_weight, second_weight;
    LU<T> matrix;
    std::vector<T> jacobian;
    State<P> slope, point, first, second;
    Work(const Calahan& method, const P& p)
        : gamma(Real(method.numbers[0])),
          reach(Real(method.numbers[1])),
          first_weight(Real(method.numbers[2])),
          second_weight(Real(method.numbers[3])),
          matrix(p.size()),
          jacobian(p.size() * p.size()),
          slope(p.make_state()),
          point(p.make_state()),
          first(p.make_state()),
          second(p.make_state()) {}
  };

  template <HasVectorField P>
  requires HasFieldJacobian<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                           Work<P>& w)
  const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    p.field_jacobian(t, z, w.jacobian);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        w.matrix(i, j) = T(i == j ? 1 : 0) - h * w.gamma * w.jacobian[i * n + j];
    if (!w.matrix.factor()) return Status::singular;
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < n; ++k) w.slope[k] = h * w.slope[k];
    w.matrix.solve(w.slope.data(), w.first.data());
    for (std::size_t k = 0; k < n; ++k) w.point[k] = z[k] + w.reach * w.first[k];
    p.field(t, w.point, w.slope);
    for (std::size_t k = 0; k < n; ++k) w.slope[k] = h * w.slope[k];
    w.matrix.solve(w.slope.data(), w.second.data());
    for (std::size_t k = 0; k < n; ++k)
      z[k] = z[k] + (w.first_weight * w.first[k] + w.second_weight * w.second[k]);
    return Status::converged;
  }
};

const Method<Calahan> registered{{.name = "calahan-3",
                                  .title = "Calahan's Rosenbrock method of order 3",
                                  .reference = "hairer-norsett-wanner1993",
                                  .description = "A linearly implicit method with the exact Jacobian, for "
                                                 "stiff fields that do not depend on time. It keeps no "
                                                 "structure.",
                                  .order = 3,
                                  .preserves = {Claim::none}}};
}  // namespace
