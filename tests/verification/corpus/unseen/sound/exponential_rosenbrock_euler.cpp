// The exponential method of Rosenbrock and Euler, z' = z + h phi(h J) X(z) with phi(x) = (e^x - 1)/x and the
// Jacobian J at z: of order 2, and exact where the field is linear. It is for fields that do not depend on
// time.
//
// phi(h J) h X is summed as the power series sum (h J)^k h X/(k + 1)!, which is refused where sixty terms do
// not suffice.
//
// Source: Pope, An exponential method of numerical integration of ordinary differential equations, Comm. ACM
// 6 (1963) 491; Hochbruck, Ostermann, Exponential integrators, Acta Numerica 19 (2010) 209.
#include <limits>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct ExponentialRosenbrockEuler {
  static constexpr bool fixed_sizes = false;
  static constexpr int terms = 60;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.autonomous() ? "" : "needs a field that does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> jacobian;
    State<P> term, next, change;
    Work(const ExponentialRosenbrockEuler& /*method*/, const P& p)
        : jacobian(p.size() * p.size()), term(p.make_state()), next(p.make_state()), change(p.make_state()) {}
  };

  template <HasVectorField P>
  requires HasFieldJacobian<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                           Work<P>& w)
  const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    p.field_jacobian(t, z, w.jacobian);
    p.field(t, z, w.term);
    for (std::size_t i = 0; i < n; ++i) {
      w.term[i] = h * w.term[i];
      w.change[i] = w.term[i];
    }
    for (int k = 1; k <= terms; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        T sum(0);
        for (std::size_t j = 0; j < n; ++j) sum = sum + w.jacobian[i * n + j] * w.term[j];
        w.next[i] = h * sum / T(k + 1);
      }
      for (std::size_t i = 0; i < n; ++i) {
        w.term[i] = w.next[i];
        w.change[i] = w.change[i] + w.term[i];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto left = abs(value_of(w.term[i])), size = abs(value_of(z[i])) + abs(value_of(w.change[i]));
      if (!isfinite(left)) return Status::non_finite;
      if (left > unit_roundoff<T>() * size) return Status::not_converged;
    }
    for (std::size_t i = 0; i < n; ++i) z[i] = z[i] + w.change[i];
    return Status::converged;
  }
};

const Method<ExponentialRosenbrockEuler> registered{
    {.name = "exponential-rosenbrock-euler",
     .title = "exponential method of Rosenbrock and Euler, z' = z + h phi(h J) X(z)",
     .reference = "hairer-lubich-wanner2006",
     .description = "An explicit exponential method of order 2, exact for linear fields with constant "
                    "coefficients. It keeps no "
                    "structure of nonlinear ones.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
