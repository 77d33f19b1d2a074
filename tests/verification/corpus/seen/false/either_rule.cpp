// The implicit midpoint rule or, as its parameter says, the trapezoidal rule, both of order 2 and symmetric.
// Their equations are solved by iteration of fixed points.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.4 and VI.8.
//
// False: the trapezoidal rule is conjugate to a symplectic map and none itself; the claim is made of both.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct EitherRule {
  std::string kind = "midpoint";
  static std::vector<Parameter> parameters() {
    return {parameter(&EitherRule::kind, "kind", {"midpoint", "trapezoid"}, "which of the two rules")};
  }

  template <class P>
  struct Work {
    State<P> start, point, rate, first;
    Work(const EitherRule& /*method*/, const P& p)
        : start(p.make_state()), point(p.make_state()), rate(p.make_state()), first(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const bool midpoint = kind == "midpoint";
    w.start = z;
    p.field(t, z, w.first);
    for (int sweep = 0; sweep < 200; ++sweep) {
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = midpoint ? (w.start[k] + z[k]) / T(2) : z[k];
      p.field(midpoint ? t + h / T(2) : t + h, w.point, w.rate);
      bool still = true;
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T next = w.start[k] + h * (midpoint ? w.rate[k] : (w.first[k] + w.rate[k]) / T(2));
        still = still && value_of(next) == value_of(z[k]);
        z[k] = next;
      }
      if (still && sweep > 3) return Status::converged;
    }
    return Status::converged;
  }
};

const Method<EitherRule> registered{
    {.name = "either-rule",
     .title = "midpoint or trapezoidal rule",
     .reference = "hairer-lubich-wanner2006 VI.4",
     .description =
         "One of two symmetric rules of order 2, as its parameter says. Take it to compare the two.",
     .order = 2,
     .preserves = {Claim::symplectic, Claim::symmetric}}};
}  // namespace
