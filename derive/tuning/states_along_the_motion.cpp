#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/derive/tuning/tuned_splitting.hpp>
#include <pfaff/runs/integrate.hpp>

namespace pfaff {

std::vector<std::vector<double>> states_along_the_motion(const std::shared_ptr<const Model>& model,
                                                         int count) {
  if (!model->facets().includes(facets(Facet::separable)) || model->restricted())
    throw InputError("system " + model->name() +
                     ": expected kinetic and potential energy, H = T(p) + V(q), without constraints");
  if (!model->autonomous())
    throw InputError("system " + model->name() + ": its energy depends on time; expected H = T(p) + V(q)");
  std::vector<double> z, rate;
  for (const Real& x : model->initial()) z.push_back(x.value());
  rate.resize(z.size());
  const Problem<double> problem(model);
  problem.field(0, z, rate);
  double size = 0, speed = 0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    size += z[k] * z[k];
    speed += rate[k] * rate[k];
  }
  if (!(size > 0 && speed > 0))
    throw InputError("system " + model->name() +
                     ": expected an initial state in motion, away from the origin");
  // Twenty steps of order 8 for each time in which the motion goes as far as the state is long.
  constexpr int steps = 20;
  const double h = std::sqrt(size / speed) / steps;
  auto motion =
      integrate<double>(model, integrators().get("kahan-li", "integrator").make({{"order", "8"}}), h);
  std::vector<std::vector<double>> states;
  for (int k = 0; k < count; ++k) {
    states.emplace_back(motion.state().begin(), motion.state().end());
    const Outcome outcome = motion.steps(steps);
    if (!outcome.reached())
      throw RunError("system " + model->name() + ": the motion cannot be followed: " + outcome.message());
  }
  return states;
}

}  // namespace pfaff
