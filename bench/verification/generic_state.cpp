// The state at which claims are measured.
#include <pfaff/bench/measure/constraints.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/step_scale.hpp>

namespace pfaff {

Real generic_time_of(const Model& model) {
  const Real fraction = Real::fraction(37, 100);
  return model.moves() ? fraction * Real(own_time(model, Real(0), model.initial())) : fraction;
}

std::vector<Real> generic_state(const Model& model) {
  if (model.initial().size() != static_cast<std::size_t>(model.dimension()))
    throw InputError("system " + model.name() + " has " + std::to_string(model.initial().size()) +
                     " initial values, near which its claims are measured; expected " +
                     std::to_string(model.dimension()));
  std::vector<Real> z = model.initial();
  const std::vector<double> scales = coordinate_scales(model);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const auto i = static_cast<std::int64_t>(k);
    // Offsets that grow with the index would tear systems of many bodies apart, so they repeat with
    // constraints, and where they are parts of a coordinate's own size.
    const std::int64_t amount = model.restricted() || scales[k] != 1 ? i % 5 : i;
    const Real offset = Real::fraction(i % 2 == 0 ? 7 + 2 * amount : -5 - 3 * amount, 101);
    z[k] = z[k] + (scales[k] == 1 ? offset : Real(Quad(scales[k])) * offset);
  }
  if (model.restricted()) {
    std::vector<Quad> moved;
    for (const Real& x : z) moved.push_back(x.quad());
    const auto projection = project_onto_constraints(model, generic_time_of(model).quad(), moved);
    if (projection.status != Status::converged)
      throw InputError("system " + model.name() +
                       ": no state on its constraints was found near its initial state (" +
                       std::string(to_string(projection.status)) + ")");
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = Real(moved[k]);
  }
  return z;
}

}  // namespace pfaff
