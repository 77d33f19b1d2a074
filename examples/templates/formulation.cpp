// <one line: the formulation>, Lagrange's multipliers with hidden constraints that decay at a rate gamma:
//
//   q' = v,   p' = -H_q - B^T lambda,   S lambda = h + gamma phi~,   so that phi~' = -gamma phi~
//
// with B = dphi/dq, S = B H_pp B^T and h the rate of phi~ without reactions (core/facets/holonomic.hpp).
//
// Copy to formulations/<name>.cpp. `field` is all there is to write, and `Work` where it needs numbers of its
// own. What the descriptor says, along which vectors the reactions point and what is kept where, is tested on
// every system with constraints; its values are listed in core/formulation_statement.hpp (FormulationClaim)
// and core/facets/holonomic.hpp (Reactions). Friction as in the others: derive from WithFriction
// (formulations/friction.hpp).
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

struct DecayingConstraints {  // parameters only: the object is shared between runs and never changes
  Real gamma = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&DecayingConstraints::gamma, "gamma", "1/time", 0, 1e6, "decay of hidden constraints")};
  }

  // Buffers of one run, made with the constraints they are for. Nothing is allocated inside a step.
  template <class T>
  struct Work {
    Work(const DecayingConstraints& formulation, HolonomicConstraints<T>& constraints)
        : rate(formulation.gamma), multipliers(constraints.count()) {}
    T rate;
    std::vector<T> multipliers;
  };

  // (q', p') at (q, p, t), for every scalar: double, quad, duals over both, and the one that records.
  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    const Status status = constraints.place(t, q, p);
    const In<T> h = constraints.hidden_rates(), hidden = constraints.hidden();
    for (std::size_t k = 0; k < h.size(); ++k) w.multipliers[k] = h[k] + w.rate * hidden[k];
    constraints.solve(w.multipliers, w.multipliers);
    constraints.apply_transpose(w.multipliers, p_rate);
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = constraints.velocities()[k];
      p_rate[k] = constraints.forces()[k] - p_rate[k];
    }
    return status;
  }
};

const Formulation<DecayingConstraints> registered{
    {.name = "template-formulation",
     .title = "Lagrange's multipliers with hidden constraints that decay",
     .reference = "baumgarte1972",
     .description =
         "Lagrange's multipliers with hidden constraints that decay exponentially, the template of a "
         "formulation. Say what it is and when to take it. Say where it ends, too.",
     .reactions = Reactions::ideal,
     .keeps = {FormulationClaim::tangent}}};
}  // namespace
