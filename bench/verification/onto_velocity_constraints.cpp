// The projection onto velocity constraints as a tape, so that residuals can be measured on their surface with
// bounds of their rounding errors.
#include <pfaff/bench/verification/residuals.hpp>
#include <pfaff/core/facets/quadratic_energy.hpp>

namespace pfaff {

std::shared_ptr<const Tape> onto_velocity_constraints(const Model& model) {
  // From a twentieth of the scales, Newton's method has converged in quad after six steps.
  constexpr int steps = 6;
  const auto velocities = model.velocity_constraints<Recorded>();
  const auto positions = model.given(Formula::holonomic) ? model.holonomic_constraints<Recorded>() : nullptr;
  const int momentum_steps = quadratic_in_momenta(model) ? 1 : steps;
  const int n = model.dimension();
  return expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const std::size_t half = z.size() / 2;
    std::copy(z.begin(), z.end(), out.begin());
    const Results q = out.first(half), p = out.subspan(half);
    std::vector<Recorded> residual, move(half);
    const auto newton = [&](auto& constraints, Results x, const auto& measure, const auto& along) {
      residual.resize(constraints.count());
      measure();
      (void)constraints.linearise(t, q, p);  // fails for numbers only
      constraints.solve(residual, residual);
      along();
      for (std::size_t k = 0; k < half; ++k) x[k] = x[k] - move[k];
    };
    if (positions != nullptr)
      for (int k = 0; k < steps; ++k)
        newton(
            *positions, q, [&] { positions->values(t, q, residual); },
            [&] { positions->hidden_by_momentum_transpose(residual, move); });
    for (int k = 0; k < momentum_steps; ++k)
      newton(
          *velocities, p, [&] { velocities->values(t, q, p, residual); },
          [&] { velocities->apply_transpose(residual, move); });
  });
}

}  // namespace pfaff
