// The stabilised index-2 formulation of gear-leimkuhler-gupta1985, with its multipliers eliminated:
//   q' = v - P^T mu,   p' = F - B^T lambda,   phi' = 0 and phi~' = 0,
// so that mu = S^-1 phi~ and lambda = S^-1 (h - T P^T mu). phi and phi~ are kept off the surface too, as in
// Dirac's formulation; the energy is not.
#include <pfaff/brackets/formulations/friction.hpp>
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

struct StabilisedIndexTwo {
  std::string friction_form = "stokes";
  static std::vector<Parameter> parameters() {
    return {parameter(&StabilisedIndexTwo::friction_form, "friction-form", friction_forms(),
                      "the symmetric Dirac bracket, Stokes drag with ideal constraint forces, or none")};
  }

  template <class T>
  struct Work {
    Work(std::size_t n, std::size_t count)
        : multipliers(count), right(count), by_momentum(n), friction(n, count) {}
    std::vector<T> multipliers, right, by_momentum;
    FrictionWork<T> friction;
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
    const Status rubbed = add_friction<T>(constraints, friction_form, p_rate, w.friction);
    return status == Status::converged ? rubbed : status;
  }
};

const Formulation<StabilisedIndexTwo> registered{
    {.name = "ggl",
     .title = "Gear, Leimkuhler and Gupta's stabilised index 2: both constraint levels are kept",
     .reference = "gear-leimkuhler-gupta1985"}};
}  // namespace
