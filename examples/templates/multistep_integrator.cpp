// <one line: the method>, the explicit method of Adams and Bashforth with three states:
//   z_{n+1} = z_n + h (23 X_n - 16 X_{n-1} + 5 X_{n-2})/12,   X_n = X(z_n, t_n).   Order 3, no structure
//   kept.
//
// Copy to integrators/<name>.cpp. Methods whose step is no more than such a sum need no C++: a table of the
// kind `multistep` has it (docs/tables.md). What else a method may say is in
// examples/templates/integrator.cpp.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/tables/multistep_history.hpp>

namespace {
using namespace pfaff;

struct AdamsBashforth {
  static constexpr bool fixed_sizes = false;  // nothing is gained from a dimension that the compiler knows
  // Of the rates, the oldest first.
  std::array<Quad, 3> weights{Quad(5) / Quad(12), Quad(-16) / Quad(12), Quad(23) / Quad(12)};
  Collocation<2> starter;  // makes the first steps, of order 4
  std::span<Quad> coefficients() { return weights; }

  template <class P>
  struct Work {
    std::vector<Scalar<P>> weights;
    MultistepHistory<Scalar<P>> rates;  // those of the last three states
    std::size_t known = 0;              // how many of them are there
    Continuation<P> continuation;       // where the last step ended
    State<P> sum, carry;
    pfaff::Work<Collocation<2>, P> starting;

    Work(const AdamsBashforth& method, const P& p)
        : rates(3, p.size()),
          continuation(p),
          sum(p.make_state()),
          carry(p.make_state()),
          starting(method.starter, p) {
      for (const Quad& weight : method.weights) weights.emplace_back(Real(weight));
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    // Where the state, the time or the step was changed from outside, what is kept is of another motion.
    if (!w.continuation.holds(t, h, z)) {
      w.known = 0;
      w.starting.restart();
      for (Scalar<P>& x : w.carry) x = Scalar<P>(0);
    }
    p.field(t, z, w.rates.next());  // in the place of the oldest
    w.known = std::min<std::size_t>(w.known + 1, 3);
    if (w.known < 3) {
      const Status status = starter.step(p, t, h, z, w.starting);
      if (status != Status::converged) {
        w.continuation.forget();
        return status;
      }
    } else {
      w.rates.weighted(w.weights, w.sum);
      for (std::size_t k = 0; k < z.size(); ++k) compensated_add(z[k], w.carry[k], h * w.sum[k]);
    }
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

const Method<AdamsBashforth> registered{
    {.name = "template-multistep-integrator",
     .title = "Adams-Bashforth method with three states",
     .family = "multistep",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description =
         "The explicit method of Adams and Bashforth with three states, the template of a method that "
         "remembers earlier steps. Say what it is and when to take it. Say where it ends, too.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
