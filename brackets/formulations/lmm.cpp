// Lagrange's multipliers: q' = v, p' = F - B^T lambda with phi'' = 0 (nguyen-turski (A.1)-(A.5)),
//   lambda = S^-1 (h + P F_friction),
// F the full force, friction included: that is drag with ideal constraint forces. Without friction the same
// field as the simplified Dirac formulation.
//
// Baumgarte's stabilisation asks for phi'' + 2 alpha phi' + beta^2 phi = 0 instead (baumgarte1972): off the
// surface the constraints decay at the rates of that equation. alpha = beta is critical.
#include <pfaff/brackets/formulations/friction.hpp>
#include <pfaff/core/formulation.hpp>

namespace {
using namespace pfaff;

struct LagrangeMultipliers {
  std::string friction_form = "stokes";
  Real alpha = 0, beta = 0;
  static std::vector<Parameter> parameters() {
    return {parameter(&LagrangeMultipliers::friction_form, "friction-form", friction_forms(),
                      "the symmetric Dirac bracket, Stokes drag with ideal constraint forces, or none"),
            parameter(&LagrangeMultipliers::alpha, "baumgarte-alpha", "1/time", 0, 1e6,
                      "damping of the constraints: phi'' + 2 alpha phi' + beta^2 phi = 0"),
            parameter(&LagrangeMultipliers::beta, "baumgarte-beta", "1/time", 0, 1e6,
                      "frequency of the constraints")};
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
    if (alpha.is(0) && beta.is(0) && is_frictionless(constraints, friction_form))
      if (const auto done = constraints.multiplier_rates(t, q, p, q_rate, p_rate)) return *done;
    const Status status = constraints.place(t, q, p);
    const T twice_alpha = T(2 * alpha), beta_squared = T(beta * beta);
    const In<T> phi = constraints.residuals(), hidden = constraints.hidden(),
                rates = constraints.hidden_rates();
    for (std::size_t k = 0; k < w.multipliers.size(); ++k)
      w.multipliers[k] = rates[k] + twice_alpha * hidden[k] + beta_squared * phi[k];
    constraints.solve(w.multipliers, w.multipliers);
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

const Formulation<LagrangeMultipliers> registered{
    {.name = "lmm",
     .title = "Lagrange's multipliers, with Baumgarte's stabilisation or without",
     .reference = "nguyen-turski (A.1)-(A.5); baumgarte1972"}};
}  // namespace
