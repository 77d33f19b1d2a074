// <one line: the method>, the explicit midpoint rule with a free node:
//   z' = z + h ((1 - b) X(z, t) + b X(z + c h X(z, t), t + c h)),  b = 1/(2 c).   Order 2, no structure kept.
//
// Copy to integrators/<name>.cpp. `step` is all there is to write; the concept on it (HasVectorField,
// HasSeparable, HasDarbouxChart, ...; core/facets/problem.hpp) says which systems the method runs on. Order
// and structure are claims that are tested on every system in their scope. Steps of several stages with less
// to write: z = z + ..., as in examples/plugin/ralston.cpp.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct TwoStage {  // parameters only: the object is shared between runs and never changes
  std::array<Quad, 2> tableau{Quad(1) / Quad(2), Quad(1)};  // c, b
  bool compensated = true;
  static std::vector<Parameter> parameters() {
    return {parameter(&TwoStage::compensated, "compensated", "compensated summation")};
  }
  // Optional: the numbers that define the method. A control changes one of them by 1e-6 and must be noticed.
  std::span<Quad> coefficients() { return tableau; }

  // Optional: buffers and history of one run. Nothing is allocated inside a step.
  template <class P>
  struct Work {
    Scalar<P> c, b;
    State<P> first, second, point, carry;
    Work(const TwoStage& method, const P& p)
        : c(Real(method.tableau[0])),
          b(Real(method.tableau[1])),
          first(p.make_state()),
          second(p.make_state()),
          point(p.make_state()),
          carry(p.make_state()) {}
  };

  // z at t becomes z at t + h, for every scalar: double, quad, and duals over both. An implicit method
  // iterates to the round-off of its scalar, never a fixed number of times, and returns how that ended:
  //   Convergence<Scalar<P>> convergence(Corrections::uneven);      // core/solve/convergence.hpp
  //   do {
  //     convergence.begin_iteration();
  //     ...                                                          // corrects w.next[k]
  //     convergence.add(correction, z[k], w.next[k]);                // of each component
  //   } while (!convergence.finished(100));
  //   return convergence.status();
  // With a Jacobian: core/solve/newton.hpp.
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.first);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.c * w.first[k];
    p.field(t + w.c * h, w.point, w.second);
    for (std::size_t k = 0; k < z.size(); ++k)
      add_to(z[k], w.carry[k], h * (w.first[k] + w.b * (w.second[k] - w.first[k])), compensated);
    return Status::converged;
  }
};

const Method<TwoStage> registered{
    {.name = "template-integrator",
     .title = "explicit midpoint rule",
     .reference = "hairer-norsett-wanner1993 II.1",
     .description = "The explicit midpoint rule with a free node, the template of an integrator. Say what it "
                    "is and when to take it. Say where it ends, too.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
