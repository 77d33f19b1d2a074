// The simplified Dirac formulation: Dirac's with phi~ set to zero in the equations (nguyen-turski (4.7)),
//   q' = v,   p' = -H_q - B^T S^-1 h + friction.
// The same motion on the surface. Off it phi~ stays what it is, phi grows linearly with it, and H' =
// -phi~.S^-1 h.
#include <pfaff/brackets/formulations/friction.hpp>
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

struct SimplifiedDirac {
  std::string friction_form = "metriplectic";
  static std::vector<Parameter> parameters() {
    return {parameter(&SimplifiedDirac::friction_form, "friction-form", friction_forms(),
                      "the symmetric Dirac bracket, Stokes drag with ideal constraint forces, or none")};
  }

  template <class T>
  struct Work {
    Work(std::size_t n, std::size_t count) : multipliers(count), friction(n, count) {}
    std::vector<T> multipliers;
    FrictionWork<T> friction;
  };

  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    if (is_frictionless(constraints, friction_form))
      if (const auto done = constraints.multiplier_rates(t, q, p, q_rate, p_rate)) return *done;
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.hidden_rates(), w.multipliers);
    constraints.apply_transpose(w.multipliers, p_rate);
    const In<T> v = constraints.velocities(), f = constraints.forces();
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = v[k];
      p_rate[k] = f[k] - p_rate[k];
    }
    const Status rubbed = add_friction<T>(constraints, friction_form, p_rate, w.friction);
    return status == Status::converged ? rubbed : status;
  }
};

const Formulation<SimplifiedDirac> registered{
    {.name = "simplified-dirac",
     .title = "Dirac's equations with the hidden constraints set to zero in them",
     .reference = "nguyen-turski (4.7)"}};
}  // namespace
