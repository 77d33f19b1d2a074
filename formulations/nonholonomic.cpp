// Nonholonomic motion, that of Lagrange and d'Alembert, of velocity constraints psi(q, p, t) = A(q, t) v +
// b(q, t) = 0. Symbols are those of core/facets/velocity_constraints.hpp.
//   q' = v = H_p,   p' = -H_q - A^T lambda,   S lambda = {psi, H} + psi_t,   S = A H_pp A^T
// The reactions A^T lambda do no work on admissible virtual velocities u, A u = 0. The multipliers make psi'
// = 0 wherever the state is, so that each psi is a first integral and its surface psi = 0 invariant. Along
// the motion H' = H_t + lambda.(b - psi): the energy is kept on the surface where nothing depends on time and
// b = 0. For H = p^T M^-1 p / 2 + V this is the projected equation of pitanga-rodrigues (24)-(25), completed
// by the differentiated constraint, on momenta p = M v.
//
// Holonomic constraints beside these move by the same equations: the rates phi~ = {phi, H} + phi_t are among
// the psi. Off the surface phi grows at the constant rate phi~.
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

struct Nonholonomic {
  static std::vector<Parameter> parameters() { return {}; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    if (model.frictionless() && !model.given(Formula::symmetric_tensor)) return {};
    return "formulation nonholonomic makes a motion without friction; " + model.name() + " has friction";
  }

  template <class T>
  struct Work {
    Work(const Nonholonomic& /*formulation*/, VelocityConstraints<T>& constraints)
        : multipliers(constraints.count()), rates(constraints.ideal_rates()) {}
    std::vector<T> multipliers;
    ConstrainedRates<T>* rates;  // the whole field as one operation, where there is one
  };

  template <class T>
  Status field(VelocityConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    if (w.rates != nullptr) return (*w.rates)(t, q, p, q_rate, p_rate);
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.rates(), w.multipliers);
    constraints.apply_transpose(w.multipliers, p_rate);
    const In<T> v = constraints.velocities(), f = constraints.forces();
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = v[k];
      p_rate[k] = f[k] - p_rate[k];
    }
    return status;
  }
};

const Formulation<Nonholonomic> registered{
    {.name = "nonholonomic",
     .title = "Lagrange and d'Alembert's motion of velocity constraints, by ideal reactions",
     .reference = "pitanga-rodrigues (24)-(25), (34)",
     .description =
         "The motion of bodies that roll or glide on blades: reactions along the constraints do no work on "
         "admissible velocities, and their multipliers are eliminated. Take it for velocity constraints, of "
         "which it is the mechanics; vakonomic motion is another one. Each constraint is a first integral, "
         "off "
         "the surface too, and the energy is kept on the surface where the constraints are homogeneous and "
         "nothing depends on time; the motion is not Hamiltonian in general.",
     .reactions = Reactions::ideal,
     .keeps = {FormulationClaim::tangent, FormulationClaim::velocity_constraints,
               FormulationClaim::energy_on_surface}}};
}  // namespace
