// Lagrange's multipliers: q' = v, p' = F - B^T lambda with phi'' = 0 (nguyen-turski (A.1)-(A.5)),
//   lambda = S^-1 (h + P F_friction),
// where F is the full force, friction included. With the default friction-form, friction is thus Stokes's
// drag with ideal constraint forces. Without friction the field is that of the simplified Dirac formulation.
//
// Baumgarte's stabilisation asks for phi'' + 2 alpha phi' + beta^2 phi = 0 instead (baumgarte1972): off the
// surface the constraints decay at the rates of that equation. alpha = beta is the case of critical damping.
#include <pfaff/formulations/ideal_reactions.hpp>

namespace {
using namespace pfaff;

struct LagrangeMultipliers : WithFriction {
  LagrangeMultipliers() : WithFriction(FrictionForm::stokes) {}
  Real alpha = 0, beta = 0;
  static std::vector<Parameter> parameters() {
    return {friction_parameter<LagrangeMultipliers>(),
            parameter(&LagrangeMultipliers::alpha, "baumgarte-alpha", "1/time", 0, 1e6,
                      "damping of the constraints: phi'' + 2 alpha phi' + beta^2 phi = 0"),
            parameter(&LagrangeMultipliers::beta, "baumgarte-beta", "1/time", 0, 1e6,
                      "frequency of the constraints")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list = WithFriction::instances(full);
    list.push_back({{"baumgarte-alpha", "2"}, {"baumgarte-beta", "3"}});
    return list;
  }
  [[nodiscard]] bool stabilised() const { return !(alpha.is(0) && beta.is(0)); }
  // Stabilisation drives phi and phi~ to zero, so that they are not constant off the surface.
  [[nodiscard]] std::vector<FormulationClaim> keeps() const {
    if (stabilised()) return {FormulationClaim::tangent};
    return {FormulationClaim::tangent, FormulationClaim::hidden_constraints};
  }

  template <class T>
  struct Work {
    Work(const LagrangeMultipliers& formulation, HolonomicConstraints<T>& constraints)
        : twice_alpha(2 * formulation.alpha),
          beta_squared(formulation.beta * formulation.beta),
          rates(formulation.friction(), constraints) {}
    T twice_alpha, beta_squared;
    IdealReactions<T> rates;
  };

  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    if (!stabilised()) return w.rates(constraints, t, q, p, q_rate, p_rate);
    return w.rates(constraints, t, q, p, q_rate, p_rate, [&](std::size_t k, const T& h) {
      return T(h + w.twice_alpha * constraints.hidden()[k] + w.beta_squared * constraints.residuals()[k]);
    });
  }
};

const Formulation<LagrangeMultipliers> registered{
    {.name = "lmm",
     .title = "Lagrange's multipliers, with Baumgarte's stabilisation or without",
     .reference = "nguyen-turski (A.1)-(A.5); baumgarte1972",
     .description =
         "Lagrange's multipliers from the second derivative of the constraints, the usual index-1 equations "
         "of multibody codes. Take it as the yardstick, or with Baumgarte's stabilisation where a method "
         "leaves the constraints: deviations then decay at the rates of the two parameters, of which large "
         "values make the equations stiff. Without stabilisation the constraints of positions drift off "
         "linearly, and the energy is kept on the surface alone.",
     .reactions = Reactions::ideal}};
}  // namespace
