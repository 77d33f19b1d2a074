// The theta method in its form of one stage, z' = z + h X((1 - theta) z + theta z', t + theta h): Euler's
// methods at theta = 0 and 1, of order 1, and the implicit midpoint rule at 1/2, of order 2. What is
// claimed depends on theta.
//
// Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.3; Hairer, Lubich, Wanner, II.1.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct ThetaMethod {
  static constexpr bool fixed_sizes = false;
  Real theta = Real::fraction(1, 2);
  static std::vector<Parameter> parameters() {
    return {parameter(&ThetaMethod::theta, "theta", "", 0, 1, "place of the stage between the two states")};
  }
  static std::vector<Assignments> instances(bool /*full*/) {
    return {{{"theta", "1/2"}}, {{"theta", "0.6"}}, {{"theta", "1"}}};
  }
  [[nodiscard]] bool central() const { return theta == Real::fraction(1, 2); }
  [[nodiscard]] int order(const Model& /*model*/) const { return central() ? 2 : 1; }
  [[nodiscard]] std::vector<Claim> preserves(const Model& /*model*/) const {
    if (!central()) return {Claim::none};
    return {Claim::symplectic, Claim::symmetric, Claim::reversible, Claim::quadratic_invariants};
  }

  template <class P>
  struct Work {
    State<P> next, stage, rate;
    Scalar<P> theta;
    Work(const ThetaMethod& method, const P& p)
        : next(p.make_state()), stage(p.make_state()), rate(p.make_state()), theta(method.theta) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < z.size(); ++k) w.stage[k] = z[k] + w.theta * (w.next[k] - z[k]);
      p.field(t + w.theta * h, w.stage, w.rate);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T corrected = z[k] + h * w.rate[k];
        convergence.add(corrected - w.next[k], z[k], corrected);
        w.next[k] = corrected;
      }
    } while (!convergence.finished(200));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return convergence.status();
  }
};

const Method<ThetaMethod> registered{
    {.name = "theta-method",
     .title = "theta method of one stage",
     .reference = "hairer-lubich-wanner2006 II.1",
     .description = "From Euler's explicit method over the midpoint rule to Euler's implicit one. Take it to "
                    "see what a parameter does to order and structure."}};
}  // namespace
