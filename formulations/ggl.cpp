// The stabilised index-2 formulation of gear-leimkuhler-gupta1985, with its multipliers eliminated:
//   q' = v - P^T mu,   p' = F - B^T lambda,   phi' = 0 and phi~' = 0,
// so that mu = S^-1 phi~ and lambda = S^-1 (h - T P^T mu), with F = -H_q and the symbols of
// core/facets/holonomic.hpp; friction is added together with its own reaction. phi and phi~ are constant off
// the surface too, as in Dirac's formulation; the energy is not.
#include <pfaff/formulations/friction.hpp>

namespace {
using namespace pfaff;

struct StabilisedIndexTwo : WithFriction {
  StabilisedIndexTwo() : WithFriction(FrictionForm::stokes) {}
  static std::vector<Parameter> parameters() { return {friction_parameter<StabilisedIndexTwo>()}; }

  template <class T>
  struct Work {
    Work(const StabilisedIndexTwo& formulation, HolonomicConstraints<T>& constraints)
        : multipliers(constraints.count()),
          right(constraints.count()),
          by_momentum(constraints.degrees()),
          friction(formulation.friction(), constraints) {}
    std::vector<T> multipliers, right, by_momentum;
    Friction<T> friction;
  };

  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.hidden(), w.multipliers);
    constraints.hidden_by_momentum_transpose(w.multipliers, w.by_momentum);
    constraints.hidden_by_position(w.by_momentum, w.right);
    for (std::size_t k = 0; k < w.right.size(); ++k) w.right[k] = constraints.hidden_rates()[k] - w.right[k];
    constraints.solve(w.right, w.right);
    constraints.apply_transpose(w.right, p_rate);
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = constraints.velocities()[k] - w.by_momentum[k];
      p_rate[k] = constraints.forces()[k] - p_rate[k];
    }
    const Status rubbed = w.friction.add(constraints, p_rate);
    return status == Status::converged ? rubbed : status;
  }
};

const Formulation<StabilisedIndexTwo> registered{
    {.name = "ggl",
     .title = "Gear, Leimkuhler and Gupta's stabilised index 2: both constraint levels are kept",
     .reference = "gear-leimkuhler-gupta1985",
     .description =
         "The stabilised index-2 equations with their multipliers eliminated: a second set of multipliers "
         "moves positions along the masses' inverse times the constraint gradients. Take it with methods for "
         "vector fields that leave the constraints: the constraints and the hidden ones are both constant "
         "along the motion, off the surface too, as in Dirac's formulation. Unlike there the motion off the "
         "surface is not Hamiltonian, and the energy drifts with the distance from it.",
     .reactions = Reactions::two_level,
     .keeps = {FormulationClaim::tangent, FormulationClaim::hidden_constraints,
               FormulationClaim::constraints}}};
}  // namespace
