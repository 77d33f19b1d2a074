// The simplified Dirac formulation: Dirac's with phi~ set to zero in the equations (nguyen-turski (4.7)),
//   q' = v,   p' = -H_q - B^T S^-1 h + friction.
// On the surface the motion is that of Dirac's formulation. Off it phi~ stays constant, phi grows linearly at
// the rate phi~, and H' = -phi~.S^-1 h.
#include <pfaff/formulations/ideal_reactions.hpp>

namespace {
using namespace pfaff;

struct SimplifiedDirac : WithFriction {
  SimplifiedDirac() : WithFriction(FrictionForm::metriplectic) {}
  static std::vector<Parameter> parameters() { return {friction_parameter<SimplifiedDirac>()}; }

  template <class T>
  struct Work {
    Work(const SimplifiedDirac& formulation, HolonomicConstraints<T>& constraints)
        : rates(formulation.friction(), constraints) {}
    IdealReactions<T> rates;
  };

  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    return w.rates(constraints, t, q, p, q_rate, p_rate);
  }
};

const Formulation<SimplifiedDirac> registered{
    {.name = "simplified-dirac",
     .title = "Dirac's equations with the hidden constraints set to zero in them",
     .reference = "nguyen-turski (4.7)",
     .description =
         "Dirac's equations with the hidden constraints set to zero in them, which leaves one solve with S "
         "instead of two. Take it with methods that stay on the constraints themselves, where it is the same "
         "motion as Dirac's at half the cost. Off the surface the hidden constraints stay what they are, the "
         "constraints of positions grow linearly with them, and the energy is not kept.",
     .reactions = Reactions::ideal,
     .keeps = {FormulationClaim::tangent, FormulationClaim::hidden_constraints}}};
}  // namespace
