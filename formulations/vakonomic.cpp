// Vakonomic motion of velocity constraints A(q, t) v + b(q, t) = 0: the action is stationary among motions
// that keep the constraints, with momenta p = L_v + A^T lambda. It is that of the canonical Hamiltonian
//   H_vak(q, p, t) = max over v with A v + b = 0 of p.v - L(q, v, t).
// For H quadratic in p, with or without linear terms, psi = A H_p + b and S = A H_pp A^T,
//   H_vak = H - psi^T S^-1 psi / 2,   lambda = S^-1 psi.
// Its velocity is dH_vak/dp = H_p - H_pp A^T lambda, and A dH_vak/dp + b = psi - S lambda = 0 for every p:
// the momenta are not restricted, and lambda is a part of the state. Motions that start with lambda = 0,
// where p = L_v, are the nonholonomic ones only where the constraints are integrable; in general lambda
// becomes different from zero at once.
#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace {
using namespace pfaff;

struct Vakonomic {
  static std::vector<Parameter> parameters() { return {}; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    if (model.forced())
      return "formulation vakonomic makes the motion of a Hamiltonian; " + model.name() +
             " has applied forces";
    if (!model.frictionless() || model.given(Formula::symmetric_tensor))
      return "formulation vakonomic makes a motion without friction; " + model.name() + " has friction";
    if (!quadratic_in_momenta(model))
      return "formulation vakonomic needs a Hamiltonian that is quadratic in the momenta, of which it knows "
             "the "
             "constrained one in closed form; that of " +
             model.name() + " is not";
    return {};
  }

  [[nodiscard]] Tape hamiltonian_tape(const Model& model) const {
    const auto energy = model.tape(Formula::hamiltonian);
    const auto constraints = model.velocity_constraints<Recorded>();
    return record(model.dimension(), 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
      const std::size_t n = constraints->degrees();
      std::vector<Recorded> psi(constraints->count()), multipliers(constraints->count());
      constraints->values(t, z.first(n), z.subspan(n), psi);
      (void)constraints->linearise(t, z.first(n), z.subspan(n));  // fails for numbers only
      constraints->solve(psi, multipliers);
      Recorded excess(0);
      for (std::size_t k = 0; k < psi.size(); ++k) excess = excess + psi[k] * multipliers[k];
      out[0] = evaluate(*energy, t, z)[0] - excess / 2;
    });
  }
};

const Formulation<Vakonomic> registered{
    {.name = "vakonomic",
     .title = "Vakonomic motion of velocity constraints: stationary among admissible motions",
     .reference = "arnold-kozlov-neishtadt2006 section 1.4",
     .description =
         "The motion of the canonical Hamiltonian H - psi^T S^-1 psi / 2, whose action is stationary among "
         "the "
         "motions that keep A v + b = 0, as in optimal control and sub-Riemannian geometry. Take it for such "
         "problems and to see how it differs from nonholonomic motion, which is what bodies do that roll: "
         "the "
         "two agree where the constraints are integrable. Momenta are p = L_v + A^T lambda and are not "
         "restricted, so that every method for Hamiltonian systems fits; H must be quadratic in the momenta.",
     .keeps = {FormulationClaim::admissible}}};
}  // namespace
